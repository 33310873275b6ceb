#include "viewer/exporter.h"

#include <algorithm>
#include <array>

#include "core/clock.h"
#include "io/foreign_files.h"
#include "io/png.h"
#include "scene/exporting.h"
#include "viewer/paint.h"
#include "viewer/turned_clip.h"

namespace vasa::viewer {
namespace {

constexpr std::array kFiles{".glb", ".obj", ".stl", ".vtp", ".swc", ".csv", ".tubes"};
constexpr std::array kFilms{".mp4", ".webm"};

bool among(const std::filesystem::path& file, std::span<const char* const> extensions) {
  return std::ranges::find(extensions, extensionOf(file)) != extensions.end();
}

bool ready(const auto& future) {
  return future.valid() && future.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
}

}  // namespace

std::vector<std::string> exportExtensions() {
  std::vector<std::string> all;  // one by one: of insert() gcc 12 tells false overflows
  for (const auto file : kFiles) all.emplace_back(file);
  all.emplace_back(".png");
  for (const auto film : kFilms) all.emplace_back(film);
  return all;
}

bool isFilm(const std::filesystem::path& file) { return among(file, kFilms); }
bool isPicture(const std::filesystem::path& file) { return extensionOf(file) == ".png"; }

struct Exporter::Job {
  ExportWish wish;
  Subject subject;
  Cancellation cancellation;
  std::optional<Clip> turnedOne;  // the clip with what a person turned
  const Clip* clip = nullptr;
  std::uint32_t first = 0, last = 0;
  std::atomic<std::size_t> done{0}, total{1};
  std::future<Result<std::filesystem::path>> file;  // of all but pictures

  // Of pictures and films.
  std::unique_ptr<Painter> painter;
  std::unique_ptr<FrameMaker> maker;
  std::future<std::shared_ptr<const PosedBody>> coming;
  bool drawing = false;
  std::optional<VideoWriter> video;
  KeptColours colours;
};

Exporter::Exporter(gpu::Device& device, std::uint32_t seed, std::function<void()> changed)
    : device_(device), seed_(seed), changed_(std::move(changed)) {}

Exporter::~Exporter() {
  cancel();
  wait();
}

void Exporter::cancel() {
  if (job_) job_->cancellation.ask();
}

void Exporter::wait() const {
  if (job_ && job_->file.valid()) job_->file.wait();
  if (job_ && job_->coming.valid()) job_->coming.wait();
}

std::string Exporter::title() const { return job_ ? job_->wish.file.filename().string() : ""; }

float Exporter::share() const {
  return job_ ? float(job_->done) / float(std::max<std::size_t>(job_->total, 1)) : 0;
}

void Exporter::start(ExportWish wish, Subject subject) {
  cancel();
  wait();
  outcome_.reset();
  job_ = std::make_unique<Job>();
  Job& job = *job_;
  job.wish = std::move(wish);
  job.subject = std::move(subject);
  const ViewState& state = job.subject.state;
  const Body& body = job.subject.document->scene.body;
  const Clip* clip = state.playback.clip >= 0 ? &body.clips[std::size_t(state.playback.clip)] : nullptr;
  job.clip = clip;
  if (!job.subject.body->order.turns.empty()) {
    job.turnedOne = turnedClip(body.skeleton, clip, job.subject.body->order.turns);
    job.clip = &*job.turnedOne;
  }
  const std::uint32_t frames = job.clip ? job.clip->frameCount() : 1;
  job.first = clip ? std::min(state.playback.frame(*clip), frames - 1) : 0;
  job.last = job.first;
  const auto kind = exportKindOf(job.wish.file);
  const bool many = isFilm(job.wish.file) || (kind && holdsMotion(*kind));
  if (many && job.wish.wholeClip) job.first = 0, job.last = frames - 1;
  job.total = job.last - job.first + 1;
  if (kind) return startFiles(job);
  if (!isPicture(job.wish.file) && !isFilm(job.wish.file))
    return finish(badInput(job.wish.file.string() + ": unknown kind of file; name a .glb, .obj, .stl, .vtp, "
                                                    ".swc, .csv, .tubes, .png, .mp4 or .webm"));
  job.painter = std::make_unique<Painter>(device_, seed_);
  job.painter->choose(job.subject.document, state.detail, false);
  if (isFilm(job.wish.file)) {
    auto video = VideoWriter::create(job.wish.file, job.wish.width, job.wish.height,
                                     job.clip ? job.clip->framesPerSecond : 30);
    if (!video) return finish(video.error());
    job.video.emplace(std::move(*video));
  }
  orderFrame(job);
}

void Exporter::startFiles(Job& job) const {
  job.file = std::async(std::launch::async, [&job, changed = changed_]() -> Result<std::filesystem::path> {
    const CancellationScope scope(job.cancellation);
    const Subject& subject = job.subject;
    ExportOptions options{
        .frame = frameOptions(subject.state.forces, false), .first = job.first, .last = job.last};
    options.colourOf = linearColourOf;
    options.progress = [&](std::size_t done, std::size_t total) {
      job.done = done;
      job.total = total;
      changed();
    };
    Result<std::filesystem::path> outcome = job.wish.file;
    try {
      const auto facts = exportVessels(subject.document->scene, job.clip, *exportKindOf(job.wish.file),
                                       options, [&](std::uint32_t) { return job.wish.file; });
      if (!facts) outcome = facts.error();
    } catch (const Cancelled&) {
      outcome = Error{Fault::interrupted, "the export was cancelled"};
    } catch (const std::exception& error) {
      outcome = Error{Fault::failed, error.what()};
    }
    changed();
    return outcome;
  });
}

// The next frame's shape, on a thread of its own. What is shown is there already.
void Exporter::orderFrame(Job& job) const {
  const Subject& subject = job.subject;
  if (!job.video) {
    std::promise<std::shared_ptr<const PosedBody>> shown;
    shown.set_value(subject.body);
    job.coming = shown.get_future();
    return;
  }
  job.coming = std::async(std::launch::async,
                          [&job, frame = job.first + std::uint32_t(job.done),
                           changed = changed_]() -> std::shared_ptr<const PosedBody> {
                            const CancellationScope scope(job.cancellation);
                            std::shared_ptr<PosedBody> made;
                            try {
                              const Subject& of = job.subject;
                              if (!job.maker) {
                                FrameOptions options = frameOptions(of.state.forces, of.state.contacts);
                                options.track = std::make_shared<MotionTrack>(MotionTrack::Keeps::latest);
                                job.maker = std::make_unique<FrameMaker>(of.document->scene, options);
                              }
                              FrameMaker& maker = *job.maker;
                              maker.make(job.clip, job.clip ? job.clip->timeOfFrame(frame) : 0);
                              made = std::make_shared<PosedBody>();
                              made->order = of.body->order;
                              takeShapeOf(maker, of.state.contacts, *made);
                            } catch (const Cancelled&) {
                            }
                            changed();
                            return made;
                          });
}

bool Exporter::step() {
  if (!job_) return false;
  Job& job = *job_;
  if (job.file.valid()) {
    if (ready(job.file)) finish(job.file.get());
    return false;
  }
  if (job.cancellation.asked()) {
    wait();
    finish(Error{Fault::interrupted, "the export was cancelled"});
    return false;
  }
  if (!job.drawing && !ready(job.coming)) return false;
  return drawFrame(job);
}

bool Exporter::drawFrame(Job& job) {
  if (!job.drawing) {
    const auto body = job.coming.get();
    const Subject& subject = job.subject;
    const Scene& scene = subject.document->scene;
    Shot shot{.body = body,
              .camera = subject.camera,
              .look = subject.state.look,
              .width = job.wish.width,
              .height = job.wish.height,
              .colours = coloursOf(*subject.document, body, subject.state, job.colours),
              .fine = true};
    if (subject.state.follow) {
      const vec3 way = wayOverFloor(scene, body->pose) - wayOverFloor(scene, subject.body->pose);
      shot.camera.position += way;
      shot.camera.target += way;
    }
    job.painter->begin(shot);
    job.drawing = true;
    return true;
  }
  const auto turn = Clock::now();
  while (job.painter->step())
    if (msSince(turn) >= kSliceTime) return true;
  job.drawing = false;
  if (const auto written = writeFrame(job); !written) {
    finish(written.error());
    return false;
  }
  ++job.done;
  if (job.done < job.total) {
    orderFrame(job);
    return true;
  }
  if (job.video)
    if (const auto done = job.video->finish(); !done) {
      finish(done.error());
      return false;
    }
  finish(job.wish.file);
  return false;
}

Result<void> Exporter::writeFrame(Job& job) {
  const Image picture = job.painter->readBack();
  return job.video ? job.video->write(picture) : writePng(job.wish.file, picture);
}

void Exporter::finish(Result<std::filesystem::path> outcome) {
  outcome_ = std::move(outcome);
  job_.reset();
}

std::optional<Result<std::filesystem::path>> Exporter::take() {
  return std::exchange(outcome_, std::nullopt);
}

}  // namespace vasa::viewer
