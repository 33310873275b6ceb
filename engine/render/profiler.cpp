#include "render/profiler.h"

#include <algorithm>
#include <chrono>

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
  return quads.pixelError > 0 ? "auto" : std::to_string(quads.shape.around) + "x" + std::to_string(quads.shape.along);
}

struct Profiler::Pass {
  Pass(gpu::Device& device, const ProfileSetting& setting, const RenderOptions& options)
      : maker(*setting.scene, {.avoid = setting.avoid}), renderer(device, setting.scene->network, setting.meshes, options) {}
  FrameMaker maker;
  Renderer renderer;
  RenderInput input;
  std::uint32_t frame = 0;
};

Profiler::Profiler(gpu::Device& device, ProfileSetting setting, std::vector<ProfileQuads> quads)
    : device_(device), setting_(std::move(setting)), wanted_(std::move(quads)) {}
Profiler::~Profiler() = default;

void Profiler::startPass(bool timed) {
  RenderOptions options = setting_.render;
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
  const std::uint32_t clipFrames = setting_.clip ? setting_.clip->frameCount() : 1;
  const auto start = std::chrono::steady_clock::now();
  pass.maker.make(setting_.clip, setting_.clip ? setting_.clip->timeOfFrame(pass.frame % clipFrames) : 0);
  pass.input = {.points = pass.maker.points(),
                .knotFrames = pass.maker.knotFrames(),
                .jointMatrices = setting_.meshes.empty() ? std::span<const mat4>() : pass.maker.jointMatrices(),
                .camera = setting_.camera(pass.maker),
                .look = setting_.look};
  pass.renderer.draw(pass.input);
  const double ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  if (pass.frame++ >= kWarmUpFrames) note(ms);
  if (pass.frame < kWarmUpFrames + setting_.frames) return true;
  if (!pass.renderer.options().timed) startPass(true);
  else finishRow();
  return rows_.size() < wanted_.size();
}

void Profiler::note(double frameMs) {
  const auto add = [&](const char* name, double ms) {
    auto found = std::ranges::find(samples_, name, &std::pair<std::string, std::vector<double>>::first);
    if (found == samples_.end()) found = samples_.insert(found, {name, {}});
    found->second.push_back(ms);
  };
  Pass& pass = *pass_;
  if (!pass.renderer.options().timed) return add("frame_ms", frameMs);
  for (const auto& [stage, ms] : shapeStages(pass.maker.report(), setting_.avoid)) add(stage, ms);
  for (const auto& [stage, ms] : pictureStages(pass.renderer.times(), setting_.render.growth != nullptr)) add(stage, ms);
  add("triangles_drawn", double(pass.renderer.drawnTriangleCount()));
  if ((pass.frame - kWarmUpFrames) % kStaticEvery == 1) add("static_draw_ms", pass.renderer.staticDraw(pass.input, 1));
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
  rows_.push_back(std::move(row));
  samples_.clear();
  pass_.reset();
}

}  // namespace vasa
