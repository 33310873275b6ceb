#pragma once
#include <span>
#include <vector>

#include "gpu/buffer.h"
#include "math/types.h"
#include "shared/skin.h"

namespace vasa {

/// What changes from frame to frame, on its way from the host to the device: 16 bytes a de Boor point, 16 a
/// knot frame, 48 a joint, in one copy.
class FrameUpload {
 public:
  FrameUpload(gpu::Device& device, std::uint32_t points, std::uint32_t knots, std::uint32_t joints);

  /// Into host memory; the device must have finished the copy of the frame before.
  /// Sizes as given at construction; of joints, more are ignored.
  void write(std::span<const vec4> points, std::span<const quat> knots, std::span<const mat4> joints);
  /// Copies it to the device and makes compute shaders see it.
  void record(VkCommandBuffer commands) const;

  VkDeviceAddress points() const { return device_.address(); }
  VkDeviceAddress knots() const { return device_.address() + knotOffset_; }
  VkDeviceAddress joints() const { return device_.address() + jointOffset_; }
  std::uint32_t jointCount() const { return jointCount_; }

 private:
  std::uint32_t jointCount_;
  VkDeviceSize knotOffset_, jointOffset_;
  std::vector<shared::JointRows> rows_;
  gpu::Buffer host_, device_;
};

}  // namespace vasa
