#pragma once
#include <cstdint>
#include <string>
#include <variant>

#include "math/types.h"

// What a person does, as the window reports it and as scripts replay it. Places are pixels of the window's
// picture, from its top left corner.
namespace vasa::viewer {

/// Keys that mean something here, by what is written on them. Letters and digits are their upper-case
/// characters.
enum class Key : std::uint16_t {
  none = 0,
  space = ' ',
  comma = ',',
  period = '.',
  slash = '/',
  digit0 = '0',
  letterA = 'A',
  escape = 256,
  enter,
  tab,
  backspace,
  insert,
  del,
  right,
  left,
  down,
  up,
  pageUp,
  pageDown,
  home,
  end,
  f1,
  f2,
  f3,
  f4,
  f5,
  f6,
  f7,
  f8,
  f9,
  f10,
  f11,
  f12,
  leftShift,
  leftControl,
  leftAlt,
  rightShift,
  rightControl,
  rightAlt,
  last,
};
constexpr Key keyOf(char letterOrDigit) { return Key(letterOrDigit); }

enum class Button : std::uint8_t { left, right, middle };

struct PointerMoved {
  vec2 place;
};
struct ButtonChanged {
  Button button = Button::left;
  bool down = false;
};
struct Scrolled {
  float steps = 0;  ///< > 0: away from the person
};
struct KeyChanged {
  Key key = Key::none;
  bool down = false;
};
struct TextTyped {
  std::uint32_t codepoint = 0;
};
struct WindowResized {
  std::uint32_t width = 0, height = 0;  ///< [pixels] 0: minimised
};
struct FileDropped {
  std::string path;
};
struct CloseAsked {};

using InputEvent = std::variant<PointerMoved, ButtonChanged, Scrolled, KeyChanged, TextTyped, WindowResized,
                                FileDropped, CloseAsked>;

}  // namespace vasa::viewer
