#pragma once
#include <vulkan/vulkan.h>

#include <array>

#include "gpu/buffer.h"
#include "gpu/image.h"

namespace vasa::gpu {

struct TargetSpec {
  const char* name = "target";
  VkExtent2D size{};
  VkFormat colour = VK_FORMAT_R8G8B8A8_SRGB;  ///< four bytes a pixel, linear values encoded on writing
  VkFormat depth = VK_FORMAT_D32_SFLOAT;      ///< VK_FORMAT_UNDEFINED: none
  VkSampleCountFlagBits samples = VK_SAMPLE_COUNT_4_BIT;
  bool readDepth = false;  ///< readableDepth() will be read
};

constexpr VkPipelineStageFlags2 kAttachmentStages = VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT |
                                                    VK_PIPELINE_STAGE_2_EARLY_FRAGMENT_TESTS_BIT |
                                                    VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT;

/// Of depth that shaders read while it is tested.
constexpr VkImageLayout kReadDepthLayout = VK_IMAGE_LAYOUT_DEPTH_STENCIL_READ_ONLY_OPTIMAL;

/// A picture may be drawn in several stretches with other work (compute passes) between them.
enum class Stretch { only, first, middle, last };

/// What a picture is drawn into: colour and depth, and with several samples a pixel the picture they are
/// averaged to. Not for presenting: a swapchain's images are copied to from picture().
class Target {
 public:
  Target() = default;
  Target(Device& device, const TargetSpec& spec);

  const TargetSpec& spec() const { return spec_; }
  /// One sample a pixel, in the layout given to end().
  const Image& picture() const { return picture_; }

  /// Starts rendering, viewport and scissor set to the whole images. The first stretch of a picture clears
  /// them, a later one goes on with what is there. Between stretches belongs a stageBarrier() from and to
  /// kAttachmentStages.
  /// @param colour  linear, alpha last; for the first stretch
  void begin(VkCommandBuffer commands, std::array<float, 4> colour, float depth = 1.0f,
             Stretch stretch = Stretch::only) const;
  /// Ends a first or middle stretch.
  void pause(VkCommandBuffer commands) const { vkCmdEndRendering(commands); }
  /// Ends the only or last stretch; whatever comes after sees the picture in layout `after`.
  void end(VkCommandBuffer commands, VkImageLayout after = VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL) const;

  /// Depth, of the first sample of each pixel. Between two stretches and from makeDepthReadable() to
  /// makeDepthWritable() it is in kReadDepthLayout, for fragment shaders and depth tests.
  const Image& readableDepth() const { return readableDepth_ ? readableDepth_ : depth_; }
  void makeDepthReadable(VkCommandBuffer commands) const;
  void makeDepthWritable(VkCommandBuffer commands) const;

  /// After end(): copies the picture, rows from the top, without gaps, 4 bytes a pixel.
  void copyPicture(VkCommandBuffer commands, const Buffer& to) const;
  VkDeviceSize pictureBytes() const { return VkDeviceSize(spec_.size.width) * spec_.size.height * 4; }

  /// Viewport and scissor of the whole images, as begin() sets them.
  void setViewport(VkCommandBuffer commands) const;

 private:
  void resolveDepth(VkCommandBuffer commands) const;

  TargetSpec spec_;
  Image samples_;  // empty with one sample a pixel
  Image picture_;
  Image depth_;
  Image readableDepth_;  // one sample a pixel; empty where depth_ is that itself
};

}  // namespace vasa::gpu
