#include "gpu/compute_pipeline.h"

#include <cassert>

#include "gpu/device.h"
#include "gpu/error.h"

namespace vasa::gpu {

ComputePipeline::ComputePipeline(Device& device, const ComputeSpec& spec)
    : name_(spec.shader.name), pushBytes_(spec.pushBytes) {
  for (std::size_t axis = 0; axis < 3; ++axis)
    mostGroups_[axis] = device.limits().maxComputeWorkGroupCount[axis];
  shadow_ = AddressShadow(device, spec.shader);
  layout_ = makePipelineLayout(device, name_, VK_SHADER_STAGE_COMPUTE_BIT, spec.pushBytes, spec.sets);
  const VkSpecializationInfo constants = spec.constants.info();
  pipeline_ = makeComputePipeline(device, spec.shader, layout_.get(), &constants, name_);
}

void ComputePipeline::bind(VkCommandBuffer commands, const void* push, std::uint32_t bytes) const {
  assert(bytes == pushBytes_);
  shadow_.record(commands, static_cast<const std::byte*>(push));
  vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, handle());
  vkCmdPushConstants(commands, layout(), VK_SHADER_STAGE_COMPUTE_BIT, 0, bytes, push);
}

bool ComputePipeline::worthDispatching(std::array<std::uint32_t, 3> groups) const {
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (groups[axis] > mostGroups_[axis])
      throw Error({Fault::failed, name_ + ": " + std::to_string(groups[axis]) +
                                      " workgroups, more than the " + std::to_string(mostGroups_[axis]) +
                                      " of the device; spread them over two directions or two dispatches"});
  return groups[0] && groups[1] && groups[2];
}

}  // namespace vasa::gpu
