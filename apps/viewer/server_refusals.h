#pragma once

namespace vasa::viewer {

/// Of the X server's: while this lives, a request that the server refuses is told as a warning (the first
/// one; with --verbose all) and the program goes on. Without it Xlib ends the program, in the middle of
/// whatever it does and with words of its own. Refusals come late, and of what a driver asked for:
/// SwiftShader takes its memory back before the server has looked at it where a swapchain lives too short a
/// time. Made after a window, since GLFW 3.3 gives Xlib its own way back when it has made one. One at a time,
/// main thread.
class ServerRefusals {
 public:
  ServerRefusals();
  ServerRefusals(const ServerRefusals&) = delete;
  ServerRefusals& operator=(const ServerRefusals&) = delete;
  ~ServerRefusals();
  /// For a window that goes: what is refused of it is nobody's concern, and told with --verbose alone.
  void hush();
};

}  // namespace vasa::viewer
