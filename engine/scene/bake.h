#pragma once
#include <functional>

#include "core/result.h"
#include "scene/film_baker.h"
#include "scene/frame.h"

namespace vasa {

struct BakeOptions {
  std::uint32_t first = 0, last = 0;  ///< frames of the clip, both included
  /// Keys a second, from the first frame to the last; 0: one a frame of the clip.
  float fps = 0;
  FrameOptions frame;
  SweepShape shape;
  bool finestThatFits = true;        ///< choose the shape by maxBytes; `shape` is the finest looked at
  std::size_t maxBytes = 64u << 20;  ///< of vertices, triangles and shapes together
  /// [m] Where control points stray farther than this from the straight way between two keys, keys are added
  /// between them, up to three.
  float betweenTolerance = 1e-3f;
  FilmBaker::Options mesh;
  std::function<void(std::uint32_t, std::uint32_t)> progress = {};  ///< frames done, of how many
};

/// The drawn surface of a scene's vessels with its motion through a clip as shapes with weights, a key a
/// frame or `fps` a second, and more where vertices do not move straight (mesh/shape_basis.h). The first key
/// is the mesh itself. Fails with `failed` where even the coarsest shape takes more than maxBytes; can be
/// cancelled (core/cancellation.h).
/// @param clip  nullptr: at rest, not moving
Result<Bake> bake(const Scene& scene, const Clip* clip, const BakeOptions& options);

}  // namespace vasa
