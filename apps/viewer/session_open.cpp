#include <algorithm>

#include "atlas/scene_look.h"
#include "core/heap.h"
#include "edit/replay.h"
#include "viewer/session.h"

// How a session comes by what it shows: loaded beside the window, adopted when all of it is there.
namespace vasa::viewer {

namespace {

// What is dropped together belongs together: a body and its vessels.
Loader::Wanted wantedOf(const ViewOptions& options, std::vector<std::filesystem::path> files,
                        const SceneFile& shown) {
  std::string title;
  for (const auto& file : files) title += (title.empty() ? "" : ", ") + file.filename().string();
  const auto choice = [open = options.open, files = std::move(files), shown]() -> Result<SceneFile> {
    SceneFile scene = shown;
    for (const auto& file : files) {
      auto next = open(file, scene);
      if (!next) return next;
      scene = std::move(*next);
    }
    return scene;
  };
  return {std::move(title), choice, options.furnishing};
}

bool areMotions(const std::vector<std::filesystem::path>& files) {
  return std::ranges::all_of(files, [](const auto& file) { return isMotionFile(file.string()); });
}

bool sameJoints(const Skeleton& a, const Skeleton& b) {
  return std::ranges::equal(a.joints, b.joints, {}, &Skeleton::Joint::name, &Skeleton::Joint::name);
}

}  // namespace

Loader::Wanted firstWanted(const ViewOptions& options) {
  if (!options.dropped.empty()) return wantedOf(options, options.dropped, options.file);
  return {titleOf(options.file), [file = options.file] { return file; }, options.furnishing};
}

// What is not saved is asked about first, unless it stays: a motion leaves all but the motion as it is.
void Session::openFiles() {
  if (!state_.wishFiles.empty()) dropped_ = std::exchange(state_.wishFiles, {});
  if (dropped_.empty() || state_.waiting != Waiting::nothing) return;
  if (document_ && areMotions(dropped_)) return startOpening();
  state_.waiting = Waiting::open;
  state_.wishGoOn = true;
  goOn();
}

// Whether what waits takes something along that nobody has said may go.
bool Session::asksFirst() const {
  return (document_ && history_.unsaved(state_)) || (state_.waiting == Waiting::quit && exporter_.busy());
}

// With what waits, unless something would be lost and nobody said that it may be.
void Session::goOn() {
  if (std::exchange(state_.wishStay, false)) stay();
  const bool asked = std::exchange(state_.wishGoOn, false),
             discard = std::exchange(state_.wishDiscard, false);
  if (state_.waiting == Waiting::nothing || !(discard || (asked && !asksFirst()))) return;
  const Waiting waited = std::exchange(state_.waiting, Waiting::nothing);
  if (waited == Waiting::quit)
    ending_ = true;
  else if (!dropped_.empty())
    startOpening();
}

void Session::startOpening() {
  if (loader_.busy()) {
    report_.loads.back().outcome = "cancelled";
    interrupted_.push_back(std::move(opening_));
  }
  state_.failure.clear();
  message_.clear();  // of what could not be opened before
  auto files = std::exchange(dropped_, {});
  const bool motionAlone = document_ && areMotions(files);
  auto wanted = wantedOf(options_, files, document_ ? keeper_.file() : options_.file);
  if (motionAlone) wanted.edits = document_->journal;
  load({std::move(wanted), std::move(files), motionAlone});
}

void Session::load(Opening opening) {
  opening_ = std::move(opening);
  report_.loads.push_back({.title = opening_.wanted.title, .outcome = "loading"});
  loadStart_ = lastWatched_ = Clock::now();
  loader_.start(opening_.wanted, [] { Window::wake(); });
  panelFrames_ = kRestingFrames;
}

// What was open stays, and what was being opened goes on.
void Session::refuse(const Error& error) {
  constexpr double kTimeToRead = 15;
  if (!document_ && report_.loads.size() == 1) {
    failure_ = error;
    return;
  }
  if (options_.script) {
    if (report_.refused)
      report_.refused->message += "; " + error.message;
    else
      report_.refused = error;
  }
  say(error.message, kTimeToRead);
  state_.failure = error.message;
  if (interrupted_.empty()) return;
  auto again = std::move(interrupted_.back());
  interrupted_.pop_back();
  load(std::move(again));
}

void Session::cancelLoading() {
  loader_.cancel();
  interrupted_.clear();
  report_.loads.back().outcome = "cancelled";
  panelFrames_ = kRestingFrames;
}

// The window goes on being drawn while something is loaded.
void Session::watchLoading() {
  const auto now = Clock::now();
  if (loader_.busy() || arriving_) {
    LoadReport& load = report_.loads.back();
    ++load.frames;
    load.longestMs =
        std::max(load.longestMs, std::chrono::duration<double, std::milli>(now - lastWatched_).count());
    load.seconds = std::chrono::duration<double>(now - loadStart_).count();
    panelFrames_ = std::max(panelFrames_, 1);
  }
  // The view that was found belongs to the beginning: it is no step.
  if (shown_) arriving_ = false;
  if (shown_ && std::exchange(beginning_, false)) {
    history_.start(state_);
    nameSteps();
  }
  lastWatched_ = now;
}

// What loading took, and the scene before held, goes back once the new one stands; what it takes to settle
// where its capillaries grow goes once they are settled. On a thread of its own: it takes longer than a slice
// of a picture.
void Session::tidy() {
  if (!shown_ || shown_->body->provisional || loader_.busy()) return;
  const Untidy left = document_->growth.settled() ? Untidy::no : Untidy::growing;
  if (left >= untidy_) return;
  untidy_ = left;
  tidying_ = std::async(std::launch::async, returnFreedMemory);
}

// A document that has been loaded takes the place of the one before.
void Session::adopt() {
  if (loader_.busy() && options_.script && settling_) loader_.wait();
  const auto answer = loader_.take();
  if (!answer) return;
  untidy_ = Untidy::loaded;
  report_.loads.back().outcome = *answer ? "opened" : answer->error().message;
  if (!*answer) return refuse(answer->error());
  interrupted_.clear();
  const bool goesOn =
      opening_.motionAlone && sameJoints((**answer)->scene.body.skeleton, document_->scene.body.skeleton);
  if (goesOn)
    goOnWith(**answer);
  else
    document_ = **answer;
  arriving_ = true;
  body_.reset();
  shown_.reset();
  leaveStill();
  timings_.clear();
  coming_.reset();
  wanted_ = document_->journal;
  wantedLive_ = false;
  profiler_.reset();
  profiling_ = false;
  remember(opening_.files);
  if (!goesOn) beginWith();
  entitle();
}

// What is shown with another motion: whatever was done to it, or is being done meanwhile, stays.
void Session::goOnWith(std::shared_ptr<const Document> moved) {
  changeTo(std::move(moved));
  takeClip();
  keeper_.takeMotion(document_->file.clip);
}

// A document as its scene says that it is to be shown: nothing has been done to it yet.
void Session::beginWith() {
  beginning_ = true;
  editor_.refusal.clear();
  way_ = carried_ = vec3(0);
  state_.journal = document_->journal;
  state_.selected.reset();
  state_.pointedAt.reset();
  state_.alsoChosen.clear();
  state_.outliner.unfolded.clear();
  state_.turns = turnsOf(document_->scene.body.skeleton, document_->file.pose);
  state_.from = state_.to = std::nullopt;
  state_.joint = {};
  takeChoices();
  keeper_.opened(document_->file, state_);
  history_.start(state_);
}

// The dialogs in which files are chosen.
void Session::askForFile() {
  const auto& shown = keeper_.path();
  const auto folder = shown.empty() ? options_.out : shown.parent_path();
  if (std::exchange(state_.wishOpen, false)) files_.start(FilePurpose::open, folder, "", options_.openable);
  if (std::exchange(state_.wishSaveAs, false) && document_)
    files_.start(FilePurpose::saveScene, folder,
                 shown.empty() ? freeName(folder, "json").filename().string() : shown.filename().string(),
                 {".json"});
  if (std::exchange(state_.wishExport, false) && document_ && body_) {
    const auto& last = state_.exportWish.file;
    files_.start(FilePurpose::exportFile, last.empty() ? folder : last.parent_path(),
                 last.empty() ? "vessels.glb" : last.filename().string(), exportExtensions());
  }
  if (files_.isOpen()) panelFrames_ = std::max(panelFrames_, 1);
}

// What was chosen in them.
void Session::takeFile() {
  if (state_.chosenFiles.empty()) {
    if (!files_.isOpen() && !state_.wishSaveAs) goesOnSaved_ = false;  // left without a name
    return;
  }
  auto chosen = std::exchange(state_.chosenFiles, {});
  panelFrames_ = kRestingFrames;
  if (files_.purpose() == FilePurpose::open) {
    state_.wishFiles = std::move(chosen);
    return;
  }
  auto file = std::move(chosen.front());
  if (options_.script) {
    auto place = placeBelow(options_.out, file);
    if (!place) {
      failure_ = place.error();
      return;
    }
    file = std::move(*place);
  }
  if (files_.purpose() == FilePurpose::exportFile)
    startExport(file);
  else {
    saveScene(file);
    state_.wishGoOn = std::exchange(goesOnSaved_, false);
  }
}

void Session::remember(const std::vector<std::filesystem::path>& files) {
  constexpr std::size_t kMost = 10;
  for (const auto& file : files) {
    std::error_code ignored;
    const std::string name = std::filesystem::absolute(file, ignored).lexically_normal().string();
    std::erase(state_.recent, name);
    state_.recent.insert(state_.recent.begin(), name);
  }
  if (state_.recent.size() > kMost) state_.recent.resize(kMost);
}

// The scene's clip, at the moment that it names.
void Session::takeClip() {
  const auto& body = document_->scene.body;
  const SceneFile& choice = document_->file;
  const auto clip = clipOf(body, choice);
  if (clip && *clip)
    state_.playback.clip = int(*clip - body.clips.data());
  else
    state_.playback.clip = body.clips.empty() ? -1 : 0;
  state_.playback.time = state_.playback.clip >= 0 ? body.clips[std::size_t(state_.playback.clip)].start : 0;
  if (state_.playback.clip >= 0 && choice.time > 0)
    state_.playback.time =
        std::min(state_.playback.time + choice.time, body.clips[std::size_t(state_.playback.clip)].end);
}

// What the scene says of how it is to be shown.
void Session::takeChoices() {
  const SceneFile& choice = document_->file;
  takeClip();
  state_.detail.capillaries = int(choice.capillaries.levels);
  if (!choice.look.preset.empty()) {
    state_.preset = choice.look.preset;
    state_.look = lookNamed(state_.preset).value_or(Look{});
  }
  atlas::apply(choice.look, state_.look);
  state_.colouring = atlas::colouringNamed(choice.look.colour).value_or(atlas::Colouring::kind);
  state_.legend = choice.look.legend;
  state_.hidden = VesselNames(choice.hidden);
  state_.labelled = VesselNames(choice.labels);
  state_.views = choice.views;
  state_.orbit.look(viewNamed(choice.camera.view).value_or(View::front));
  state_.wishHome = !choice.camera.position;
  if (choice.camera.position)
    state_.orbit.take({.position = *choice.camera.position,
                       .target = choice.camera.target.value_or(document_->bounds.centre()),
                       .verticalAngle = glm::radians(choice.camera.angleDegrees)});
  if (choice.camera.position || choice.camera.orthographic)
    state_.orbit.setOrthographic(choice.camera.orthographic);
  if (!choice.chosen.empty())
    if (const auto vessel = findVessel(document_->scene.network, choice.chosen))
      state_.selected = VesselPlace{*vessel, 0};
  if (choice.camera.focus.empty()) return;
  if (const auto subject = findSubject(document_->scene, choice.camera.focus);
      subject && subject->vessel.valid()) {
    state_.selected = VesselPlace{subject->vessel, 0};
    state_.wishFocus = true;
  }
}

}  // namespace vasa::viewer
