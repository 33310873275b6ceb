#pragma once
#include <vulkan/vulkan.h>

#include <vector>

#include "gpu/image.h"
#include "gpu/queue.h"

namespace vasa::gpu {

/// The images that a window shows. Pictures are drawn elsewhere and copied to them, so that a window that
/// changes its size, or is none for a while, disturbs nobody but this class. One picture at a time is on its
/// way.
class Swapchain {
 public:
  /// @param surface  of the window, made from device.instance(); must outlive this
  /// Throws Error (Fault::noDevice) if the device cannot show pictures in this window.
  Swapchain(Device& device, VkSurfaceKHR surface);
  ~Swapchain();
  Swapchain(const Swapchain&) = delete;
  Swapchain& operator=(const Swapchain&) = delete;

  /// What a device needs beside the window system's instance extensions.
  static std::vector<const char*> deviceExtensions();

  /// Copies a picture to the window, scaled where the window's size is another just now. Images are made anew
  /// when the window asks for it.
  /// @param picture  finished, R8G8B8A8_UNORM with sRGB values in it, in VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL
  /// @param window   [pixels] of the window; no area (minimised): nothing is shown
  /// @return whether it was shown
  bool present(const Image& picture, VkExtent2D window);

 private:
  // What goes when the window changes.
  struct Images {
    Unique<VkSwapchainKHR> chain;
    std::vector<VkImage> images;
    std::vector<Unique<VkSemaphore>> drawn;  // one an image
    VkExtent2D size{};
  };
  void chooseFormat();
  bool make(VkExtent2D window);
  Unique<VkSemaphore> makeSemaphore(const char* name) const;
  Ticket copy(const Image& picture, std::uint32_t index);

  Device& device_;
  VkSurfaceKHR surface_;
  VkSurfaceFormatKHR format_{};
  Images now_, before_;  // `before_` may still be on the screen
  Unique<VkSemaphore> acquired_;
  Ticket last_;
  bool stale_ = true;
};

}  // namespace vasa::gpu
