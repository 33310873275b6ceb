#pragma once
#include "core/image.h"
#include "gpu/buffer.h"
#include "gpu/image.h"
#include "gpu/queue.h"
#include "gpu/unique.h"
#include "viewer/ui_changes.h"

struct ImDrawData;

namespace vasa::viewer {

/// The whole window's picture: the scene's picture at its place, and Dear ImGui's panels over it. Drawn by
/// ImGui's own Vulkan back end, which wants a render pass. An ImGui context must be there, and must outlive
/// this.
class UiPass {
 public:
  /// Uploads ImGui's fonts.
  explicit UiPass(gpu::Device& device);
  ~UiPass();
  UiPass(const UiPass&) = delete;
  UiPass& operator=(const UiPass&) = delete;

  void resize(VkExtent2D size);

  /// Draws and waits. @param picture  Renderer::picture(); nullptr: none yet. @param left, top  its place,
  /// within the canvas
  void draw(const gpu::Image* picture, std::uint32_t left, std::uint32_t top, ImDrawData& panels);

  /// sRGB values in B8G8R8A8_UNORM, in the layout that copies read from.
  const gpu::Image& canvas() const { return canvas_; }
  Image readBack();

 private:
  void makeRenderPass();
  void makePool();
  void recordPicture(VkCommandBuffer commands, const gpu::Image* picture, std::uint32_t left,
                     std::uint32_t top) const;

  gpu::Device& device_;
  gpu::Unique<VkRenderPass> renderPass_;
  gpu::Unique<VkDescriptorPool> pool_;
  gpu::Image canvas_;
  gpu::Unique<VkFramebuffer> frame_;
  bool fresh_ = true;  // nothing has been drawn on it
  UiChanges changes_;
};

}  // namespace vasa::viewer
