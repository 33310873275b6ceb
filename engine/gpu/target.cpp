#include "gpu/target.h"

#include <algorithm>
#include <cassert>

#include "gpu/barrier.h"
#include "gpu/device.h"

namespace vasa::gpu {
namespace {

constexpr VkPipelineStageFlags2 kDepthStages =
    VK_PIPELINE_STAGE_2_EARLY_FRAGMENT_TESTS_BIT | VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT;
constexpr VkPipelineStageFlags2 kDepthReaders = kDepthStages | VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT;
constexpr VkImageLayout kDepthWritten = VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL;

// The old content goes, but whoever still reads or writes it has to be finished.
void makeAttachment(VkCommandBuffer commands, const Image& image) {
  const bool depth = image.aspect() == VK_IMAGE_ASPECT_DEPTH_BIT;
  changeLayout(commands, {image.handle(), image.aspect(), VK_IMAGE_LAYOUT_UNDEFINED,
                          depth ? kDepthWritten : VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
                          VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
                          depth ? kDepthStages : VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT});
}

}  // namespace

Target::Target(Device& device, const TargetSpec& spec) : spec_(spec) {
  const bool multisampled = spec.samples != VK_SAMPLE_COUNT_1_BIT;
  picture_ = Image(device, {spec.name, spec.size, spec.colour,
                            VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT |
                                VK_IMAGE_USAGE_SAMPLED_BIT});
  if (multisampled)
    samples_ =
        Image(device, {spec.name, spec.size, spec.colour, VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT, spec.samples});
  if (spec.depth == VK_FORMAT_UNDEFINED) return;
  constexpr VkImageUsageFlags attachment = VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT;
  const VkImageUsageFlags read =
      spec.readDepth ? attachment | VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT : attachment;
  depth_ = Image(device, {spec.name, spec.size, spec.depth, multisampled ? attachment : read, spec.samples});
  if (spec.readDepth && multisampled)
    readableDepth_ = Image(device, {spec.name, spec.size, spec.depth, read});
}

void Target::makeDepthReadable(VkCommandBuffer commands) const {
  assert(spec_.readDepth);
  if (readableDepth_) resolveDepth(commands);
  const Image& image = readableDepth();
  changeLayout(commands, {image.handle(), image.aspect(), kDepthWritten, kReadDepthLayout, kAttachmentStages,
                          kDepthReaders});
}

void Target::makeDepthWritable(VkCommandBuffer commands) const {
  const Image& image = readableDepth();
  changeLayout(commands, {image.handle(), image.aspect(), kReadDepthLayout, kDepthWritten, kDepthReaders,
                          kDepthStages});
}

// An empty stretch that takes the first of each pixel's samples.
void Target::resolveDepth(VkCommandBuffer commands) const {
  makeAttachment(commands, readableDepth_);
  stageBarrier(commands, kAttachmentStages, kAttachmentStages);
  VkRenderingAttachmentInfo depths =
      attachment(depth_, kDepthWritten, VK_ATTACHMENT_LOAD_OP_LOAD, VK_ATTACHMENT_STORE_OP_STORE);
  depths.resolveMode = VK_RESOLVE_MODE_SAMPLE_ZERO_BIT;
  depths.resolveImageView = readableDepth_.view();
  depths.resolveImageLayout = kDepthWritten;
  beginRendering(commands, spec_.size, nullptr, &depths);
  vkCmdEndRendering(commands);
}

void Target::begin(VkCommandBuffer commands, std::array<float, 4> colour, float depth,
                   Stretch stretch) const {
  const bool starts = stretch == Stretch::only || stretch == Stretch::first;
  const bool ends = stretch == Stretch::only || stretch == Stretch::last;
  if (starts) {
    makeAttachment(commands, picture_);
    if (samples_) makeAttachment(commands, samples_);
    if (depth_) makeAttachment(commands, depth_);
  }
  const VkAttachmentLoadOp load = starts ? VK_ATTACHMENT_LOAD_OP_CLEAR : VK_ATTACHMENT_LOAD_OP_LOAD;
  const VkAttachmentStoreOp keep = ends ? VK_ATTACHMENT_STORE_OP_DONT_CARE : VK_ATTACHMENT_STORE_OP_STORE;

  VkRenderingAttachmentInfo colours =
      samples_ ? attachment(samples_, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL, load, keep)
               : attachment(picture_, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL, load,
                            VK_ATTACHMENT_STORE_OP_STORE);
  std::copy(colour.begin(), colour.end(), colours.clearValue.color.float32);
  if (samples_ && ends) {
    colours.resolveMode = VK_RESOLVE_MODE_AVERAGE_BIT;
    colours.resolveImageView = picture_.view();
    colours.resolveImageLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
  }
  VkRenderingAttachmentInfo depths = attachment(depth_, kDepthWritten, load, keep);
  depths.clearValue.depthStencil.depth = depth;
  beginRendering(commands, spec_.size, &colours, depth_ ? &depths : nullptr);
  setViewport(commands);
}

void Target::setViewport(VkCommandBuffer commands) const {
  const VkViewport viewport{0, 0, float(spec_.size.width), float(spec_.size.height), 0, 1};
  const VkRect2D scissor{{0, 0}, spec_.size};
  vkCmdSetViewport(commands, 0, 1, &viewport);
  vkCmdSetScissor(commands, 0, 1, &scissor);
}

void Target::end(VkCommandBuffer commands, VkImageLayout after) const {
  vkCmdEndRendering(commands);
  changeLayout(commands,
               {picture_.handle(), VK_IMAGE_ASPECT_COLOR_BIT, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL, after,
                VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT});
}

void Target::copyPicture(VkCommandBuffer commands, const Buffer& to) const {
  assert(to.bytes() >= pictureBytes());
  VkBufferImageCopy region{};
  region.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
  region.imageExtent = {spec_.size.width, spec_.size.height, 1};
  vkCmdCopyImageToBuffer(commands, picture_.handle(), VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, to.handle(), 1,
                         &region);
}

}  // namespace vasa::gpu
