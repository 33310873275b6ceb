#pragma once
#include <array>
#include <span>
#include <string>

#include "viewer/document.h"
#include "viewer/input.h"
#include "viewer/view_state.h"

namespace vasa::viewer {

/// A key and what is held with it.
struct Chord {
  Key key = Key::none;
  bool control = false, shift = false;
  bool operator==(const Chord&) const = default;
};
/// "Ctrl Shift S"; of any digit "1-9".
std::string chordText(const Chord& chord);
constexpr Key kAnyDigit = Key::digit0;  ///< as a chord's key: 1 to 9

enum class ActionId : std::uint8_t {
  open,
  save,
  saveAs,
  exportFiles,
  picture,
  copyPicture,
  record,
  quit,
  undo,
  redo,
  find,
  edit,
  stenosis,
  branch,
  graft,
  remove,
  removeTree,
  measure,
  nothing,
  focus,
  hide,
  hideOthers,
  showAll,
  isolate,
  colour,
  legend,
  label,
  contacts,
  cut,
  home,
  front,
  back,
  leftSide,
  rightSide,
  above,
  below,
  orthographic,
  goToKept,
  keep,
  outliner,
  panels,
  fullScreen,
  pose,
  bothSides,
  resetPose,
  mirrorPose,
  copyPose,
  pastePose,
  play,
  frameBack,
  frameOn,
  clipBefore,
  clipAfter,
  keys,
  profile,
};
enum class MenuId : std::uint8_t { file, edit, view, pose, help };
constexpr std::array<const char*, 5> kMenuNames{"File", "Edit", "View", "Pose", "Help"};

/// Something that a person can do, told once: keys, menus, tools, tips and help all read it from here.
struct Action {
  ActionId id;
  MenuId menu;
  const char* name;             ///< in menus
  std::array<Chord, 2> chords;  ///< keys; none: of menus alone
  const char* what;             ///< in tips and help
  void (*act)(ViewState&, const Document*, int digit);
  /// Whether it can be done now; null: always.
  bool (*able)(const ViewState&, const Document*) = nullptr;
  bool (*on)(const ViewState&) = nullptr;  ///< whether it is ticked; null: nothing to tick
  bool first = false;                      ///< of a group: a line is drawn above it
};

/// All of them, menu after menu.
std::span<const Action> actions();
const Action& actionOf(ActionId id);
bool canDo(const Action& action, const ViewState& state, const Document* document);
/// Nothing where it cannot be done now.
void perform(ActionId id, ViewState& state, const Document* document);

/// Its first keys; empty: none.
std::string keysOf(const Action& action);
/// In menus: its name, of undo and redo with what they are about.
std::string titleOf(const Action& action, const ViewState& state);
/// "Save (Ctrl S): save the scene".
std::string tipOf(const Action& action);
/// The menu whose name begins with a letter; -1: none.
int menuOf(Key letter);

/// What a pressed key does.
void applyShortcut(Key key, bool control, bool shift, ViewState& state, const Document* document);

/// Keys or what a mouse does, and what comes of it, for help texts.
struct Shortcut {
  std::string keys, what;
};
/// What the mouse does in the picture.
std::span<const Shortcut> mouseShortcuts();
/// Of the actions of a menu that have keys.
std::vector<Shortcut> shortcutsOf(MenuId menu);

}  // namespace vasa::viewer
