#pragma once
#include <vulkan/vulkan.h>

namespace vasa::gpu {

constexpr VkPipelineStageFlags2 kCompute = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;

/// Everything written by stages `from` of earlier commands (of earlier submits too) is seen by stages `to` of
/// later ones, and is not overwritten while it is still read. Whole memory: a barrier for every buffer costs
/// drivers the same, and is forgotten more easily.
void stageBarrier(VkCommandBuffer commands, VkPipelineStageFlags2 from, VkPipelineStageFlags2 to);

/// What was written so far can be read by the host once the ticket is done. Queue::submit() records it.
void makeVisibleToHost(VkCommandBuffer commands);

/// A change of an image's layout, with the same promise as stageBarrier().
struct LayoutChange {
  VkImage image = VK_NULL_HANDLE;
  VkImageAspectFlags aspect = VK_IMAGE_ASPECT_COLOR_BIT;
  VkImageLayout before = VK_IMAGE_LAYOUT_UNDEFINED;  ///< undefined: the content may go
  VkImageLayout after = VK_IMAGE_LAYOUT_GENERAL;
  VkPipelineStageFlags2 from = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
  VkPipelineStageFlags2 to = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
};
void changeLayout(VkCommandBuffer commands, const LayoutChange& change);

}  // namespace vasa::gpu
