#include <fmt/format.h>

#include "core/log.h"
#include "viewer/actions.h"
#include "viewer/session.h"

// How a session comes by its input: from the window or from a script, never more than one change of a button
// or key a frame, and none in the frame of a move, because ImGui sees states, not changes, and learns in a
// frame what is under the pointer.
namespace vasa::viewer {
namespace {

bool changesState(const InputEvent& event) {
  return std::holds_alternative<ButtonChanged>(event) || std::holds_alternative<KeyChanged>(event);
}

bool isArrow(Key key) { return key == Key::up || key == Key::down; }

bool isOfMenus(Key key) {
  return isArrow(key) || key == Key::left || key == Key::right || key == Key::space || key == Key::enter;
}

}  // namespace

void Session::gather() {
  takeWindowEvents();
  if (options_.script && events_.empty()) takeScript();
  bool moved = false;
  while (!events_.empty() && !(moved && changesState(events_.front()))) {
    const InputEvent event = std::move(events_.front());
    events_.pop_front();
    handle(event);
    panelFrames_ = kRestingFrames;
    moved = true;
    if (changesState(event)) break;
  }
  recorder_.endFrame();
}

// A script's window keeps its size to what is asked of it; of the window's own events only that counts then.
void Session::takeWindowEvents() {
  for (InputEvent& event : window_.takeEvents())
    if (!options_.script || std::holds_alternative<WindowResized>(event)) events_.push_back(std::move(event));
}

void Session::takeScript() {
  if (passing_ > 0) {
    --passing_;
    return;
  }
  if (liveUntil_ && Clock::now() < *liveUntil_) return;
  liveUntil_.reset();
  if (saving_ || (settling_ && !idle())) return;
  settling_ = false;
  while (step_ < options_.script->size()) {
    const ScriptStep& step = (*options_.script)[step_++];
    if (const auto* event = std::get_if<InputEvent>(&step)) {
      events_.push_back(*event);
      if (changesState(*event)) return;
    } else if (const auto* frames = std::get_if<LetFrames>(&step)) {
      passing_ = frames->count - 1;
      return;
    } else if (const auto* live = std::get_if<GoLive>(&step)) {
      last_ = Clock::now();
      liveUntil_ =
          last_ + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(live->seconds));
      return;
    } else if (std::holds_alternative<Settle>(step)) {
      settling_ = true;
      return;
    } else if (const auto* size = std::get_if<ResizeWindow>(&step)) {
      window_.resize(size->width, size->height);
      for (int i = 0; i < 40 && (window_.width() != size->width || window_.height() != size->height); ++i)
        window_.wait(0.05);
      takeWindowEvents();
      return;
    } else {
      saving_ = std::get<SavePicture>(step);
      return;
    }
  }
  ending_ = true;
}

// What the device cannot draw is drawn smaller and shown enlarged.
void Session::takeSize(std::uint32_t width, std::uint32_t height) {
  constexpr std::uint32_t kPixelBytes = 4;
  const VkPhysicalDeviceLimits& limits = device_.limits();
  const bool wasWhole = drawnShare_ == vec2(1);
  const uvec2 window(width, height),
      drawn = drawnSize(window, limits.maxImageDimension2D, limits.maxStorageBufferRange / kPixelBytes);
  width_ = drawn.x;
  height_ = drawn.y;
  drawnShare_ = width > 0 && height > 0 ? vec2(drawn) / vec2(window) : vec2(1);
  if (drawn == window || !wasWhole) return;
  std::string told = fmt::format(
      "The window's {}x{} pixels are more than the device can draw: it is drawn with {}x{} and enlarged; a "
      "smaller window is sharper",
      width, height, drawn.x, drawn.y);
  if (options_.script)
    logWarning(told);
  else
    say(std::move(told), 8);
}

// Places in the window as it is drawn.
InputEvent Session::asDrawn(InputEvent event) const {
  if (auto* moved = std::get_if<PointerMoved>(&event)) moved->place *= drawnShare_;
  return event;
}

void Session::handle(const InputEvent& given) {
  recorder_.add(given);
  const InputEvent event = asDrawn(given);
  ui_.feed(event);
  if (const auto* size = std::get_if<WindowResized>(&event)) {
    takeSize(size->width, size->height);
  } else if (const auto* key = std::get_if<KeyChanged>(&event)) {
    if (key->down && key->key == Key::escape)
      escape();
    else if (askForMenu(*key) || (ui_.inMenu() && isOfMenus(key->key)))
      ;  // the menus' own
    else if (key->down && !files_.isOpen() && !ui_.wantsKeys() &&
             !(state_.outliner.focused && isArrow(key->key)))
      applyShortcut(key->key, pointer_.control(), pointer_.shift(), state_, document_.get());
  } else if (const auto* file = std::get_if<FileDropped>(&event)) {
    dropped_.emplace_back(file->path);
  } else if (std::holds_alternative<CloseAsked>(event)) {
    state_.wishQuit = true;
  } else if (std::holds_alternative<Scrolled>(event)) {
    scrolledAt_ = now_;
  }
  if (std::holds_alternative<PointerMoved>(event)) movedAt_ = now_, state_.pointedAt.reset();
  const bool free = !ui_.wantsPointer();
  if (const auto* moved = std::get_if<PointerMoved>(&event); moved && !poseTool_.held())
    poseTool_.hover(moved->place);
  const bool posing = state_.posing && document_ && body_ && (free || poseTool_.held());
  const bool posed = posing && poseTool_.feed(event, pointer_.control(), *document_, *body_, cameraNow(),
                                              pictureRect(), state_);
  if (posed && !std::holds_alternative<PointerMoved>(event)) return;
  if (const auto* moved = std::get_if<PointerMoved>(&event); moved && !editor_.held())
    editor_.hover(moved->place);
  const bool editing = state_.editing && document_ && body_ && (free || editor_.held());
  const bool edited = editing && editor_.feed(event, *document_, *body_, cameraNow(), pictureRect(), state_);
  if (edited && !std::holds_alternative<PointerMoved>(event)) return;
  if (const auto clicked = pointer_.feed(event, pictureRect(), free, now_, state_)) click(*clicked);
}

// Alt and a menu's first letter open it; Alt alone, or F10, the first one.
bool Session::askForMenu(const KeyChanged& key) {
  const bool isAlt = key.key == Key::leftAlt || key.key == Key::rightAlt;
  const bool tapped = isAlt && !key.down && altAlone_;
  altAlone_ = isAlt && key.down;
  if (!state_.panels || files_.isOpen()) return false;
  const int menu = tapped || (key.down && key.key == Key(int(Key::f1) + 9)) ? 0
                   : key.down && !isAlt && ui_.alt()                        ? menuOf(key.key)
                                                                            : -1;
  if (menu < 0) return false;
  ui_.closePopups();
  state_.menu = menu;
  return true;
}

// Nothing is quit or opened after all.
void Session::stay() {
  state_.waiting = Waiting::nothing;
  dropped_.clear();
}

// Out of what is uppermost: a menu, a question, help, opening; last of what is chosen.
void Session::escape() {
  files_.close();
  if (ui_.closePopups() || ui_.wantsKeys()) return;
  if (!state_.failure.empty()) return state_.failure.clear();
  if (state_.waiting != Waiting::nothing) return stay();
  if (std::exchange(state_.help, false)) return;
  if (loader_.busy())
    state_.wishCancel = true;
  else if (exporter_.busy())
    state_.wishCancelExport = true;
  else
    perform(ActionId::nothing, state_, document_.get());
}

}  // namespace vasa::viewer
