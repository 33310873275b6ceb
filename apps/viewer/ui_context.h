#pragma once
#include "viewer/input.h"
#include "viewer/window.h"

struct ImDrawData;

namespace vasa::viewer {

/// Dear ImGui's context, style and fonts, fed with our input events rather than by the window itself: what a
/// script replays is all that the panels see. One at a time.
class UiContext {
 public:
  /// @param scale  pixels for one of an ordinary screen
  explicit UiContext(float scale);
  ~UiContext();
  UiContext(const UiContext&) = delete;
  UiContext& operator=(const UiContext&) = delete;

  void feed(const InputEvent& event);
  bool isHeld() const;        ///< a slider or a text is being changed
  bool wantsPointer() const;  ///< it is over a panel, or a panel has hold of it
  bool wantsKeys() const;     ///< text is being typed
  bool closePopups();
  /// A menu is open: arrow keys, Enter and Space are its own.
  bool inMenu() const;
  /// Keys go through menus from the next picture on, or no longer.
  void useKeysInMenus(bool on);
  bool alt() const;  ///< menus that are open. @return whether any was
  Window::Pointer pointer() const;

  /// Panels are declared between these two. @param seconds  since the last frame
  void begin(std::uint32_t width, std::uint32_t height, double seconds);
  ImDrawData& end();

  float scale() const { return scale_; }
  /// Copying and pasting go through the window.
  void useClipboard(Window& window);

 private:
  float scale_;
};

}  // namespace vasa::viewer
