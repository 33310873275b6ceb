#include "viewer/actions.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <set>

using namespace vasa;
using namespace vasa::viewer;

TEST_CASE("no two actions have the same keys or the same id, and each tells what it does") {
  std::set<std::string> chords;
  std::set<int> ids;
  for (const Action& action : actions()) {
    CAPTURE(action.name);
    CHECK(ids.insert(int(action.id)).second);
    CHECK(&actionOf(action.id) == &action);
    CHECK(*action.what != 0);
    for (const Chord& chord : action.chords)
      if (chord.key != Key::none) CHECK_MESSAGE(chords.insert(chordText(chord)).second, chordText(chord));
  }
  // Digits that stand for views, and those that a kept view is called by.
  CHECK(chords.contains("1"));
  CHECK(chords.contains("Shift 1-9"));
}

TEST_CASE("keys mean what the table says, with what is held and nothing else") {
  ViewState state;
  applyShortcut(keyOf('L'), false, false, state, nullptr);
  CHECK(state.legend);
  applyShortcut(keyOf('L'), true, false, state, nullptr);
  CHECK(state.legend);
  applyShortcut(keyOf('O'), true, false, state, nullptr);
  CHECK(state.wishOpen);
  CHECK_FALSE(state.outliner.on);
  applyShortcut(keyOf('O'), false, false, state, nullptr);
  CHECK(state.outliner.on);
  applyShortcut(keyOf('S'), true, true, state, nullptr);  // nothing is open
  CHECK_FALSE(state.wishSaveAs);
  CHECK_FALSE(state.wishSave);
  const Document document;
  applyShortcut(keyOf('S'), true, true, state, &document);
  CHECK(state.wishSaveAs);
  CHECK_FALSE(state.wishSave);
}

TEST_CASE("views are kept under digits and gone to") {
  ViewState state;
  const Document document;
  applyShortcut(keyOf('3'), false, true, state, &document);  // none is kept
  CHECK(state.orbit == Orbit());
  state.orbit.orbit({0.7f, 0.2f});
  applyShortcut(keyOf('3'), true, true, state, &document);
  REQUIRE(state.views.size() == 1);
  CHECK(state.views[0].number == 3);
  const Camera there = state.orbit.camera(0, 1);
  applyShortcut(keyOf('1'), false, false, state, &document);
  CHECK(glm::distance(state.orbit.camera(0, 1).position, there.position) > 0.1f);
  applyShortcut(keyOf('1'), true, true, state, &document);
  CHECK(state.views[0].number == 1);  // by rising number
  applyShortcut(keyOf('3'), false, true, state, &document);
  CHECK(glm::distance(state.orbit.camera(0, 1).position, there.position) < 1e-4f);
  applyShortcut(keyOf('3'), true, true, state, &document);
  CHECK(state.views.size() == 2);
}

TEST_CASE("help lists every action that has keys, once") {
  std::size_t rows = 0, keyed = 0;
  for (std::size_t menu = 0; menu < kMenuNames.size(); ++menu) rows += shortcutsOf(MenuId(menu)).size();
  for (const Action& action : actions()) keyed += action.chords[0].key != Key::none;
  CHECK(rows == keyed);
  const auto edit = shortcutsOf(MenuId::edit);
  CHECK(std::ranges::any_of(edit, [](const Shortcut& row) { return row.keys == "Ctrl Y, Ctrl Shift Z"; }));
  CHECK(tipOf(actionOf(ActionId::undo)) == "Undo (Ctrl Z): undo edits, pose, look, view");
}

TEST_CASE("undo and redo can be done where there is something, and say what") {
  ViewState state;
  const Document document;
  const Action &undo = actionOf(ActionId::undo), &redo = actionOf(ActionId::redo);
  CHECK_FALSE(canDo(undo, state, &document));
  CHECK(titleOf(undo, state) == "Undo");
  state.undone = "move of left wrist";
  CHECK(canDo(undo, state, &document));
  CHECK_FALSE(canDo(redo, state, &document));
  CHECK(titleOf(undo, state) == "Undo move of left wrist");
  applyShortcut(keyOf('Z'), true, false, state, &document);
  CHECK(state.wishUndo);
}

TEST_CASE("each menu has a letter of its own") {
  for (std::size_t menu = 0; menu < kMenuNames.size(); ++menu)
    CHECK(menuOf(keyOf(kMenuNames[menu][0])) == int(menu));
  CHECK(menuOf(keyOf('Q')) == -1);
}
