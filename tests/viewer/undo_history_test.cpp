#include "viewer/undo_history.h"

#include <doctest/doctest.h>

using namespace vasa;
using namespace vasa::viewer;

TEST_CASE("whatever changes is undone and redone, step by step; a drag is one step") {
  ViewState state;
  UndoHistory history;
  history.start(state);
  CHECK_FALSE(history.undo(state));
  for (int i = 1; i <= 5; ++i) {
    state.orbit.orbit({0.1f, 0});
    history.watch(state, i < 5);
  }
  const Orbit turned = state.orbit;
  state.look.drawSkin = false;
  history.watch(state, false);
  state.turns.push_back({JointId{3}, {0.5f, 0, 0}});
  history.watch(state, false);
  state.journal.push_back("occlude \"a\" 0.5");  // not a step yet: undo makes it one
  state.panels = false;
  REQUIRE(history.undo(state));
  CHECK(state.journal.empty());
  CHECK_FALSE(state.panels);  // how the window is laid out is nobody's step
  CHECK(state.turns.size() == 1);
  REQUIRE(history.undo(state));
  CHECK(state.turns.empty());
  REQUIRE(history.undo(state));
  CHECK(state.look.drawSkin);
  CHECK(state.orbit == turned);
  REQUIRE(history.undo(state));
  CHECK(state.orbit == Orbit());
  CHECK_FALSE(history.undo(state));
  for (int i = 0; i < 4; ++i) REQUIRE(history.redo(state));
  CHECK(state.journal.size() == 1);
  CHECK_FALSE(history.redo(state));
  REQUIRE(history.undo(state));
  state.cut = 0.5f;  // something new: nothing to redo any more
  history.watch(state, false);
  CHECK_FALSE(history.redo(state));
}

TEST_CASE(
    "edits and poses are unsaved until they are saved or undone; a joint that is only shown is not turned") {
  ViewState state;
  UndoHistory history;
  history.start(state);
  state.turns.push_back({JointId{3}, vec3(0)});
  state.orbit.orbit({1, 0});
  history.watch(state, false);
  CHECK_FALSE(history.unsaved(state));
  state.turns[0].angles.x = 0.1f;
  history.watch(state, false);
  CHECK(history.unsaved(state));
  REQUIRE(history.undo(state));
  CHECK_FALSE(history.unsaved(state));
  REQUIRE(history.redo(state));
  history.markSaved(state);
  CHECK_FALSE(history.unsaved(state));
}
