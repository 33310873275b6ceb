#pragma once
#include "gpu/compute_pipeline.h"
#include "render/tube_pass.h"
#include "shared/patch.h"

namespace vasa {

/// A network's patches (surface/patch.h) in device memory: what never changes, and what a frame makes of it.
class PatchSet {
 public:
  PatchSet(gpu::Device& device, const PatchTable& table);

  bool empty() const { return seamCount_ == 0; }
  /// Strips included, seen or not, where all vessels have `around` quads.
  std::uint64_t triangleCount(std::uint32_t around) const { return fixedTriangles_ + std::uint64_t(seamCount_) * around; }
  VkDeviceSize bytes() const;

  /// Vertices, colours, indices and one draw; vertices and strips are a frame's. Empty without patches.
  const TubeDraws& draws() const { return draws_; }
  /// Waits for the device. @param spanColours  one a span of the network, kind in the highest 8 bits
  void setSpanColours(gpu::Device& device, std::span<const std::uint32_t> spanColours);

 private:
  friend class PatchPass;
  std::uint32_t seamCount_ = 0, vertexCount_ = 0;
  std::uint64_t fixedTriangles_ = 0;
  std::vector<std::uint32_t> spanOfBlock_;
  gpu::Buffer seams_, shares_, rest_, joints_;
  TubeDraws draws_;
};

/// Carries patches by the rings of their vessels, and closes the surface between them.
/// CPU reference: surface/patch.h.
class PatchPass {
 public:
  explicit PatchPass(gpu::Device& device);

  struct Input {
    const TubeSet& tubes;  ///< of the same network
    const PatchSet& patches;  ///< not empty
    const DetailPass& detail;
    VkDeviceAddress points, knots;  ///< de Boor points (vec4) and knot quaternions (x y z w) of the frame
  };
  /// Barriers between its own two dispatches only.
  void record(VkCommandBuffer commands, const Input& input) const;

 private:
  gpu::ComputePipeline seams_, skin_;
};

}  // namespace vasa
