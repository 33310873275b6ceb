#include "viewer/session.h"

#include <fmt/format.h>

#include "core/atomic_file.h"
#include "core/clock.h"
#include "core/heap.h"
#include "core/log.h"
#include "core/stage_log.h"
#include "gpu/error.h"
#include "viewer/pose_text.h"

namespace vasa::viewer {
namespace {

constexpr double kSlowTurn = 100;  // [ms] Nielsen 1993: what takes longer is felt as a delay

}  // namespace

Session::Session(const ViewOptions& options, const Settings& settings, Window& window, Loader& loader)
    : options_(options),
      window_(window),
      ui_(options.uiScale > 0 ? options.uiScale
          : options.script    ? 1.0f
                              : window.scale()),
      device_({.choice = options.device,
               .validation = options.validation,
               .instanceExtensions = Window::instanceExtensions(),
               .deviceExtensions = gpu::Swapchain::deviceExtensions()}),
      surface_(window, device_.instance()),
      swapchain_(device_, surface_.handle()),
      canvas_(device_),
      painter_(device_, options.seed),
      state_(settings.state),
      pointer_(ui_.scale()),
      poseTool_(ui_.scale()),
      editor_(ui_.scale()),
      exporter_(device_, options.seed, [] { Window::wake(); }),
      keeper_(options.builtIn),
      loader_(loader),
      worker_([] { Window::wake(); }, device_.isCpu()),
      reshaper_([] { Window::wake(); }) {
  takeSize(window.width(), window.height());
  ui_.useClipboard(window);
  report_.loads.push_back({.title = loader_.title(), .outcome = "loading"});
  opening_ = {.wanted = firstWanted(options), .files = options.dropped};
  if (!options.file.path.empty()) opening_.files.push_back(options.file.path);
  loadStart_ = options.start;
  lastWatched_ = Clock::now();
}

Result<ViewReport> Session::run() {
  if (const auto fits = checkRecord(); !fits) return fits.error();
  const auto done = gpu::attempt([&] { return go(); });
  if (!done) return keepWhatIsThere(done.error());
  if (!*done) return keepWhatIsThere(done->error());
  return *done;
}

// Told now, not once there is a session to lose. What is written as it stands (/dev/full, a pipe) shows at
// the end.
Result<void> Session::checkRecord() const {
  std::error_code ignored;
  const auto status = std::filesystem::status(options_.record, ignored);
  if (options_.record.empty() || std::filesystem::is_other(status)) return {};
  const auto file = AtomicFile::create(options_.record);
  return file ? Result<void>() : file.error();
}

Result<void> Session::keepScript() {
  return options_.record.empty() ? Result<void>() : writeFileAtomically(options_.record, recorder_.text());
}

// Of a session that was not ended by its user: what was not saved, in a scene of its own. Says where; empty
// where there is nothing to save.
std::string Session::keepUnsaved() {
  if (!document_ || !history_.unsaved(state_)) return "";
  const auto kept = keeper_.save(*document_, state_, {}, freeName(options_.out, "json"));
  return kept ? "what was not saved is in " + kept->string() : kept.error().message;
}

// Of a session that cannot go on: what was not saved, what was done in it, how it looked, and the film so
// far.
Error Session::keepWhatIsThere(Error error) {
  if (report_.refused) error.message += "; before that: " + report_.refused->message;
  if (!document_) return error;
  if (const std::string told = keepUnsaved(); !told.empty()) error.message += "; " + told;
  const auto path = options_.record;
  if (const auto kept = keepScript(); !kept) {
    if (error.message.find(kept.error().message) == std::string::npos)
      error.message += "; " + kept.error().message;
  } else if (!path.empty())
    error.message += "; the session until then is in " + path.string();
  if (recording_.running())
    if (const auto film = recording_.finish())
      error.message += "; the film until then is in " + film->string();
  if (!options_.script && !keepSettings()) error.message += "; the view's settings could not be kept";
  return error;
}

Result<ViewReport> Session::go() {
  while (!ending_ && !options_.stopped()) {
    const auto start = Clock::now();
    const bool answers = !steady() && shown_;
    now_ += pass();
    gather();
    openFiles();
    lookUnderPointer();
    adopt();
    travel();
    reshape();
    orderShape();
    takeShape();
    if (width_ > 0 && height_ > 0) {
      const bool changed = drawScene();
      if (changed) panelFrames_ = std::max(panelFrames_, 1);
      if (panelFrames_ > 0 || saving_) drawWindow();
    }
    meetWishes();
    watchExport();
    record();
    profile();
    watchLoading();
    tidy();
    if (failure_) return *failure_;
    const double ms = msSince(start);
    if (answers && !steady()) {
      report_.longestTurnMs = std::max(report_.longestTurnMs, ms);
      report_.slowTurns += ms > kSlowTurn ? 1 : 0;
    }
    rest(ms / 1000);
  }
  if (!ending_)
    if (const std::string told = keepUnsaved(); !told.empty()) logWarning(told);
  if (exporter_.busy()) logWarning(exporter_.title() + ": the export was cancelled");
  if (const auto written = keepScript(); !written) return written.error();
  state_.recording = false;
  record();
  leaveStill();
  loader_.stop();
  report_.stopMs = loader_.takeStopTimes();
  if (!options_.script)
    if (const auto kept = keepSettings(); !kept) logWarning(kept.error().message);
  return report();
}

// Time as the session knows it.
double Session::pass() {
  const auto now = Clock::now();
  const double seconds = steady() ? kScriptFrame : std::chrono::duration<double>(now - last_).count();
  last_ = now;
  if (document_ && state_.playback.clip >= 0 && state_.playback.playing)
    state_.playback.advance(document_->scene.body.clips[std::size_t(state_.playback.clip)],
                            std::min(seconds, 0.25));
  still_ += seconds;
  if (!message_.empty() && now_ >= messageUntil_) {  // nothing else may come that draws the panels without it
    message_.clear();
    panelFrames_ = kRestingFrames;
  }
  return seconds;
}

void Session::orderShape() {
  if (!document_) return;
  PoseOrder order{.document = coming_ ? coming_ : document_,
                  .clip = state_.playback.clip,
                  .time = state_.playback.time,
                  .turns = state_.turns,
                  .forces = state_.forces,
                  .contacts = state_.contacts,
                  .measures = state_.selected && !state_.playback.playing};
  const bool done = body_ && !body_->provisional && body_->order == order;
  const bool underWay = worker_.busy() && ordered_ && *ordered_ == order;
  // While a shape is being made only a person's wishes go before it, not the next moment of a clip.
  const bool goesFirst = coming_ && (!ordered_ || ordered_->document != coming_);
  if (!done && !underWay && (worker_.isFree() || goesFirst)) {
    ordered_ = order;
    worker_.order(std::move(order));
  }
  if (steady() && (recording_.running() || body_ || settling_)) worker_.wait();
}

void Session::takeShape() {
  const auto latest = worker_.latest();
  if (latest && coming_ && latest->order.document == coming_) changeTo(std::exchange(coming_, nullptr));
  if (!latest || latest == body_ || latest->order.document != document_) return;
  body_ = latest;
  follow();
  if (body_->provisional) return;
  ++report_.shapes;
  timings_.addShape(body_->report, body_->ms);
}

void Session::follow() {
  // Where the clip goes, not a person: the camera stays beside a pelvis that is pulled.
  const vec3 way = wayOverFloor(document_->scene,
                                unturned(document_->scene.body.skeleton, body_->pose, body_->order.turns));
  if (state_.follow && !state_.wishHome) carried_ += way - way_;
  way_ = way;
}

void Session::meetWishes() {
  takeFile();
  if (std::exchange(state_.wishSave, false)) {
    if (keeper_.path().empty() && !options_.script)  // scripts write below their folder
      state_.wishSaveAs = true, goesOnSaved_ = std::exchange(state_.wishGoOn, false);
    else
      saveScene();
  }
  if (std::exchange(state_.wishQuit, false)) {
    state_.waiting = Waiting::quit;
    state_.wishGoOn = true;
  }
  goOn();
  askForFile();
  if (state_.wishCancel && loader_.busy()) cancelLoading();
  if (state_.wishPicture && shown_) save({freeName(options_.out, "png"), false});
  state_.wishPicture = state_.wishCancel = false;
  if (std::exchange(state_.wishCopyPicture, false) && shown_) copyPicture();
  if (std::exchange(state_.wishSaveProfile, false)) saveProfile();
  if (std::exchange(state_.wishFullScreen, false)) {
    state_.fullScreen = window_.setFullScreen(!state_.fullScreen);
    panelFrames_ = kRestingFrames;
  }
  if (std::exchange(state_.wishCopyPose, false) && document_)
    window_.setClipboard(poseText(poseOf(document_->scene.body.skeleton, state_.turns)));
  if (std::exchange(state_.wishPastePose, false) && document_) pastePose();
  if (saving_) saveForScript();
}

Result<void> Session::keepSettings() const {
  return saveSettings({window_.width(), window_.height(), state_});
}

// A picture that a script asks for waits for what is being opened.
void Session::saveForScript() {
  const bool alone = !saving_->panels, missing = alone && !shown_;
  if (width_ > 0 && height_ > 0 && ((alone && loader_.busy()) || (missing && document_))) {
    settling_ = true;  // loading and shapes are waited for
    return;
  }
  const SavePicture wish = *std::exchange(saving_, std::nullopt);
  settling_ = false;
  if (missing)
    failure_ = Error{Fault::failed, wish.path.string() +
                                        ": there is nothing to draw, for nothing is open; let the script "
                                        "open something, or not cancel it, before `picture`"};
  else
    save(wish);
}

void Session::pastePose() {
  const auto pose = poseOfText(window_.clipboard());
  if (!pose) return say(pose.error().message, 8);
  state_.turns = turnsOf(document_->scene.body.skeleton, *pose);
  if (state_.turns.size() < pose->size())
    say(fmt::format("{} of the pose's {} joints are none of this body's", pose->size() - state_.turns.size(),
                    pose->size()));
  panelFrames_ = kRestingFrames;
}

void Session::say(std::string message, double seconds) {
  if (!options_.script) logInfo(message);
  message_ = options_.script ? "" : std::move(message);  // paths would make pictures differ
  messageUntil_ = now_ + seconds;
  panelFrames_ = kRestingFrames;
}

bool Session::idle() const {
  if (loader_.busy() || profiling_ || exporter_.busy()) return false;
  if (!document_) return true;
  if (coming_ || reshaper_.busy()) return false;
  return shown_ && !worker_.busy() && (shown_->fine || !state_.fineStills || state_.playback.playing);
}

// Until there is something to do, but no longer than one can see.
void Session::rest(double drawn) {
  if (steady() && options_.script) {
    window_.wait(0);
    return;
  }
  const bool moving = state_.playback.playing || pointer_.dragging() || profiling_ || recording_.running();
  const bool due = panelFrames_ > 0 || !events_.empty();
  if (making_ || exportMore_) {
    window_.wait(0);
    return;
  }
  const bool growing = body_ && state_.detail.capillaries > 0 && !document_->growth.settled();
  const bool waiting = worker_.busy() || reshaper_.busy() || (shown_ && !shown_->fine && state_.fineStills) ||
                       now_ < messageUntil_ || movedAt_ >= 0 || growing;
  const double longest = loader_.busy() && !moving ? std::max(kScriptFrame - drawn, 0.0)
                         : moving || due           ? std::max(kFrame - drawn, 0.0)
                         : waiting                 ? 0.05
                                                   : 1.0;
  window_.wait(longest);
}

ViewReport Session::report() const {
  ViewReport result = report_;
  result.editMs = timings_.edit().median();
  result.frameMs = timings_.shown().median();
  result.shapeMs = timings_.shape().median();
  result.pictureMs = timings_.picture().median();
  for (const Timings::Stage& stage : timings_.stages())
    result.stages.emplace_back(stage.name, stage.history.median());
  result.device = device_.adapter().name;
  result.title = document_ ? document_->title : "";
  if (document_ && state_.selected)
    result.selected = document_->scene.network.vessel(state_.selected->vessel).name;
  if (shown_) result.width = shown_->width, result.height = shown_->height;
  result.validation = device_.validationMessages();
  return result;
}

Result<ViewReport> view(const ViewOptions& options) {
  keepHeapSmall();
  Settings settings;
  if (!options.script) loadSettings(settings);
  if (options.width > 0) settings.width = options.width, settings.height = options.height;
  StageLog stages("opening the window");
  auto window = Window::open("vasa", settings.width, settings.height);
  if (!window) return window.error();
  // What is shown first is loaded while the device is made ready.
  Loader loader;
  loader.start(firstWanted(options), [] { Window::wake(); });
  stages.next("opening the device and the panels");
  Session session(options, settings, *window, loader);
  stages.end();
  return session.run();
}

}  // namespace vasa::viewer
