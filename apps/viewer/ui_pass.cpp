#include "viewer/ui_pass.h"

#include <backends/imgui_impl_vulkan.h>
#include <imgui.h>

#include <algorithm>

#include "gpu/barrier.h"
#include "gpu/make.h"
#include "gpu/transfer.h"
#include "render/picture.h"

// ImGui's colours are sRGB values, so the canvas is a UNORM image: the scene's sRGB picture is copied to it
// bit by bit.
namespace vasa::viewer {
namespace {

constexpr VkFormat kFormat = VK_FORMAT_B8G8R8A8_UNORM;          // as most windows have
constexpr VkClearColorValue kDesk{{0.13f, 0.135f, 0.145f, 1}};  // where there is no picture

void checkImGui(VkResult result) { gpu::check(result, "Dear ImGui's Vulkan back end"); }

}  // namespace

UiPass::UiPass(gpu::Device& device) : device_(device) {
  makeRenderPass();
  makePool();
  ImGui_ImplVulkan_InitInfo info{};
  info.Instance = device.instance();
  info.PhysicalDevice = device.physical();
  info.Device = device.handle();
  info.QueueFamily = device.adapter().queueFamily;
  info.Queue = device.queue().handle();
  info.PipelineCache = device.pipelineCache();
  info.DescriptorPool = pool_.get();
  info.MinImageCount = info.ImageCount = 2;
  info.MSAASamples = VK_SAMPLE_COUNT_1_BIT;
  info.CheckVkResultFn = checkImGui;
  ImGui_ImplVulkan_Init(&info, renderPass_.get());
  gpu::Commands commands = device.queue().begin("fonts");
  ImGui_ImplVulkan_CreateFontsTexture(commands);
  device.queue().wait(device.queue().submit(std::move(commands)));
  ImGui_ImplVulkan_DestroyFontUploadObjects();
}

UiPass::~UiPass() {
  device_.queue().settle();  // the canvas may be on its way to the window
  ImGui_ImplVulkan_Shutdown();
}

// Layouts and barriers are recorded around it.
void UiPass::makeRenderPass() {
  VkAttachmentDescription attachment{};
  attachment.format = kFormat;
  attachment.samples = VK_SAMPLE_COUNT_1_BIT;
  attachment.loadOp = VK_ATTACHMENT_LOAD_OP_LOAD;
  attachment.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
  attachment.stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
  attachment.stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
  attachment.initialLayout = attachment.finalLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
  const VkAttachmentReference reference{0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
  VkSubpassDescription subpass{};
  subpass.pipelineBindPoint = VK_PIPELINE_BIND_POINT_GRAPHICS;
  subpass.colorAttachmentCount = 1;
  subpass.pColorAttachments = &reference;
  VkRenderPassCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO;
  info.attachmentCount = 1;
  info.pAttachments = &attachment;
  info.subpassCount = 1;
  info.pSubpasses = &subpass;
  renderPass_ = gpu::make(device_, vkCreateRenderPass, "vkCreateRenderPass", info, "panels");
}

void UiPass::makePool() {
  const VkDescriptorPoolSize fonts{VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 4};
  VkDescriptorPoolCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO;
  info.flags = VK_DESCRIPTOR_POOL_CREATE_FREE_DESCRIPTOR_SET_BIT;
  info.maxSets = 4;
  info.poolSizeCount = 1;
  info.pPoolSizes = &fonts;
  pool_ = gpu::make(device_, vkCreateDescriptorPool, "vkCreateDescriptorPool", info, "panels");
}

void UiPass::resize(VkExtent2D size) {
  if (canvas_ && canvas_.size().width == size.width && canvas_.size().height == size.height) return;
  device_.queue().wait(device_.queue().last());  // it may still be on its way to the window
  fresh_ = true;
  frame_ = {};
  canvas_ = gpu::Image(device_, {.name = "canvas",
                                 .size = size,
                                 .format = kFormat,
                                 .usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT |
                                          VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT});
  const VkImageView view = canvas_.view();
  VkFramebufferCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO;
  info.renderPass = renderPass_.get();
  info.attachmentCount = 1;
  info.pAttachments = &view;
  info.width = size.width;
  info.height = size.height;
  info.layers = 1;
  frame_ = gpu::make(device_, vkCreateFramebuffer, "vkCreateFramebuffer", info, "panels");
}

void UiPass::recordPicture(VkCommandBuffer commands, const gpu::Image* picture, std::uint32_t left,
                           std::uint32_t top) const {
  constexpr VkPipelineStageFlags2 transfer = VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT;
  constexpr VkImageLayout target = VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL;
  gpu::changeLayout(commands, {.image = canvas_.handle(), .after = target, .to = transfer});
  if (!picture || fresh_) {  // later pictures and the panels cover all of it
    const VkImageSubresourceRange all{VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
    vkCmdClearColorImage(commands, canvas_.handle(), target, &kDesk, 1, &all);
    gpu::stageBarrier(commands, transfer, transfer);
  }
  if (picture) {
    VkImageCopy region{};
    region.srcSubresource = region.dstSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
    region.dstOffset = {std::int32_t(left), std::int32_t(top), 0};
    region.extent = {std::min(picture->size().width, canvas_.size().width - left),
                     std::min(picture->size().height, canvas_.size().height - top), 1};
    vkCmdCopyImage(commands, picture->handle(), VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, canvas_.handle(),
                   target, 1, &region);
  }
  gpu::changeLayout(commands, {.image = canvas_.handle(),
                               .before = target,
                               .after = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
                               .from = transfer,
                               .to = VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT});
}

void UiPass::draw(const gpu::Image* picture, std::uint32_t left, std::uint32_t top, ImDrawData& panels) {
  gpu::Commands commands = device_.queue().begin("panels");
  recordPicture(commands, picture, left, top);
  if (!picture || fresh_) changes_.forget();
  changes_.keepChanged(panels, picture ? Rect{float(left), float(top), float(picture->size().width),
                                              float(picture->size().height)}
                                       : Rect{});
  VkRenderPassBeginInfo info{};
  info.sType = VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO;
  info.renderPass = renderPass_.get();
  info.framebuffer = frame_.get();
  info.renderArea.extent = canvas_.size();
  vkCmdBeginRenderPass(commands, &info, VK_SUBPASS_CONTENTS_INLINE);
  ImGui_ImplVulkan_RenderDrawData(&panels, commands);
  vkCmdEndRenderPass(commands);
  gpu::changeLayout(commands, {.image = canvas_.handle(),
                               .before = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
                               .after = VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
                               .from = VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT});
  device_.queue().wait(device_.queue().submit(std::move(commands)));  // the picture may go after this
  fresh_ = false;
}

Image UiPass::readBack() {
  const VkExtent2D size = canvas_.size();
  const gpu::Buffer host(
      device_, {"canvas, host", VkDeviceSize(size.width) * size.height * 4, gpu::MemoryRole::readBack});
  gpu::Commands commands = device_.queue().begin("read back");
  VkBufferImageCopy region{};
  region.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
  region.imageExtent = {size.width, size.height, 1};
  vkCmdCopyImageToBuffer(commands, canvas_.handle(), VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, host.handle(), 1,
                         &region);
  device_.queue().wait(device_.queue().submit(std::move(commands)));
  host.invalidate();
  swapRedAndBlue(host.mapped<std::uint8_t>());
  return toImage(host.mapped<const std::uint8_t>(), size.width, size.height, false);
}

}  // namespace vasa::viewer
