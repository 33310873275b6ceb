#include "render/frame_upload.h"

#include <cassert>

#include "gpu/barrier.h"

namespace vasa {

static_assert(sizeof(vec4) == 16 && sizeof(quat) == 16);

FrameUpload::FrameUpload(gpu::Device& device, std::uint32_t points, std::uint32_t knots, std::uint32_t joints)
    : jointCount_(joints),
      knotOffset_(VkDeviceSize(points) * sizeof(vec4)),
      jointOffset_(knotOffset_ + VkDeviceSize(knots) * sizeof(quat)) {
  const VkDeviceSize bytes = jointOffset_ + VkDeviceSize(joints) * sizeof(shared::JointRows);
  host_ = gpu::Buffer(device, {"frame, host", bytes, gpu::MemoryRole::upload});
  device_ = gpu::Buffer(device, {"frame", bytes});
}

void FrameUpload::write(std::span<const vec4> points, std::span<const quat> knots,
                        std::span<const mat4> joints) {
  assert(points.size_bytes() == knotOffset_ && knots.size_bytes() == jointOffset_ - knotOffset_ &&
         joints.size() >= jointCount_);
  host_.write(points);
  host_.write(knots, knotOffset_);
  rows_.clear();
  for (const mat4& joint : joints.first(jointCount_)) {
    const mat4 rows = glm::transpose(joint);
    rows_.push_back({rows[0], rows[1], rows[2]});
  }
  host_.write(std::span<const shared::JointRows>(rows_), jointOffset_);
}

void FrameUpload::record(VkCommandBuffer commands) const {
  if (host_.bytes() == 0) return;
  const VkBufferCopy all{0, 0, host_.bytes()};
  vkCmdCopyBuffer(commands, host_.handle(), device_.handle(), 1, &all);
  gpu::stageBarrier(commands, VK_PIPELINE_STAGE_2_TRANSFER_BIT, VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT);
}

}  // namespace vasa
