#include <algorithm>

#include "viewer/actions.h"
#include "viewer/kept_views.h"
#include "viewer/pose_tool.h"

// What can be done, in the order of the menus.
namespace vasa::viewer {
namespace {

constexpr Chord plain(Key key) { return {key, false, false}; }
constexpr Chord plain(char key) { return {keyOf(key), false, false}; }
constexpr Chord ctrl(char key) { return {keyOf(key), true, false}; }
constexpr Chord shift(char key) { return {keyOf(key), false, true}; }
constexpr Chord ctrlShift(char key) { return {keyOf(key), true, true}; }

using State = ViewState;
using Shown = const Document*;

bool loaded(const State&, Shown document) { return document; }
bool undoable(const State& state, Shown document) { return document && !state.undone.empty(); }
bool redoable(const State& state, Shown document) { return document && !state.redone.empty(); }
bool anyChosen(const State& state, Shown document) { return document && state.selected; }
bool editable(const State& state, Shown document) { return anyChosen(state, document) && state.editing; }
bool moving(const State& state, Shown document) { return document && state.playback.clip >= 0; }
bool posing(const State& state, Shown document) { return document && state.posing; }

void chooseNext(State& state, const Document& document, int way) {
  const auto& clips = document.scene.body.clips;
  const int count = int(clips.size()) + 1;  // rest, too
  state.playback.clip = (state.playback.clip + 1 + way + count) % count - 1;
  if (state.playback.clip >= 0) state.playback.time = clips[std::size_t(state.playback.clip)].start;
}

void stepFrames(State& state, const Document& document, int frames) {
  state.playback.step(document.scene.body.clips[std::size_t(state.playback.clip)], frames);
}

void measureFrom(State& state, bool measuring) {
  state.measuring = measuring;
  if (!measuring) state.from = state.to = std::nullopt;
}

void chooseNothing(State& state) {
  state.selected.reset();
  state.alsoChosen.clear();
  state.isolate = false;
  measureFrom(state, false);
}

// All of them have their names, or none.
void toggleLabels(State& state, const Network& network) {
  const std::vector<VesselId> chosen = chosenVessels(state);
  const bool all =
      std::ranges::all_of(chosen, [&](VesselId v) { return state.labelled.has(network.vessel(v).name); });
  state.labelled.set(network, chosen, !all);
}

void editWith(State& state, EditTool tool) {
  state.editing = true;
  state.editTool = tool;
}

}  // namespace

std::span<const Action> actions() {
  using enum ActionId;
  // clang-format off
  static constexpr Action kActions[] = {
      {open, MenuId::file, "Open...", {ctrl('O')}, "open a scene, a body, vessels or a motion",
       [](State& s, Shown, int) { s.wishOpen = true; }},
      {save, MenuId::file, "Save", {ctrl('S')}, "save the scene",
       [](State& s, Shown, int) { s.wishSave = true; }, loaded, nullptr, true},
      {saveAs, MenuId::file, "Save as...", {ctrlShift('S')}, "save the scene to another file",
       [](State& s, Shown, int) { s.wishSaveAs = true; }, loaded},
      {exportFiles, MenuId::file, "Export...", {ctrl('E')}, "vessels, pictures and films to files for other programs",
       [](State& s, Shown, int) { s.wishExport = true; }, loaded},
      {picture, MenuId::file, "Picture", {plain(Key::f12)}, "picture to a file",
       [](State& s, Shown, int) { s.wishPicture = true; }, loaded, nullptr, true},
      {copyPicture, MenuId::file, "Copy picture", {ctrlShift('C')}, "picture to a file and to the clipboard",
       [](State& s, Shown, int) { s.wishCopyPicture = true; }, loaded},
      {record, MenuId::file, "Record", {plain('R')}, "record a video of what is shown",
       [](State& s, Shown, int) { s.recording = !s.recording; }, loaded, [](const State& s) { return s.recording; }},
      {quit, MenuId::file, "Quit", {ctrl('Q')}, "quit",
       [](State& s, Shown, int) { s.wishQuit = true; }, nullptr, nullptr, true},

      {undo, MenuId::edit, "Undo", {ctrl('Z')}, "undo edits, pose, look, view",
       [](State& s, Shown, int) { s.wishUndo = true; }, undoable},
      {redo, MenuId::edit, "Redo", {ctrl('Y'), ctrlShift('Z')}, "redo",
       [](State& s, Shown, int) { s.wishRedo = true; }, redoable},
      {find, MenuId::edit, "Find", {ctrl('F')}, "search vessels by a few letters",
       [](State& s, Shown, int) { s.wishSearch = s.panels = true; }, loaded, nullptr, true},
      {measure, MenuId::edit, "Measure", {plain('M')}, "measure along the vessels",
       [](State& s, Shown, int) { measureFrom(s, !s.measuring); }, loaded, [](const State& s) { return s.measuring; }},
      {nothing, MenuId::edit, "Choose nothing", {plain(Key::escape)}, "choose nothing; leave a menu or dialog; give up opening",
       [](State& s, Shown, int) { chooseNothing(s); }},
      {edit, MenuId::edit, "Edit vessels", {plain('E')}, "edit: drag, narrow, widen, branch, graft",
       [](State& s, Shown, int) { s.editing = !s.editing; }, loaded, [](const State& s) { return s.editing; }, true},
      {stenosis, MenuId::edit, "Stenosis, radius...", {}, "narrow or widen the chosen vessel at its place",
       [](State& s, Shown, int) { editWith(s, EditTool::change); }, anyChosen},
      {branch, MenuId::edit, "Branch...", {}, "a branch from the chosen place to where you click",
       [](State& s, Shown, int) { editWith(s, EditTool::branch); }, anyChosen},
      {graft, MenuId::edit, "Graft...", {}, "a graft from the chosen place to the vessel that you click, past places that you click before",
       [](State& s, Shown, int) { editWith(s, EditTool::graft); }, anyChosen},
      {remove, MenuId::edit, "Delete vessel", {plain(Key::del)}, "delete the chosen vessel, while editing",
       [](State& s, Shown, int) { s.wishDelete = true; }, editable},
      {removeTree, MenuId::edit, "Delete with branches", {Chord{Key::del, false, true}}, "delete it with all that hangs on it",
       [](State& s, Shown, int) { s.wishDeleteTree = true; }, editable},

      {focus, MenuId::view, "Go to vessel", {plain('F'), plain(Key::period)}, "to the chosen vessel",
       [](State& s, Shown, int) { s.wishFocus = true; }, anyChosen},
      {home, MenuId::view, "Whole body", {plain(Key::home)}, "all of the body",
       [](State& s, Shown, int) { s.wishHome = true; }, loaded},
      {front, MenuId::view, "Front", {plain('1')}, "from the front",
       [](State& s, Shown, int) { s.orbit.look(View::front); }, nullptr, nullptr, true},
      {back, MenuId::view, "Back", {ctrl('1')}, "from the back",
       [](State& s, Shown, int) { s.orbit.look(View::back); }},
      {leftSide, MenuId::view, "Left side", {plain('3')}, "from the body's left side",
       [](State& s, Shown, int) { s.orbit.look(View::left); }},
      {rightSide, MenuId::view, "Right side", {ctrl('3')}, "from its right side",
       [](State& s, Shown, int) { s.orbit.look(View::right); }},
      {above, MenuId::view, "Above", {plain('7')}, "from above",
       [](State& s, Shown, int) { s.orbit.look(View::top); }},
      {below, MenuId::view, "Below", {ctrl('7')}, "from below",
       [](State& s, Shown, int) { s.orbit.lookFromBelow(); }},
      {orthographic, MenuId::view, "Orthographic", {plain('5')}, "without perspective",
       [](State& s, Shown, int) { s.orbit.setOrthographic(!s.orbit.orthographic()); }, nullptr,
       [](const State& s) { return s.orbit.orthographic(); }},
      {goToKept, MenuId::view, "Kept views", {shift(char(kAnyDigit))}, "to a view that was kept",
       [](State& s, Shown, int digit) { goToView(s.views, unsigned(digit), s.orbit); },
       [](const State& s, Shown) { return !s.views.empty(); }, nullptr, true},
      {keep, MenuId::view, "Keep view as", {ctrlShift(char(kAnyDigit))}, "keep this view under a number",
       [](State& s, Shown, int digit) { keepView(s.views, viewOf(s.orbit, unsigned(digit))); }, loaded},
      {hide, MenuId::view, "Hide", {plain('H')}, "hide what is chosen",
       [](State& s, Shown d, int) { s.hidden.set(d->scene.network, chosenVessels(s), true); }, anyChosen, nullptr, true},
      {hideOthers, MenuId::view, "Hide all else", {shift('H')}, "hide all but what is chosen",
       [](State& s, Shown d, int) { s.hidden.setAllBut(d->scene.network, chosenVessels(s)); }, anyChosen},
      {showAll, MenuId::view, "Show all", {ctrl('H')}, "show all vessels",
       [](State& s, Shown, int) { s.hidden.clear(); }, [](const State& s, Shown) { return s.hidden.any(); }},
      {isolate, MenuId::view, "Only its tree", {plain('I')}, "only the chosen vessel and what it gives off",
       [](State& s, Shown, int) { s.isolate = !s.isolate; }, anyChosen, [](const State& s) { return s.isolate; }},
      {colour, MenuId::view, "Next colouring", {plain('K')}, "colour by kind, blood, region, radius, strain, bend, lumen",
       [](State& s, Shown, int) { setColouring(s, atlas::Colouring((int(s.colouring) + 1) % int(atlas::kColourings.size()))); }, nullptr, nullptr, true},
      {legend, MenuId::view, "Legend", {plain('L')}, "what the colours mean",
       [](State& s, Shown, int) { s.legend = !s.legend; }, nullptr, [](const State& s) { return s.legend; }},
      {label, MenuId::view, "Name it", {plain('N')}, "names of chosen vessels stay in the picture, or go",
       [](State& s, Shown d, int) { toggleLabels(s, d->scene.network); }, anyChosen},
      {contacts, MenuId::view, "Contacts", {plain('C')}, "where vessels ran through one another",
       [](State& s, Shown, int) { s.contacts = !s.contacts; }, nullptr, [](const State& s) { return s.contacts; }},
      {cut, MenuId::view, "Cutting plane", {plain('X')}, "cut through the body",
       [](State& s, Shown, int) { s.cutPlane.on = !s.cutPlane.on; }, nullptr, [](const State& s) { return s.cutPlane.on; }},
      {outliner, MenuId::view, "List of vessels", {plain('O')}, "list of all vessels; Up, Down there: another one",
       [](State& s, Shown, int) { s.outliner.on = !s.outliner.on; }, nullptr, [](const State& s) { return s.outliner.on; }, true},
      {panels, MenuId::view, "Panels", {plain(Key::tab)}, "menus and panels, or the picture alone",
       [](State& s, Shown, int) { s.panels = !s.panels; }, nullptr, [](const State& s) { return s.panels; }},
      {fullScreen, MenuId::view, "Full screen", {plain(Key::f11)}, "all of the screen",
       [](State& s, Shown, int) { s.wishFullScreen = true; }, nullptr, [](const State& s) { return s.fullScreen; }},

      {pose, MenuId::pose, "Drag joints", {plain('P')}, "pose: drag wrists, knees, head; with Ctrl one joint alone",
       [](State& s, Shown, int) { s.posing = !s.posing; }, loaded, [](const State& s) { return s.posing; }},
      {bothSides, MenuId::pose, "Both sides", {}, "the body's other side does what is done to one",
       [](State& s, Shown, int) { s.bothSides = !s.bothSides; }, loaded, [](const State& s) { return s.bothSides; }},
      {copyPose, MenuId::pose, "Copy pose", {ctrl('C')}, "copy the pose as text, while posing",
       [](State& s, Shown, int) { s.wishCopyPose = true; }, posing, nullptr, true},
      {pastePose, MenuId::pose, "Paste pose", {ctrl('V')}, "paste a pose, while posing",
       [](State& s, Shown, int) { s.wishPastePose = true; }, posing},
      {mirrorPose, MenuId::pose, "Mirror pose", {}, "left and right change places",
       [](State& s, Shown d, int) { s.turns = mirroredTurns(*d->mannequin, s.turns); }, loaded},
      {resetPose, MenuId::pose, "Reset pose", {}, "the clip's pose",
       [](State& s, Shown, int) { s.turns.clear(); }, [](const State& s, Shown) { return !s.turns.empty(); }},
      {play, MenuId::pose, "Play", {plain(Key::space)}, "play, pause",
       [](State& s, Shown, int) { s.playback.playing = !s.playback.playing; }, moving,
       [](const State& s) { return s.playback.playing; }, true},
      {frameBack, MenuId::pose, "Frame back", {plain(Key::left)}, "a frame back",
       [](State& s, Shown d, int) { stepFrames(s, *d, -1); }, moving},
      {frameOn, MenuId::pose, "Frame on", {plain(Key::right)}, "a frame on",
       [](State& s, Shown d, int) { stepFrames(s, *d, 1); }, moving},
      {clipBefore, MenuId::pose, "Clip before", {plain(Key::up)}, "the clip before",
       [](State& s, Shown d, int) { chooseNext(s, *d, -1); }, loaded},
      {clipAfter, MenuId::pose, "Clip after", {plain(Key::down)}, "the clip after",
       [](State& s, Shown d, int) { chooseNext(s, *d, 1); }, loaded},

      {keys, MenuId::help, "Keys and mouse", {plain(Key::f1)}, "these keys",
       [](State& s, Shown, int) { s.help = !s.help; }, nullptr, [](const State& s) { return s.help; }},
      {profile, MenuId::help, "Profile", {plain(Key::f9)}, "measure how fast this machine draws: Table III",
       [](State& s, Shown, int) { s.wishProfile = true; }, loaded, nullptr, true},
  };
  // clang-format on
  return kActions;
}

}  // namespace vasa::viewer
