#include "render/profiler.h"

#include <algorithm>
#include <array>
#include <future>

#include "core/clock.h"
#include "core/parallel.h"
#include "gpu/device.h"

namespace vasa {
namespace {

constexpr std::uint32_t kWarmUpFrames = 5;  // shaders compile at their first use
constexpr std::uint32_t kStaticEvery = 8;   // frames: it takes memory for every vertex

double median(std::vector<double> values) {
  const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

StageTimes shapeStages(const FrameReport& report, bool avoided) {
  StageTimes stages{{"pose_ms", report.poseMs},
                    {"deform_ms", report.deformMs},
                    {"kinks_ms", report.kinksMs},
                    {"volume_ms", report.volumeMs}};
  if (avoided)
    stages.insert(stages.end(), {{"detect_ms", report.avoid.detectMs},
                                 {"obstacles_ms", report.avoid.boneMs},
                                 {"avoid_ms", report.avoid.solveMs},
                                 {"certify_ms", report.avoid.certifyMs}});
  stages.emplace_back("knot_frames_ms", report.framesMs);
  return stages;
}

StageTimes pictureStages(const FrameTimes& times, bool capillaries) {
  StageTimes stages{{"upload_ms", times.upload},
                    {"tessellate_ms", times.tessellate},
                    {"forks_ms", times.forks},
                    {"draw_ms", times.draw}};
  if (capillaries) stages.emplace_back("capillaries_ms", times.capillaries);
  stages.emplace_back("meshes_ms", times.meshes);
  return stages;
}

double ProfileRow::fps() const {
  const auto frame = std::ranges::find(stages, "frame_ms", &std::pair<std::string, double>::first);
  return frame == stages.end() || frame->second <= 0 ? 0 : 1000 / frame->second;
}

std::string ProfileRow::name() const {
  return quads.pixelError > 0 ? "auto"
                              : std::to_string(quads.shape.around) + "x" + std::to_string(quads.shape.along);
}

// One shape can be drawn while the other is made.
struct Profiler::Pass {
  struct Shape {
    std::vector<vec4> points;
    std::vector<quat> knotFrames;
    std::vector<mat4> jointMatrices;
    Camera camera;
    FrameReport report;
    Clock::time_point start;
    double ms = 0;
  };
  Pass(gpu::Device& device, const ProfileSetting& chosen, const RenderOptions& options)
      : setting(chosen),
        besidePicture(device.isCpu()),
        renderer(device, chosen.scene->network, chosen.meshes, options),
        maker(*chosen.scene, {.avoid = chosen.avoid}) {}

  void make(std::uint32_t number) {
    Shape& shape = shapes[number % 2];
    shape.start = Clock::now();
    const std::uint32_t clipFrames = setting.clip ? setting.clip->frameCount() : 1;
    // On and on: what was made once would be read from the track.
    const float time = setting.clip ? setting.clip->timeOfFrame(number % clipFrames) : 0;
    const Skeleton& skeleton = setting.scene->body.skeleton;
    const Pose pose = setting.clip ? samplePose(skeleton, *setting.clip, time) : restPose(skeleton);
    maker.moveTo(pose, time, setting.clip ? 1 / setting.clip->framesPerSecond : 0);
    shape.points.assign(maker.points().begin(), maker.points().end());
    shape.knotFrames.assign(maker.knotFrames().begin(), maker.knotFrames().end());
    shape.jointMatrices.assign(maker.jointMatrices().begin(), maker.jointMatrices().end());
    shape.camera = setting.camera(maker);
    shape.report = maker.report();
    shape.ms = msSince(shape.start);
  }
  // @return what the frame is drawn from, good until the next but one
  Shape& take(bool ahead) {
    if (next.valid())
      next.get();
    else
      make(frame);
    if (ahead)
      next = std::async(std::launch::async, [this, number = frame + 1] {
        if (besidePicture) giveWay();
        make(number);
      });
    return shapes[frame % 2];
  }
  // Once nothing else runs.
  double drawStatic() {
    if (next.valid()) next.wait();
    return renderer.staticDraw(input, 1);
  }
  double draw(const Shape& shape) {
    const auto start = Clock::now();
    input = {.points = shape.points,
             .knotFrames = shape.knotFrames,
             .jointMatrices = setting.meshes.empty() ? std::span<const mat4>() : shape.jointMatrices,
             .camera = shape.camera,
             .look = setting.look};
    renderer.draw(input);
    return msSince(start);
  }

  const ProfileSetting& setting;
  const bool besidePicture;  // shapes are made by the processors that draw
  Renderer renderer;
  RenderInput input;
  std::uint32_t frame = 0;
  FrameMaker maker;
  std::array<Shape, 2> shapes;
  std::future<void> next;  // waits for its thread when it goes, before what that writes to
};

Profiler::Profiler(gpu::Device& device, ProfileSetting setting, std::vector<ProfileQuads> quads)
    : device_(device), setting_(std::move(setting)), wanted_(std::move(quads)) {}
Profiler::~Profiler() = default;

void Profiler::startPass(bool timed) {
  RenderOptions options = setting_.render;
  options.skeleton = &setting_.scene->body.skeleton;
  options.shape = wanted_[rows_.size()].shape;
  options.pixelError = wanted_[rows_.size()].pixelError;
  options.timed = timed;
  pass_.reset();  // its memory first
  pass_ = std::make_unique<Pass>(device_, setting_, options);
}

bool Profiler::step() {
  if (rows_.size() == wanted_.size()) return false;
  if (!pass_) startPass(false);
  Pass& pass = *pass_;
  const auto start = Clock::now();
  const Pass::Shape& shape = pass.take(!pass.renderer.options().timed);
  const double solveMs = shape.ms, pictureMs = pass.draw(shape);
  // What an app did since the last step may have hidden some of the shape's time.
  const FrameTime time{.frame = std::max(msSince(start), solveMs),
                       .latency = msSince(shape.start),
                       .solve = solveMs,
                       .picture = pictureMs};
  if (pass.frame++ >= kWarmUpFrames) note(time, shape.report);
  if (pass.frame < kWarmUpFrames + setting_.frames) return true;
  if (!pass.renderer.options().timed)
    startPass(true);
  else
    finishRow();
  return rows_.size() < wanted_.size();
}

void Profiler::note(const FrameTime& time, const FrameReport& shape) {
  const auto add = [&](const char* name, double ms) {
    auto found = std::ranges::find(samples_, name, &std::pair<std::string, std::vector<double>>::first);
    if (found == samples_.end()) found = samples_.insert(found, {name, {}});
    found->second.push_back(ms);
  };
  Pass& pass = *pass_;
  const std::uint32_t phase = (pass.frame - kWarmUpFrames) % kStaticEvery;
  if (!pass.renderer.options().timed) {
    if (phase != 2) {  // the next shape was ready before that picture
      add("frame_ms", time.frame);
      add("latency_ms", time.latency);
    }
    // Beside the frames: a shared machine's pace changes.
    if (phase == 1) staticDraws_.push_back(pass.drawStatic());
    return;
  }
  for (const auto& [stage, ms] : shapeStages(shape, setting_.avoid)) add(stage, ms);
  add("solve_ms", time.solve);
  for (const auto& [stage, ms] : pictureStages(pass.renderer.times(), setting_.render.growth != nullptr))
    add(stage, ms);
  add("picture_ms", time.picture);
  add("triangles_drawn", double(pass.renderer.drawnTriangleCount()));
}

void Profiler::finishRow() {
  const Renderer& renderer = pass_->renderer;
  ProfileRow row{.quads = wanted_[rows_.size()],
                 .sweeps = renderer.sweepCount(),
                 .triangles = renderer.triangleCount(),
                 .stages = {},
                 .capillaries = renderer.capillaryCounts(),
                 .templateBytes = renderer.templateBytes()};
  for (auto& [name, values] : samples_) row.stages.emplace_back(name, median(std::move(values)));
  row.stages.emplace_back("static_draw_ms", median(std::move(staticDraws_)));
  staticDraws_.clear();
  rows_.push_back(std::move(row));
  samples_.clear();
  pass_.reset();
}

}  // namespace vasa
