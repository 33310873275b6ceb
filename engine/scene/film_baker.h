#pragma once
#include <functional>

#include "io/animated_mesh.h"
#include "network/network.h"
#include "surface/fork.h"
#include "surface/sweep_table.h"
#include "surface/sweep_template.h"

namespace vasa {

/// What a frame's surface follows from.
struct PosedFrame {
  std::vector<vec4> points;
  std::vector<quat> knotFrames;
};

/// The keys of a film, and a few shapes between two of them, where motion is least straight.
struct Film {
  struct Between {
    PosedFrame frame;
    std::uint32_t key = 0;  ///< the one before
    float share = 0.5f;     ///< of the time to the next key
  };
  std::vector<PosedFrame> frames;
  std::vector<Between> between;
  std::vector<float> times;  ///< [s] of the keys; empty where there is no clip
};

struct Bake {
  AnimatedMesh mesh;
  SweepShape shape;
  float error = 0;         ///< [m] the farthest a vertex is, in a frame, from where a picture shows it
  float betweenError = 0;  ///< [m] the same between two keys, of the places in Film::between
};

/// Turns a film of a network into a mesh with shapes and weights.
class FilmBaker {
 public:
  struct Options {
    float tolerance = 5e-5f;  ///< [m] of any vertex in any frame
    bool normals = true;      ///< without them a file is half as large, and viewers shade facet by facet
    std::function<vec3(VesselKind)> colourOf;  ///< linear
  };
  FilmBaker(const Network& network, const Film& film, Options options)
      : network_(network), table_(makeSweepTable(network)), film_(film), options_(std::move(options)) {}

  struct Size {
    std::size_t vertices = 0, triangles = 0;
  };
  Size sizeOf(const SweepShape& shape) const;

  /// Holds the vertices of all frames in memory while it runs.
  Bake run(const SweepShape& shape) const;

 private:
  float betweenError(const AnimatedMesh& mesh, const SweepShape& shape,
                     std::span<const ForkSteps> steps) const;

  const Network& network_;
  SweepTable table_;
  const Film& film_;
  Options options_;
};

}  // namespace vasa
