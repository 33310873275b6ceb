#pragma once
#include "gpu/compute_pipeline.h"
#include "render/mesh_set.h"

namespace vasa {

/// Poses the body's meshes by linear blend skinning, as glTF has it.
class SkinPass {
 public:
  explicit SkinPass(gpu::Device& device);

  /// Writes those of meshes.posed() that the levels use. No barriers.
  /// @param levels      MeshSet::levelsFor()
  /// @param joints      address of shared::JointRows of world · inverseBind, one a joint
  /// @param jointCount  at least meshes.jointCount()
  /// @param heartScale  size of the heart beside its size at rest
  void record(VkCommandBuffer commands, const MeshSet& meshes, std::span<const MeshSet::Level> levels,
              VkDeviceAddress joints, std::uint32_t jointCount, float heartScale = 1) const;

 private:
  gpu::ComputePipeline pipeline_;
};

}  // namespace vasa
