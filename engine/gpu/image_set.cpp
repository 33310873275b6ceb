#include "gpu/image_set.h"

#include "gpu/make.h"
#include "gpu/pipeline.h"
#include "gpu/target.h"

namespace vasa::gpu {
namespace {

Unique<VkDescriptorSetLayout> makeLayout(Device& device, const char* name, std::uint32_t count) {
  std::vector<VkDescriptorSetLayoutBinding> bindings;
  for (std::uint32_t k = 0; k < count; ++k)
    bindings.push_back({k, VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE, 1, VK_SHADER_STAGE_FRAGMENT_BIT, nullptr});
  return makeSetLayout(device, name, bindings);
}

Unique<VkDescriptorPool> makePool(Device& device, const char* name, std::uint32_t count) {
  const VkDescriptorPoolSize size{VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE, count};
  VkDescriptorPoolCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO;
  info.maxSets = 1;
  info.poolSizeCount = 1;
  info.pPoolSizes = &size;
  return make(device, vkCreateDescriptorPool, "vkCreateDescriptorPool", info, name);
}

}  // namespace

ImageSet::ImageSet(Device& device, const char* name, const std::vector<const Image*>& images)
    : layout_(makeLayout(device, name, std::uint32_t(images.size()))),
      pool_(makePool(device, name, std::uint32_t(images.size()))) {
  VkDescriptorSetAllocateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO;
  info.descriptorPool = pool_.get();
  info.descriptorSetCount = 1;
  info.pSetLayouts = &layout_.get();
  check(vkAllocateDescriptorSets(device.handle(), &info, &set_), "vkAllocateDescriptorSets");
  for (std::uint32_t k = 0; k < images.size(); ++k) {
    const bool depth = images[k]->aspect() == VK_IMAGE_ASPECT_DEPTH_BIT;
    const VkDescriptorImageInfo image{VK_NULL_HANDLE, images[k]->view(),
                                      depth ? kReadDepthLayout : VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL};
    VkWriteDescriptorSet write{};
    write.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
    write.dstSet = set_;
    write.dstBinding = k;
    write.descriptorCount = 1;
    write.descriptorType = VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE;
    write.pImageInfo = &image;
    vkUpdateDescriptorSets(device.handle(), 1, &write, 0, nullptr);
  }
}

void ImageSet::bind(VkCommandBuffer commands, VkPipelineLayout pipeline) const {
  vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline, 0, 1, &set_, 0, nullptr);
}

}  // namespace vasa::gpu
