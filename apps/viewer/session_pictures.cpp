#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/atomic_file.h"
#include "core/log.h"
#include "curve/bspline.h"
#include "io/png.h"
#include "plate/profile_chart.h"
#include "viewer/paint.h"
#include "viewer/session.h"
#include "viewer/way_profile.h"

// What a session draws: the scene's picture when anything in it has changed, the window's around it, and
// copies of both for files and videos.
namespace vasa::viewer {
namespace {

double msBetween(std::chrono::steady_clock::time_point from, std::chrono::steady_clock::time_point to) {
  return std::chrono::duration<double, std::milli>(to - from).count();
}

constexpr double kStillAfter = 0.25;  // [s] without change

bool same(const Camera& a, const Camera& b) {
  return a.position == b.position && a.target == b.target && a.up == b.up &&
         a.verticalAngle == b.verticalAngle && a.orthographicHeight == b.orthographicHeight &&
         a.cut == b.cut && a.nearDistance == b.nearDistance && a.farDistance == b.farDistance;
}

auto shownParts(const Look& look) {
  return std::array{look.drawArteries, look.drawVeins, look.drawOtherVessels, look.drawBones,
                    look.drawHeart,    look.drawSkin,  look.drawOther};
}

auto opacities(const Look& look) {
  return std::array{look.skinOpacity,   look.boneOpacity, look.heartOpacity,    look.otherOpacity,
                    look.arteryOpacity, look.veinOpacity, look.capillaryOpacity};
}

bool same(const Look& a, const Look& b) {
  return a.style == b.style && a.background == b.background && a.transparent == b.transparent &&
         shownParts(a) == shownParts(b) && opacities(a) == opacities(b) && a.occlusion == b.occlusion;
}

bool same(const Shot& a, const Shot& b) {
  return a.body == b.body && same(a.camera, b.camera) && same(a.look, b.look) && a.width == b.width &&
         a.height == b.height && a.colours == b.colours;
}

}  // namespace

// Where the list and the panels would leave no picture between them, the list takes the panels' place.
Layout Session::layoutNow() const {
  const auto width = float(width_);
  const float scale = ui_.scale(), least = 200 * scale;
  Layout layout = layoutOf(width, float(height_), scale, state_.panels, state_.outliner.on);
  if (!state_.panels || !state_.outliner.on || layout.picture.width >= least) return layout;
  const float list = std::min(std::round(270 * scale), std::round(width / 2));
  layout.outliner.width = layout.picture.left = list;
  layout.picture.width = std::max(width - list, 1.0f);
  layout.panels.left = layout.transport.width = width;
  layout.panels.width = 0;
  return layout;
}

Rect Session::pictureRect() const { return layoutNow().picture; }

Camera Session::cameraNow() const {
  Camera camera = state_.orbit.camera(state_.cut, 0.5f * glm::length(document_->bounds.extent()));
  camera.position += carried_;
  camera.target += carried_;
  if (state_.cutPlane.on) camera.cut = cutThrough(state_.cutPlane, bodyBox());
  return camera;
}

// At rest, where the body has walked to.
Aabb Session::bodyBox() const {
  Aabb box = document_->bounds;
  box.low += way_;
  box.high += way_;
  return box;
}

Shot Session::shotNow() {
  const Rect rect = pictureRect();
  Shot shot{.body = body_,
            .camera = cameraNow(),
            .look = state_.look,
            .width = std::uint32_t(rect.width),
            .height = std::uint32_t(rect.height),
            .colours = coloursOf(*document_, body_, state_, spanColours_),
            .waits = steady()};
  shot.look.occlusion = 0;
  return shot;
}

// Where the camera is wished to be.
void Session::moveCamera() {
  if (state_.wishHome) {
    const Rect rect = pictureRect();
    Aabb box =
        motionBounds(document_->scene, state_.playback.clip >= 0
                                           ? &document_->scene.body.clips[std::size_t(state_.playback.clip)]
                                           : nullptr);
    carried_ = state_.follow ? way_ : vec3(0);
    box.low += way_ - carried_;
    box.high += way_ - carried_;
    state_.orbit.frame(box, rect.width / rect.height);
    state_.wishHome = false;
  }
  if (state_.wishFocus && state_.selected) {
    const Rect rect = pictureRect();
    Aabb box = subjectBounds(document_->scene, {state_.selected->vessel, {}}, body_->pose, body_->points);
    box.low -= carried_;
    box.high -= carried_;
    state_.orbit.frame(box, rect.width / rect.height);
    const Vessel& vessel = document_->scene.network.vessel(state_.selected->vessel);
    const vec3 middle(evaluate(Network::pointsOf(vessel, body_->points), 0.5f * float(vessel.spanCount())));
    if (isHidden(middle))
      say("Something lies before it: lower the opacity of bones, heart or skin, or cut with Near cut", 8);
  }
  state_.wishFocus = false;
}

// Capillaries come once it is settled what they grow from; nobody waits for that before the window.
Detail Session::detailNow() const {
  Detail detail = state_.detail;
  if (detail.capillaries == 0 || steady()) return detail;
  if (!document_->live) document_->growth.begin();
  if (!document_->growth.settled()) detail.capillaries = 0;
  return detail;
}

// True where there is a new picture.
bool Session::drawScene() {
  if (!document_ || !body_) return false;
  moveCamera();
  const Detail before = detail_;
  painter_.choose(document_, detail_ = detailNow(), state_.timing);
  if (!painter_.picture() || before != detail_ || painter_.isStale()) {
    shown_.reset();
    leaveStill();
  }
  Shot shot = shotNow();
  Shot fine = shot;
  fine.fine = true;
  fine.look.occlusion = state_.look.occlusion;
  if (shown_ && shown_->fine && same(*shown_, fine)) return false;
  if (shown_ && !shown_->fine && same(*shown_, shot)) {
    const bool moving = state_.playback.playing || worker_.busy() || pointer_.dragging();
    if (state_.fineStills && !moving && still_ >= kStillAfter) return makeStill(fine);
    leaveStill();
    return false;
  }
  still_ = 0;
  leaveStill();
  const auto start = Clock::now();
  painter_.draw(shot);
  state_.pointedAt.reset();  // something else may lie there now
  movedAt_ = now_;
  const auto end = Clock::now();
  ++report_.pictures;
  timings_.addPicture(painter_.times(), msBetween(start, end));
  if (lastShown_ && state_.playback.playing) timings_.addShown(msBetween(*lastShown_, end));
  lastShown_ = end;
  shown_ = std::move(shot);
  return true;
}

// A slice of a finer still, so that whoever sits before the window is answered between two of them; all of
// them where time goes on in steps. True with the last one.
bool Session::makeStill(const Shot& fine) {
  const auto turn = Clock::now();
  for (bool more = true; more;) {
    const auto start = Clock::now();
    if (making_ && same(*making_, fine)) {
      more = painter_.step();
    } else {
      leaveStill();
      painter_.begin(fine);
      making_ = fine;
    }
    ++report_.slices;
    report_.longestSliceMs = std::max(report_.longestSliceMs, msBetween(start, Clock::now()));
    if (more && !steady() && msSince(turn) >= kSliceTime) return false;
  }
  ++report_.pictures;
  lastShown_.reset();
  shown_ = std::exchange(making_, std::nullopt);
  return true;
}

// What is shown, as it is now.
void Session::startExport(const std::filesystem::path& file) {
  if (!document_ || !body_) return;
  state_.exportWish.file = file;
  Camera camera = cameraNow();
  exporter_.start(state_.exportWish, {document_, body_, state_, camera});
}

// A slice of a picture, or a look at what its thread does.
void Session::watchExport() {
  if (std::exchange(state_.wishCancelExport, false)) exporter_.cancel();
  if (exporter_.busy()) {
    panelFrames_ = std::max(panelFrames_, 1);
    exportMore_ = exporter_.step();
    if (steady()) {
      while (exporter_.busy()) {
        exporter_.wait();
        exporter_.step();
      }
      exportMore_ = false;
    }
  }
  const auto outcome = exporter_.take();
  if (!outcome) return;
  exportMore_ = false;
  if (state_.waiting == Waiting::quit) {
    if (outcome->ok() || outcome->error().fault == Fault::interrupted)
      state_.wishGoOn = true;
    else
      state_.waiting = Waiting::nothing;  // why it failed is to be seen
  }
  if (!*outcome) {
    if (options_.script) failure_ = outcome->error();
    if (outcome->error().fault != Fault::interrupted) state_.failure = outcome->error().message;
    return say(outcome->error().message, 8);
  }
  report_.files.push_back(**outcome);
  say("wrote " + (*outcome)->string());
}

void Session::leaveStill() {
  if (making_) ++report_.stillsGivenUp;
  making_.reset();
}

void Session::drawWindow() {
  const auto start = Clock::now();
  canvas_.resize({width_, height_});
  ui_.useKeysInMenus(state_.menu >= 0 || ui_.inMenu());
  ui_.begin(width_, height_, options_.script ? kScriptFrame : kFrame);
  const Layout layout = layoutNow();
  showPanels({.state = state_,
              .document = document_.get(),
              .body = body_.get(),
              .timings = timings_,
              .layout = layout,
              .scale = ui_.scale(),
              .camera = shown_ ? shown_->camera : Camera{},
              .bodyBox = document_ ? bodyBox() : Aabb{},
              .files = &files_,
              .editor = &editor_,
              .heldGrip = poseTool_.held(),
              .profiler = profiler_.get(),
              .fine = shown_ && shown_->fine,
              .framesPerSecond = framesPerSecond(),
              .message = message_,
              .loading = loader_.busy() ? std::optional(loader_.stage()) : std::nullopt,
              .loadingTitle = loader_.title(),
              .unsaved = document_ && history_.unsaved(state_),
              .exportTitle = exporter_.title(),
              .exportShare = exporter_.share()});
  const auto declared = Clock::now();
  canvas_.draw(shown_ ? painter_.picture() : nullptr, std::uint32_t(layout.picture.left),
               std::uint32_t(layout.picture.top), ui_.end());
  window_.setPointer(ui_.pointer());
  const auto drawn = Clock::now();
  swapchain_.present(canvas_.canvas(), {window_.width(), window_.height()});
  timings_.addWindow(msBetween(start, declared), msBetween(declared, drawn), msBetween(drawn, Clock::now()));
  if (panelFrames_ > 0) --panelFrames_;
  ++report_.frames;
  noteFirst();
  noteEdit();
}

// How long a person waited.
void Session::noteFirst() {
  if (!shown_ || report_.firstSolvedMs > 0) return;
  const double ms = msBetween(options_.start, Clock::now());
  if (report_.firstPictureMs == 0) {
    report_.firstPictureMs = ms;
    logDetail(fmt::format("{:7.1f} ms  from the start to the first picture", ms));
  }
  if (shown_->body->provisional) return;
  report_.firstSolvedMs = ms;
  logDetail(fmt::format("{:7.1f} ms  from the start to the first picture with vessels moved apart", ms));
}

// A picture of the video for every picture that is drawn.
void Session::record() {
  if (state_.recording && !recording_.running() && shown_) {
    if (const auto started = recording_.start(freeName(options_.out, "mp4"), shown_->width, shown_->height);
        !started) {
      state_.recording = false;
      say(started.error().message);
    }
  }
  if (recording_.running() && shown_ && !recording_.fits(shown_->width, shown_->height))
    state_.recording = false;
  if (recording_.running() && state_.recording && shown_)
    if (const auto added = recording_.add(painter_.readBack()); !added) {
      state_.recording = false;
      say(added.error().message);
    }
  if (recording_.running() && !state_.recording) {
    const auto file = recording_.finish();
    if (file) report_.files.push_back(*file), report_.videoFrames += recording_.frames();
    say(file ? "wrote " + file->string() : file.error().message);
  }
}

// Of what moves; a script's pictures show no times.
double Session::framesPerSecond() const {
  const float ms = timings_.shown().median();
  return options_.script || !state_.playback.playing || ms <= 0 ? 0 : 1000 / double(ms);
}

void Session::copyPicture() {
  const auto file = std::filesystem::absolute(freeName(options_.out, "png"));
  if (!save({file, false}, "; the picture is on the clipboard")) return;
  auto bytes = readFile(file);
  if (!pictureClipboard_) pictureClipboard_.emplace();
  if (bytes && pictureClipboard_->offer(std::move(*bytes), file.string())) return;
  window_.setClipboard(file.string());
  say("wrote " + file.string() + "; its name is on the clipboard, which takes no picture");
}

void Session::saveProfile() {
  if (!document_ || !body_) return;
  const auto way = profileOf(state_, document_->scene.network, body_->points);
  if (!way) return;
  const auto table = freeName(options_.out, "csv"), picture = freeName(options_.out, "png");
  const auto chart = plate::drawProfile(way->title, way->stations);
  auto written = chart ? writePng(picture, *chart) : Result<void>(chart.error());
  if (written) written = writeFileAtomically(table, plate::profileCsv(way->stations));
  if (!written) {
    if (options_.script) failure_ = written.error();
    return say(written.error().message);
  }
  for (const auto& file : {table, picture}) report_.files.push_back(file);
  say("wrote " + picture.string() + " and " + table.string());
}

bool Session::save(const SavePicture& wish, const char* more) {
  if (!wish.panels && !shown_) return false;
  const auto written = writePng(wish.path, wish.panels ? canvas_.readBack() : painter_.readBack());
  if (!written) {
    if (options_.script) failure_ = written.error();
    say(written.error().message);
    return false;
  }
  report_.files.push_back(wish.path);
  say("wrote " + wish.path.string() + more);
  return true;
}

}  // namespace vasa::viewer
