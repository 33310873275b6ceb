#pragma once
#include <vulkan/vulkan.h>

#include "gpu/memory.h"
#include "gpu/queue.h"
#include "gpu/unique.h"

namespace vasa::gpu {

class Device;

struct ImageSpec {
  const char* name = "image";
  VkExtent2D size{};
  VkFormat format = VK_FORMAT_R8G8B8A8_SRGB;
  VkImageUsageFlags usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT;
  VkSampleCountFlagBits samples = VK_SAMPLE_COUNT_1_BIT;
};

/// A two-dimensional image in device memory with a view of all of it. Its layout is undefined at first and is
/// changed with changeLayout() of barrier.h. Waits for the queue before it goes.
class Image {
 public:
  Image() = default;
  /// Throws Error if the size is zero or over the device's limit, or memory is spent.
  Image(Device& device, const ImageSpec& spec);

  VkImage handle() const { return image_.get(); }
  VkImageView view() const { return view_.get(); }
  VkExtent2D size() const { return size_; }
  VkFormat format() const { return format_; }
  VkImageAspectFlags aspect() const;
  explicit operator bool() const { return bool(image_); }

 private:
  void makeView(Device& device, const char* name);

  VkExtent2D size_{};
  VkFormat format_ = VK_FORMAT_UNDEFINED;
  Memory memory_;
  Unique<VkImage> image_;
  Unique<VkImageView> view_;
  Settled settled_;
};

/// An image of dynamic rendering; clear value and resolving are the caller's.
VkRenderingAttachmentInfo attachment(const Image& image, VkImageLayout layout, VkAttachmentLoadOp load,
                                     VkAttachmentStoreOp store);
/// Begins dynamic rendering to whole images of a size. @param colour, depth  nullptr: none
void beginRendering(VkCommandBuffer commands, VkExtent2D size, const VkRenderingAttachmentInfo* colour,
                    const VkRenderingAttachmentInfo* depth);

}  // namespace vasa::gpu
