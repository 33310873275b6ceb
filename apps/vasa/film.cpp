#include "film.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/atomic_file.h"
#include "core/cancellation.h"
#include "core/log.h"
#include "core/parallel.h"
#include "core/stage_log.h"
#include "io/png.h"
#include "output_folder.h"
#include "report.h"

namespace vasa::cli {
namespace {

// Made on a thread of its own, unless one is to do everything.
std::future<std::unique_ptr<FrameMaker>> makerBeside(const FilmJob& job, const FrameOptions& frame) {
  return std::async(threadCount() > 1 ? std::launch::async : std::launch::deferred,
                    [&job, frame, asked = CancellationScope::current()] {
                      const CancellationScope scope(asked);
                      const StageLog stage("preparing how vessels move");
                      return std::make_unique<FrameMaker>(job.scene, frame);
                    });
}

Renderer rendererOf(const FilmJob& job, gpu::Device& device) {
  const StageLog stage("preparing to draw");
  RenderOptions options = job.render;
  options.table = &job.table;
  options.skeleton = &job.scene.body.skeleton;
  return Renderer(device, job.scene.network, job.scene.body.meshes, options);
}

}  // namespace

Film::Film(const FilmJob& job, const FrameOptions& frame, gpu::Device& device)
    : job_(job),
      making_(makerBeside(job, frame)),
      renderer_(rendererOf(job, device)),
      maker_(making_.get()) {}

Result<void> Film::run() {
  ProgressLine progress("rendering");
  if (!job_.video.empty()) {
    auto video =
        VideoWriter::create(job_.video, job_.render.width, job_.render.height, job_.timing.framesPerSecond);
    if (!video) return video.error();
    video_.emplace(std::move(*video));
  }
  for (std::uint32_t frame = job_.range.first; frame <= job_.range.last; ++frame) {
    checkpoint();
    if (frame % job_.shard.count != job_.shard.index) continue;
    if (auto done = makeFrame(frame); !done) return done;
    progress.update(frame - job_.range.first + 1, job_.range.last - job_.range.first + 1);
  }
  if (auto written = finishWriting(); !written) return written;
  return video_ ? video_->finish() : Result<void>();
}

Result<void> Film::makeFrame(std::uint32_t frame) {
  if (job_.resume && job_.pattern) {
    const auto present = isPresent(frame);
    if (!present) return present.error();
    if (*present) {
      ++kept;
      if (!video_) return {};
      auto picture = readPng(job_.pattern->of(frame));
      if (!picture) return picture.error();
      return video_->write(*picture);
    }
  }
  maker_->make(job_.clip, job_.timing.timeOfFrame(frame));
  noteStep(frame);
  if (job_.highlightContacts)
    highlightContacts();
  else if (job_.colouring != atlas::Colouring::kind || !job_.choice.hidden.empty())
    renderer_.setSweepColours(
        withoutHidden(atlas::spanColours(job_.scene.network, job_.groups, maker_->points(), job_.colouring)));
  const Camera camera = job_.camera.at(job_.scene, maker_->pose(), maker_->points());
  renderer_.draw({.points = maker_->points(),
                  .knotFrames = maker_->knotFrames(),
                  .jointMatrices = maker_->jointMatrices(),
                  .camera = camera,
                  .look = job_.look,
                  .heartScale = maker_->heartScale()});
  ++drawn;
  if (auto written = finishWriting(); !written) return written;
  Image picture = renderer_.readBack();
  if (job_.page) {
    auto labelled = withLabels(std::move(picture), camera);
    if (!labelled) return labelled.error();
    picture = std::move(*labelled);
  }
  writing_ =
      std::async(std::launch::async, [this, frame, done = std::move(picture)] { return write(frame, done); });
  return {};
}

Result<Image> Film::withLabels(Image picture, const Camera& camera) const {
  const auto type = plate::Typesetter::load();
  if (!type) return type.error();
  const plate::PlateStyle& page = *job_.page;
  const auto plan = plate::planPlate(
      {job_.scene, *maker_, job_.table, job_.scene.body.meshes, job_.shown, job_.shown, job_.look}, page,
      *type, camera, float(picture.width) / float(picture.height));
  if (!plan) return plan.error();
  for (const std::string& name : plan->unseen)
    logWarning("'" + name + "' is not seen in this picture and gets no label");
  const auto keys = atlas::legendOf(job_.scene.network, job_.groups, job_.colouring, plan->seen);
  const plate::Sheet sheet =
      plate::plateSheet(*plan, page, *type, std::make_shared<const Image>(std::move(picture)), keys);
  return plate::sheetImage(sheet, uvec2(job_.size.width, job_.size.height));
}

// What the scene hides has no colour.
std::vector<std::uint32_t> Film::withoutHidden(std::vector<std::uint32_t> colours) const {
  atlas::leaveOut(job_.scene.network, job_.shown, colours);
  return colours;
}

// Grey vessels; yellow where they ran through one another, red where they still do.
void Film::highlightContacts() {
  maker_->lookAtPosed();
  const Avoider& avoider = *maker_->avoider();
  std::vector<std::uint32_t> colours(job_.scene.network.sweepCount(), packColour({0.5f, 0.5f, 0.55f, 1}));
  const auto paint = [&](std::span<const Interference::Place> places, vec4 colour) {
    for (const Interference::Place& place : places)
      colours[place.contact.i] = colours[place.contact.j] = packColour(colour);
  };
  paint(avoider.found(), {1, 0.75f, 0, 1});
  paint(avoider.remaining(), {1, 0, 0, 1});
  renderer_.setSweepColours(withoutHidden(std::move(colours)));
}

// Whether this frame's picture is there already, from the same run.
Result<bool> Film::isPresent(std::uint32_t frame) const {
  const auto path = job_.pattern->of(frame);
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored)) return false;
  const auto comment = readPngComment(path);
  if (!comment) return false;  // no whole picture: a copy that was interrupted
  if (*comment == stamp(frame)) return true;
  return Error{Fault::resumeMismatch,
               path.string() +
                   ": was made by another run (other scene, clip or settings), so --resume "
                   "cannot go on from it; choose another output or leave out --resume"};
}

std::string Film::stamp(std::uint32_t frame) const {
  return fmt::format("vasa run {:016x} frame {}", job_.runHash, frame);
}

Result<void> Film::write(std::uint32_t frame, const Image& picture) {
  if (video_)
    if (auto written = video_->write(picture); !written) return written;
  if (!job_.pattern && !job_.printed) return {};
  const auto bytes = encodePng(picture, {.alpha = job_.look.transparent, .comment = stamp(frame)});
  if (!bytes) return bytes.error();
  if (job_.pattern) {
    const auto path = job_.pattern->of(frame);
    if (job_.pattern->numbersFolders())
      if (auto made = makeOutputFolder(path.parent_path()); !made) return made;
    return writeFileAtomically(path, *bytes);
  }
  return printBytes(*bytes);
}

Result<void> Film::finishWriting() { return writing_.valid() ? writing_.get() : Result<void>(); }

void Film::noteStep(std::uint32_t frame) {
  const auto points = maker_->points();
  if (!previous_.empty() && frame == previousFrame_ + 1) {
    for (std::size_t i = 0; i < points.size(); ++i) {
      const float step = glm::distance(vec3(points[i]), vec3(previous_[i]));
      if (step > largestStep) largestStep = step, largestStepFrame = frame;
    }
    for (std::size_t j = 0; j < previousPose_.world.size(); ++j)
      largestJointStep = std::max(
          largestJointStep, glm::distance(vec3(maker_->pose().world[j][3]), vec3(previousPose_.world[j][3])));
  }
  previous_.assign(points.begin(), points.end());
  previousPose_ = maker_->pose();
  previousFrame_ = frame;
}

}  // namespace vasa::cli
