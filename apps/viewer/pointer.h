#pragma once
#include <optional>

#include "viewer/input.h"
#include "viewer/layout.h"
#include "viewer/view_state.h"

namespace vasa::viewer {

/// A press and release in one place of the picture.
struct Click {
  vec2 place;          ///< [pixels] from the picture's top left corner
  bool twice = false;  ///< shortly after another one there
  bool right = false;  ///< with the right button
};

/// What the pointer does in the picture: left or middle button turns, with shift or the right button it moves
/// the picture, with control or the wheel it goes nearer. A left or right press that does not move is
/// a click.
class PointerTool {
 public:
  /// @param scale  pixels for one of an ordinary screen
  explicit PointerTool(float scale = 1) : scale_(scale) {}

  /// @param free  the pointer belongs to the picture, not to a panel; a drag that began in the picture goes
  /// on anywhere
  /// @param now   [s]
  std::optional<Click> feed(const InputEvent& event, const Rect& picture, bool free, double now,
                            ViewState& state);
  bool dragging() const { return held_.has_value() && moved_; }
  vec2 place() const { return place_; }
  bool shift() const { return shift_; }
  bool control() const { return control_; }

 private:
  void drag(vec2 way, const Rect& picture, ViewState& state) const;
  std::optional<Click> release(const Rect& picture, double now);

  float scale_;
  vec2 place_{0}, pressedAt_{0}, clickedAt_{-100};
  double clickedWhen_ = -10;
  std::optional<Button> held_;
  bool moved_ = false, shift_ = false, control_ = false;
};

}  // namespace vasa::viewer
