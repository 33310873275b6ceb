#include "render/skin_pass.h"

#include <cassert>

#include "shared/skin.h"
#include "spirv/skin_comp.h"

namespace vasa {

SkinPass::SkinPass(gpu::Device& device) : pipeline_(device, {spirv::skin_comp, sizeof(shared::SkinPush)}) {}

void SkinPass::record(VkCommandBuffer commands, const MeshSet& meshes, VkDeviceAddress joints,
                      std::uint32_t jointCount, float heartScale) const {
  assert(jointCount >= meshes.jointCount());
  if (meshes.vertexCount() == 0) return;
  const MeshSet::Heart& heart = meshes.heart();
  const shared::SkinPush push{meshes.rest(), joints, meshes.posed().address(), meshes.vertexCount(), jointCount,
                              heart.first, heart.last, heart.centre, heartScale};
  pipeline_.dispatch(commands, push, gpu::groupsFor(meshes.vertexCount(), 64));
}

}  // namespace vasa
