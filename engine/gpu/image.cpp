#include "gpu/image.h"

#include <algorithm>
#include <string>

#include "gpu/make.h"

namespace vasa::gpu {

Image::Image(Device& device, const ImageSpec& spec) : size_(spec.size), format_(spec.format) {
  const std::uint32_t most = device.limits().maxImageDimension2D;
  if (!size_.width || !size_.height || std::max(size_.width, size_.height) > most)
    throw Error({Fault::failed, std::string(spec.name) + ": " + std::to_string(size_.width) + "x" +
                                    std::to_string(size_.height) + " pixels; each side must be 1 to " +
                                    std::to_string(most)});
  VkImageCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO;
  info.imageType = VK_IMAGE_TYPE_2D;
  info.format = format_;
  info.extent = {size_.width, size_.height, 1};
  info.mipLevels = 1;
  info.arrayLayers = 1;
  info.samples = spec.samples;
  info.tiling = VK_IMAGE_TILING_OPTIMAL;
  info.usage = spec.usage;
  info.sharingMode = VK_SHARING_MODE_EXCLUSIVE;
  info.initialLayout = VK_IMAGE_LAYOUT_UNDEFINED;
  image_ = make(device, vkCreateImage, "vkCreateImage", info, spec.name);
  memory_ = allocate(device, handle(), spec.name);
  makeView(device, spec.name);
  settled_ = Settled(device.queue());
}

void Image::makeView(Device& device, const char* name) {
  VkImageViewCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO;
  info.image = handle();
  info.viewType = VK_IMAGE_VIEW_TYPE_2D;
  info.format = format_;
  info.subresourceRange = {aspect(), 0, 1, 0, 1};
  view_ = make(device, vkCreateImageView, "vkCreateImageView", info, name);
}

VkImageAspectFlags Image::aspect() const {
  const bool depth = format_ == VK_FORMAT_D32_SFLOAT || format_ == VK_FORMAT_D16_UNORM;
  return depth ? VK_IMAGE_ASPECT_DEPTH_BIT : VK_IMAGE_ASPECT_COLOR_BIT;
}

VkRenderingAttachmentInfo attachment(const Image& image, VkImageLayout layout, VkAttachmentLoadOp load,
                                     VkAttachmentStoreOp store) {
  VkRenderingAttachmentInfo info{};
  info.sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO;
  info.imageView = image.view();
  info.imageLayout = layout;
  info.loadOp = load;
  info.storeOp = store;
  return info;
}

void beginRendering(VkCommandBuffer commands, VkExtent2D size, const VkRenderingAttachmentInfo* colour,
                    const VkRenderingAttachmentInfo* depth) {
  VkRenderingInfo info{};
  info.sType = VK_STRUCTURE_TYPE_RENDERING_INFO;
  info.renderArea.extent = size;
  info.layerCount = 1;
  info.colorAttachmentCount = colour ? 1 : 0;
  info.pColorAttachments = colour;
  info.pDepthAttachment = depth;
  vkCmdBeginRendering(commands, &info);
}

}  // namespace vasa::gpu
