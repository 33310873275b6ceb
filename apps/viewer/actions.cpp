#include "viewer/actions.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace vasa::viewer {
namespace {

const Shortcut kMouse[] = {
    {"drag", "turn"},
    {"shift or right drag", "move"},
    {"wheel", "nearer, farther"},
    {"click", "choose a vessel; with Ctrl one more"},
    {"double click", "go to it"},
    {"right click", "what can be done with a vessel or joint"},
};

bool isDigit(Key key) { return key >= keyOf('1') && key <= keyOf('9'); }

const char* signOf(Key key) {
  constexpr std::pair<Key, const char*> kNames[] = {
      {Key::space, "Space"}, {Key::tab, "Tab"},   {Key::escape, "Esc"},  {Key::del, "Del"},
      {Key::home, "Home"},   {Key::left, "Left"}, {Key::right, "Right"}, {Key::up, "Up"},
      {Key::down, "Down"},   {Key::period, "."}};
  for (const auto& [known, name] : kNames)
    if (known == key) return name;
  return nullptr;
}

std::string textOf(Key key) {
  if (key == kAnyDigit) return "1-9";
  if (const char* name = signOf(key)) return name;
  if (key >= Key::f1 && key <= Key::f12) return fmt::format("F{}", int(key) - int(Key::f1) + 1);
  return std::string(1, char(key));
}

// The digit that is meant, 0 where none is; nothing where the chord is another.
std::optional<int> matches(const Chord& wanted, const Chord& pressed) {
  if (wanted.key == Key::none || wanted.control != pressed.control || wanted.shift != pressed.shift)
    return std::nullopt;
  if (wanted.key == kAnyDigit && isDigit(pressed.key)) return int(pressed.key) - '0';
  return wanted.key == pressed.key ? std::optional(0) : std::nullopt;
}

}  // namespace

std::string chordText(const Chord& chord) {
  if (chord.key == Key::none) return "";
  return fmt::format("{}{}{}", chord.control ? "Ctrl " : "", chord.shift ? "Shift " : "", textOf(chord.key));
}

const Action& actionOf(ActionId id) { return *std::ranges::find(actions(), id, &Action::id); }

bool canDo(const Action& action, const ViewState& state, const Document* document) {
  return !action.able || action.able(state, document);
}

void perform(ActionId id, ViewState& state, const Document* document) {
  const Action& action = actionOf(id);
  if (canDo(action, state, document)) action.act(state, document, 0);
}

std::string keysOf(const Action& action) { return chordText(action.chords[0]); }

std::string titleOf(const Action& action, const ViewState& state) {
  const std::string* about = action.id == ActionId::undo   ? &state.undone
                             : action.id == ActionId::redo ? &state.redone
                                                           : nullptr;
  return about && !about->empty() ? fmt::format("{} {}", action.name, *about) : action.name;
}

int menuOf(Key letter) {
  const auto found =
      std::ranges::find_if(kMenuNames, [&](const char* name) { return keyOf(name[0]) == letter; });
  return found == kMenuNames.end() ? -1 : int(found - kMenuNames.begin());
}

std::string tipOf(const Action& action) {
  const std::string keys = keysOf(action);
  return keys.empty() ? fmt::format("{}: {}", action.name, action.what)
                      : fmt::format("{} ({}): {}", action.name, keys, action.what);
}

void applyShortcut(Key key, bool control, bool shift, ViewState& state, const Document* document) {
  const Chord pressed{key, control, shift};
  for (const Action& action : actions())
    for (const Chord& chord : action.chords)
      if (const auto digit = matches(chord, pressed)) {
        if (canDo(action, state, document)) action.act(state, document, *digit);
        return;
      }
}

std::span<const Shortcut> mouseShortcuts() { return kMouse; }

std::vector<Shortcut> shortcutsOf(MenuId menu) {
  std::vector<Shortcut> rows;
  for (const Action& action : actions()) {
    if (action.menu != menu || action.chords[0].key == Key::none) continue;
    std::string text = chordText(action.chords[0]);
    if (action.chords[1].key != Key::none) text += ", " + chordText(action.chords[1]);
    rows.push_back({std::move(text), action.what});
  }
  return rows;
}

}  // namespace vasa::viewer
