#include "viewer/pointer.h"

namespace vasa::viewer {
namespace {

constexpr float kTurn = 2.2f * kPi;    // [rad] for a way as long as the picture is high
constexpr float kClickReach = 4;       // [pixels of an ordinary screen]
constexpr double kTwiceWithin = 0.4;   // [s]
constexpr float kStepsPerHeight = 15;  // of dolly

}  // namespace

std::optional<Click> PointerTool::feed(const InputEvent& event, const Rect& picture, bool free, double now,
                                       ViewState& state) {
  if (const auto* key = std::get_if<KeyChanged>(&event)) {
    if (key->key == Key::leftShift || key->key == Key::rightShift) shift_ = key->down;
    if (key->key == Key::leftControl || key->key == Key::rightControl) control_ = key->down;
  } else if (const auto* moved = std::get_if<PointerMoved>(&event)) {
    const vec2 way = moved->place - place_;
    place_ = moved->place;
    if (held_ && glm::distance(place_, pressedAt_) > kClickReach * scale_) moved_ = true;
    if (held_ && moved_) drag(way, picture, state);
  } else if (const auto* button = std::get_if<ButtonChanged>(&event)) {
    if (button->down && !held_ && free && picture.holds(place_)) {
      held_ = button->button;
      pressedAt_ = place_;
      moved_ = false;
    } else if (!button->down && held_ == button->button) {
      return release(picture, now);
    }
  } else if (const auto* scrolled = std::get_if<Scrolled>(&event);
             scrolled && free && picture.holds(place_)) {
    const vec2 middle{picture.left + picture.width / 2, picture.top + picture.height / 2};
    const vec2 place = (place_ - middle) * vec2(2, -2) / picture.height;
    state.orbit.dolly(scrolled->steps, place);
  }
  return std::nullopt;
}

void PointerTool::drag(vec2 way, const Rect& picture, ViewState& state) const {
  if (held_ == Button::right || shift_)
    state.orbit.pan(way, picture.height);
  else if (control_)
    state.orbit.dolly(-way.y / picture.height * kStepsPerHeight);
  else
    state.orbit.orbit(way / picture.height * kTurn * 0.5f);
}

std::optional<Click> PointerTool::release(const Rect& picture, double now) {
  const bool click = held_ != Button::middle && !moved_;
  const bool right = held_ == Button::right;
  held_.reset();
  if (!click) return std::nullopt;
  if (right) return Click{.place = place_ - vec2(picture.left, picture.top), .right = true};
  const bool twice =
      now - clickedWhen_ < kTwiceWithin && glm::distance(place_, clickedAt_) <= kClickReach * scale_;
  clickedWhen_ = twice ? -10 : now;
  clickedAt_ = place_;
  return Click{.place = place_ - vec2(picture.left, picture.top), .twice = twice};
}

}  // namespace vasa::viewer
