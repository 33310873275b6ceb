#include "viewer/shortcuts.h"

#include <utility>

namespace vasa::viewer {
namespace {

constexpr Shortcut kShortcuts[] = {
    {"drag", "turn"},
    {"shift or right drag", "move"},
    {"wheel", "nearer, farther"},
    {"click", "choose a vessel; with Ctrl one more"},
    {"double click", "go to it"},
    {"Space", "play, pause"},
    {"Left, Right", "a frame back, on"},
    {"Up, Down", "another clip"},
    {"1 3 7", "from the front, side, top; with Ctrl from the other side"},
    {"5", "orthographic"},
    {"Home", "all of the body"},
    {"F or .", "to the chosen vessel"},
    {"I", "only the chosen vessel and its tree"},
    {"O", "list of all vessels; Up, Down there: another one"},
    {"H", "hide what is chosen; Shift: all else; Ctrl: show all"},
    {"K, L", "colour by kind, blood, region, radius, strain, bend, lumen; legend"},
    {"M", "measure along the vessels"},
    {"P", "pose: drag wrists, knees, head; with Ctrl one joint alone"},
    {"Ctrl C, Ctrl V", "copy and paste the pose, while posing"},
    {"E", "edit: drag, narrow, widen, branch, graft"},
    {"Del", "delete the chosen vessel, while editing"},
    {"Ctrl Z", "undo edits, pose, look, view"},
    {"Ctrl Y", "redo; Ctrl Shift Z, too"},
    {"Ctrl S", "save the scene"},
    {"X", "cutting plane"},
    {"R", "record a video"},
    {"C", "contacts"},
    {"Tab", "panels"},
    {"Ctrl F", "search"},
    {"F9", "profile: Table III"},
    {"F12", "picture to a file"},
    {"Esc", "choose nothing; give up opening"},
    {"F1", "these keys"},
    {"Ctrl Q", "quit"},
};

void chooseNext(ViewState& state, const Document& document, int way) {
  const auto& clips = document.scene.body.clips;
  const int count = int(clips.size()) + 1;  // rest, too
  state.playback.clip = (state.playback.clip + 1 + way + count) % count - 1;
  if (state.playback.clip >= 0) state.playback.time = clips[std::size_t(state.playback.clip)].start;
}

void stepFrames(ViewState& state, const Document& document, int frames) {
  if (state.playback.clip >= 0)
    state.playback.step(document.scene.body.clips[std::size_t(state.playback.clip)], frames);
}

void choose(ViewState& state, bool measuring) {
  state.measuring = measuring;
  if (!measuring) state.from = state.to = std::nullopt;
}

void hide(bool control, bool shift, ViewState& state, const Network& network) {
  const std::vector<VesselId> chosen = chosenVessels(state);
  if (control)
    state.hidden.clear();
  else if (shift && !chosen.empty())
    state.hidden.leaveOnly(network, chosen);
  else
    state.hidden.set(network, chosen, true);
}

}  // namespace

std::span<const Shortcut> shortcuts() { return kShortcuts; }

void applyShortcut(Key key, bool control, bool shift, ViewState& state, const Document* document) {
  switch (key) {
    case Key::space:
      state.playback.playing = document && state.playback.clip >= 0 && !state.playback.playing;
      return;
    case Key::tab:
      state.panels = !state.panels;
      return;
    case Key::f1:
      state.help = !state.help;
      return;
    case Key::home:
      state.wishHome = true;
      return;
    case Key::period:
      state.wishFocus = true;
      return;
    case Key::f9:
      state.wishProfile = true;
      return;
    case Key::f12:
      state.wishPicture = true;
      return;
    case Key::escape:
      if (std::exchange(state.asking, false)) return;
      state.selected.reset();
      state.alsoChosen.clear();
      state.isolate = state.help = false;
      choose(state, false);
      return;
    case Key::del:
      state.wishDelete = state.editing;
      return;
    case Key::left:
    case Key::right:
      if (document) stepFrames(state, *document, key == Key::left ? -1 : 1);
      return;
    case Key::up:
    case Key::down:
      if (document) chooseNext(state, *document, key == Key::up ? -1 : 1);
      return;
    default:
      break;
  }
  if (key == keyOf('1')) state.orbit.look(control ? View::back : View::front);
  if (key == keyOf('3')) state.orbit.look(control ? View::right : View::left);
  if (key == keyOf('7')) control ? state.orbit.lookFromBelow() : state.orbit.look(View::top);
  if (key == keyOf('5')) state.orbit.setOrthographic(!state.orbit.orthographic());
  if (key == keyOf('F')) (control ? state.wishSearch : state.wishFocus) = true;
  if (key == keyOf('I')) state.isolate = !state.isolate && state.selected;
  if (key == keyOf('O')) state.outliner.on = !state.outliner.on;
  if (key == keyOf('H') && document) hide(control, shift, state, document->scene.network);
  if (key == keyOf('K'))
    state.colouring = atlas::Colouring((int(state.colouring) + 1) % int(atlas::kColourings.size())),
    state.legend = true;
  if (key == keyOf('L')) state.legend = !state.legend;
  if (key == keyOf('M')) choose(state, !state.measuring);
  if (key == keyOf('P')) state.posing = !state.posing;
  if (key == keyOf('E') && !control) state.editing = !state.editing;
  if (key == keyOf('Z') && control) (shift ? state.wishRedo : state.wishUndo) = true;
  if (key == keyOf('Y') && control) state.wishRedo = true;
  if (key == keyOf('S') && control) state.wishSave = true;
  if (key == keyOf('X') && !control) state.cutPlane.on = !state.cutPlane.on;
  if (key == keyOf('R')) state.recording = !state.recording;
  if (key == keyOf('C') && !control) state.contacts = !state.contacts;
  if (key == keyOf('C') && control) state.wishCopyPose = state.posing;
  if (key == keyOf('V') && control) state.wishPastePose = state.posing;
  if (key == keyOf('Q') && control) state.wishQuit = true;
}

}  // namespace vasa::viewer
