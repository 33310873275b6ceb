#pragma once
#include <vulkan/vulkan.h>

#include <string>
#include <vector>

#include "core/result.h"
#include "viewer/input.h"

struct GLFWwindow;

namespace vasa::viewer {

/// The one window, and what happens to it. Main thread only.
class Window {
 public:
  /// Fails (Fault::failed) where there is no display to open it on.
  /// @param width  [pixels]; 0: 1280 x 720 of an ordinary screen, at most what the screen has room for
  static Result<Window> open(const std::string& title, std::uint32_t width, std::uint32_t height);
  Window(Window&& other) noexcept;
  Window& operator=(Window&&) = delete;
  ~Window();

  /// Of the Vulkan instance that is to draw into the window.
  static std::vector<const char*> instanceExtensions();
  /// Throws gpu::Error. The caller destroys it, before the instance goes.
  VkSurfaceKHR makeSurface(VkInstance instance) const;

  /// Sleeps until something happens or `seconds` are over; 0 does not sleep.
  void wait(double seconds);
  /// What happened since the last call, in its order.
  std::vector<InputEvent> takeEvents();
  /// Ends a wait() from another thread.
  static void wake();

  /// [pixels] of its picture; both 0 while it is minimised.
  std::uint32_t width() const;
  std::uint32_t height() const;
  /// Pixels for one of an ordinary screen.
  float scale() const;
  void resize(std::uint32_t width, std::uint32_t height);
  /// Over all of the screen it is on, or back to where it was. @return whether it is
  bool setFullScreen(bool on);
  void setTitle(const std::string& title);
  enum class Pointer { arrow, text, hand, resizeAcross, resizeDown };
  void setPointer(Pointer pointer);
  GLFWwindow* handle() const;  ///< GLFW's own
  std::string clipboard() const;
  void setClipboard(const std::string& text);

 private:
  struct State;
  explicit Window(State* state) : state_(state) {}
  State* state_;
};

}  // namespace vasa::viewer
