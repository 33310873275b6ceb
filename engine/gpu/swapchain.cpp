#include "gpu/swapchain.h"

#include <algorithm>

#include "gpu/barrier.h"
#include "gpu/make.h"

// A present cannot be waited for, so what it uses is kept until it must be over: a `drawn` semaphore until
// its image has been acquired again, a replaced chain until the next one is replaced. `acquired_` is free
// once the copy that waits for it is done.
namespace vasa::gpu {
namespace {

constexpr VkPipelineStageFlags2 kCopy = VK_PIPELINE_STAGE_2_BLIT_BIT | VK_PIPELINE_STAGE_2_COPY_BIT;
// A window that nobody sees may be given no image: the app goes on without.
constexpr std::uint64_t kLongestAcquire = 1'000'000'000;  // [ns]
constexpr VkImageSubresourceLayers kWhole{VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};

VkSemaphoreSubmitInfo semaphoreInfo(VkSemaphore semaphore, VkPipelineStageFlags2 stage) {
  VkSemaphoreSubmitInfo info{};
  info.sType = VK_STRUCTURE_TYPE_SEMAPHORE_SUBMIT_INFO;
  info.semaphore = semaphore;
  info.stageMask = stage;
  return info;
}

VkExtent2D clamped(VkExtent2D size, const VkSurfaceCapabilitiesKHR& limits) {
  return {std::clamp(size.width, limits.minImageExtent.width, limits.maxImageExtent.width),
          std::clamp(size.height, limits.minImageExtent.height, limits.maxImageExtent.height)};
}

VkCompositeAlphaFlagBitsKHR alphaOf(const VkSurfaceCapabilitiesKHR& limits) {
  if (limits.supportedCompositeAlpha & VK_COMPOSITE_ALPHA_OPAQUE_BIT_KHR)
    return VK_COMPOSITE_ALPHA_OPAQUE_BIT_KHR;
  return VK_COMPOSITE_ALPHA_INHERIT_BIT_KHR;
}

void recordCopy(VkCommandBuffer commands, VkImage from, VkImage to, VkExtent2D size) {
  const VkImageCopy region{kWhole, {}, kWhole, {}, {size.width, size.height, 1}};
  vkCmdCopyImage(commands, from, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, to,
                 VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &region);
}

void recordBlit(VkCommandBuffer commands, const Image& from, VkImage to, VkExtent2D size, VkFilter filter) {
  VkImageBlit region{};
  region.srcSubresource = region.dstSubresource = kWhole;
  region.srcOffsets[1] = {std::int32_t(from.size().width), std::int32_t(from.size().height), 1};
  region.dstOffsets[1] = {std::int32_t(size.width), std::int32_t(size.height), 1};
  vkCmdBlitImage(commands, from.handle(), VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, to,
                 VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &region, filter);
}

}  // namespace

std::vector<const char*> Swapchain::deviceExtensions() { return {VK_KHR_SWAPCHAIN_EXTENSION_NAME}; }

Swapchain::Swapchain(Device& device, VkSurfaceKHR surface) : device_(device), surface_(surface) {
  VkBool32 shows = VK_FALSE;
  check(
      vkGetPhysicalDeviceSurfaceSupportKHR(device.physical(), device.adapter().queueFamily, surface, &shows),
      "vkGetPhysicalDeviceSurfaceSupportKHR");
  if (!shows)
    throw Error({Fault::noDevice, "Vulkan device " + device.adapter().name +
                                      " cannot show pictures in this window; choose another with --device"});
  chooseFormat();
  acquired_ = makeSemaphore("image acquired");
}

Swapchain::~Swapchain() { device_.queue().settle(); }

// Pictures hold sRGB values already: an SRGB format would encode them once more.
void Swapchain::chooseFormat() {
  std::uint32_t count = 0;
  check(vkGetPhysicalDeviceSurfaceFormatsKHR(device_.physical(), surface_, &count, nullptr),
        "vkGetPhysicalDeviceSurfaceFormatsKHR");
  std::vector<VkSurfaceFormatKHR> formats(count);
  check(vkGetPhysicalDeviceSurfaceFormatsKHR(device_.physical(), surface_, &count, formats.data()),
        "vkGetPhysicalDeviceSurfaceFormatsKHR");
  for (const VkFormat wanted :
       {VK_FORMAT_B8G8R8A8_UNORM, VK_FORMAT_R8G8B8A8_UNORM, VK_FORMAT_A2B10G10R10_UNORM_PACK32})
    for (const VkSurfaceFormatKHR& format : formats)
      if (format.format == wanted && format.colorSpace == VK_COLOR_SPACE_SRGB_NONLINEAR_KHR) {
        format_ = format;
        return;
      }
  throw Error(
      {Fault::noDevice, "Vulkan device " + device_.adapter().name +
                            " offers the window no plain 8-bit format; choose another with --device"});
}

Unique<VkSemaphore> Swapchain::makeSemaphore(const char* name) const {
  VkSemaphoreCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO;
  return gpu::make(device_, vkCreateSemaphore, "vkCreateSemaphore", info, name);
}

bool Swapchain::make(VkExtent2D window) {
  VkSurfaceCapabilitiesKHR limits;
  check(vkGetPhysicalDeviceSurfaceCapabilitiesKHR(device_.physical(), surface_, &limits),
        "vkGetPhysicalDeviceSurfaceCapabilitiesKHR");
  constexpr std::uint32_t unknown = 0xffffffffu;
  const VkExtent2D size =
      limits.currentExtent.width == unknown ? clamped(window, limits) : limits.currentExtent;
  if (size.width == 0 || size.height == 0) return false;
  if (!(limits.supportedUsageFlags & VK_IMAGE_USAGE_TRANSFER_DST_BIT))
    throw Error(
        {Fault::noDevice, "Vulkan device " + device_.adapter().name +
                              " lets no picture be copied to this window; choose another with --device"});
  VkSwapchainCreateInfoKHR info{};
  info.sType = VK_STRUCTURE_TYPE_SWAPCHAIN_CREATE_INFO_KHR;
  info.surface = surface_;
  info.minImageCount = limits.minImageCount + 1;
  if (limits.maxImageCount > 0) info.minImageCount = std::min(info.minImageCount, limits.maxImageCount);
  info.imageFormat = format_.format;
  info.imageColorSpace = format_.colorSpace;
  info.imageExtent = size;
  info.imageArrayLayers = 1;
  info.imageUsage = VK_IMAGE_USAGE_TRANSFER_DST_BIT;
  info.imageSharingMode = VK_SHARING_MODE_EXCLUSIVE;
  info.preTransform = limits.currentTransform;
  info.compositeAlpha = alphaOf(limits);
  info.presentMode = VK_PRESENT_MODE_FIFO_KHR;
  info.clipped = VK_TRUE;
  info.oldSwapchain = now_.chain.get();
  device_.queue().wait(last_);
  auto made = gpu::make(device_, vkCreateSwapchainKHR, "vkCreateSwapchainKHR", info, "window");
  const VkSwapchainKHR chain = made.get();
  before_ = std::exchange(now_, Images{});
  now_.chain = std::move(made);
  now_.size = size;
  std::uint32_t count = 0;
  check(vkGetSwapchainImagesKHR(device_.handle(), chain, &count, nullptr), "vkGetSwapchainImagesKHR");
  now_.images.resize(count);
  check(vkGetSwapchainImagesKHR(device_.handle(), chain, &count, now_.images.data()),
        "vkGetSwapchainImagesKHR");
  for (VkImage image : now_.images) {
    device_.setName(image, "window image");
    now_.drawn.push_back(makeSemaphore("image drawn"));
  }
  return true;
}

Ticket Swapchain::copy(const Image& picture, std::uint32_t index) {
  Commands commands = device_.queue().begin("present");
  const VkImage image = now_.images[index];
  changeLayout(commands,
               {.image = image, .after = VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, .from = kCopy, .to = kCopy});
  const bool same = picture.size().width == now_.size.width && picture.size().height == now_.size.height;
  if (same && picture.format() == format_.format)
    recordCopy(commands, picture.handle(), image, now_.size);
  else
    recordBlit(commands, picture, image, now_.size, same ? VK_FILTER_NEAREST : VK_FILTER_LINEAR);
  changeLayout(commands, {.image = image,
                          .before = VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
                          .after = VK_IMAGE_LAYOUT_PRESENT_SRC_KHR,
                          .from = kCopy,
                          .to = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT});
  const auto waits = semaphoreInfo(acquired_.get(), kCopy);
  const auto signals = semaphoreInfo(now_.drawn[index].get(), VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT);
  return device_.queue().submit(std::move(commands), {&waits, 1}, {&signals, 1});
}

bool Swapchain::present(const Image& picture, VkExtent2D window) {
  if (window.width == 0 || window.height == 0) return false;
  device_.queue().wait(last_);
  const bool resized = window.width != now_.size.width || window.height != now_.size.height;
  if ((stale_ || resized) && !make(window)) return false;
  stale_ = false;
  std::uint32_t index = 0;
  VkResult result = vkAcquireNextImageKHR(device_.handle(), now_.chain.get(), kLongestAcquire,
                                          acquired_.get(), VK_NULL_HANDLE, &index);
  if (result == VK_ERROR_OUT_OF_DATE_KHR) {
    stale_ = true;
    return false;
  }
  if (result == VK_TIMEOUT || result == VK_NOT_READY) return false;
  stale_ = check(result, "vkAcquireNextImageKHR") == VK_SUBOPTIMAL_KHR;
  last_ = copy(picture, index);
  const VkSemaphore drawn = now_.drawn[index].get();
  const VkSwapchainKHR chain = now_.chain.get();
  VkPresentInfoKHR info{};
  info.sType = VK_STRUCTURE_TYPE_PRESENT_INFO_KHR;
  info.waitSemaphoreCount = 1;
  info.pWaitSemaphores = &drawn;
  info.swapchainCount = 1;
  info.pSwapchains = &chain;
  info.pImageIndices = &index;
  result = vkQueuePresentKHR(device_.queue().handle(), &info);
  if (result == VK_ERROR_OUT_OF_DATE_KHR) {
    stale_ = true;
    return false;
  }
  if (check(result, "vkQueuePresentKHR") == VK_SUBOPTIMAL_KHR) stale_ = true;
  return true;
}

}  // namespace vasa::gpu
