#include "render/skin_pass.h"

#include <cassert>

#include "shared/skin.h"
#include "spirv/skin_comp.h"

namespace vasa {

SkinPass::SkinPass(gpu::Device& device) : pipeline_(device, {spirv::skin_comp, sizeof(shared::SkinPush)}) {}

void SkinPass::record(VkCommandBuffer commands, const MeshSet& meshes, std::span<const MeshSet::Level> levels,
                      VkDeviceAddress joints, std::uint32_t jointCount, float heartScale) const {
  assert(jointCount >= meshes.jointCount() && levels.size() == meshes.parts().size());
  for (std::size_t i = 0; i < levels.size(); ++i) {
    const std::uint32_t first = levels[i].firstVertex;
    const shared::SkinPush push{.rest = meshes.rest() + first * sizeof(shared::SkinVertex),
                                .joints = joints,
                                .posed = meshes.posed().address() + first * sizeof(shared::TubeVertex),
                                .count = levels[i].vertexCount,
                                .jointCount = jointCount,
                                .centre = meshes.heart().centre,
                                .scale = i == meshes.heart().part ? heartScale : 1};
    pipeline_.dispatch(commands, push, gpu::groupsFor(levels[i].vertexCount, 64));
  }
}

}  // namespace vasa
