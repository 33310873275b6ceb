#pragma once
#include "gpu/compute_pipeline.h"
#include "render/tube_pass.h"
#include "shared/patch.h"

namespace vasa {

/// What a frame draws of patches.
struct PatchDraws {
  gpu::Buffer vertices, colours, indices, draws;  ///< shared::TubeVertex, uint, uint, shared::DrawCommand
};

/// A network's patches (surface/patch.h) in device memory: what never changes, and what a frame makes of it.
class PatchSet {
 public:
  PatchSet(gpu::Device& device, const PatchTable& table);

  bool empty() const { return seamCount_ == 0; }
  /// Strips included, seen or not, where all vessels have `around` quads.
  std::uint64_t triangleCount(std::uint32_t around) const {
    return fixedTriangles_ + std::uint64_t(seamCount_) * around;
  }
  VkDeviceSize bytes() const;

  /// Vertices, colours, indices of the triangles to draw, and a draw a group; all of a frame but the colours.
  /// Empty without patches.
  const PatchDraws& draws() const { return draws_; }
  std::uint32_t groups() const { return groups_; }
  /// Waits for the device. @param spanColours  one a span of the network, kind in the highest 8 bits
  void setSpanColours(gpu::Device& device, std::span<const std::uint32_t> spanColours);

 private:
  friend class PatchPass;
  std::uint32_t seamCount_ = 0, patchCount_ = 0, vertexCount_ = 0, triangleRoom_ = 0, groups_ = 0;
  std::uint64_t fixedTriangles_ = 0;
  std::vector<std::uint32_t> spanOfBlock_;
  gpu::Buffer seams_, shares_, rest_, joints_, all_;
  gpu::Buffer walls_, firstFan_, fans_, strained_, dispatch_, between_;  // for smoothing
  PatchDraws draws_;
};

/// Carries patches by the rings of their vessels, smooths those that these press together, closes the surface
/// between them, and leaves out triangles that cannot be seen. CPU references: surface/patch.h,
/// surface/patch_smooth.h, tests/reference/visible.h.
class PatchPass {
 public:
  explicit PatchPass(gpu::Device& device);

  struct Input {
    const TubeSet& tubes;     ///< of the same network
    const PatchSet& patches;  ///< not empty
    const DetailPass& detail;
    VkDeviceAddress points, knots;  ///< de Boor points (vec4) and knot quaternions (x y z w) of the frame
    bool cull = true;               ///< false: every triangle is drawn
  };
  /// Barriers between its own dispatches only.
  void record(VkCommandBuffer commands, const Input& input) const;
  /// Only chooses what is drawn of the latest frame's vertices and strips.
  void recordTriangles(VkCommandBuffer commands, const PatchSet& patches, const DetailPass& detail,
                       bool cull) const;

 private:
  gpu::ComputePipeline seams_, skin_, strain_, smooth_, triangles_;
};

}  // namespace vasa
