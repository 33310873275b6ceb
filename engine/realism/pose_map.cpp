#include "realism/pose_map.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "core/cancellation.h"

namespace vasa {
namespace {

constexpr float kPace = 80 * kPi / 180;  // [rad/s] a joint turns: that of a calm motion
constexpr std::array kKinds{LoadKind::kink, LoadKind::squeeze, LoadKind::stretch, LoadKind::shortening,
                            LoadKind::bone};

std::string degrees(float angle) { return std::to_string(int(std::lround(glm::degrees(angle)))); }

FrameOptions keptApart(FrameOptions options) {
  options.avoid = true;
  return options;
}

// From rest to an end, both included, in even steps no longer than asked for.
std::vector<float> anglesTo(float end, float step) {
  const int count = std::max(1, int(std::ceil(std::abs(end) / step - 1e-3f)));
  std::vector<float> angles;
  for (int k = 0; k <= count; ++k) angles.push_back(end * float(k) / float(count));
  return angles;
}

}  // namespace

std::string PoseRay::name() const {
  std::string text = range.name + " to " + degrees(high ? range.high : range.low);
  if (held) text += ", " + held->range.name + " " + degrees(held->angle);
  return text;
}

std::vector<PoseRay> singleRays(std::span<const JointRange> ranges) {
  std::vector<PoseRay> rays;
  for (const JointRange& range : ranges)
    for (const bool high : {false, true})
      if ((high ? range.high : range.low) != 0) rays.push_back({range, high, std::nullopt});
  return rays;
}

std::vector<PoseRay> pairedRays(const JointRange& held, const JointRange& turned, float step) {
  std::vector<float> angles;
  if (held.low < 0) angles = anglesTo(held.low, step);
  std::ranges::reverse(angles);
  if (held.high > 0) {
    const std::vector<float> up = anglesTo(held.high, step);
    angles.insert(angles.end(), up.begin() + !angles.empty(), up.end());
  }
  std::vector<PoseRay> rays;
  for (const float angle : angles)
    for (PoseRay& ray : singleRays({&turned, 1})) ray.held = {held, angle}, rays.push_back(std::move(ray));
  return rays;
}

PoseMap::PoseMap(const Scene& scene, FrameOptions options, LoadLimits limits, float step)
    : scene_(&scene),
      limits_(limits),
      step_(step),
      maker_(scene, keptApart(options)),
      meter_(scene.network) {}

Result<RayReport> PoseMap::walk(const PoseRay& ray) {
  RayReport report;
  report.strains.assign(scene_->network.vessels().size(), 0);
  std::map<std::pair<std::uint32_t, LoadKind>, PoseFinding> worst;
  float before = 0;
  for (const float angle : anglesTo(ray.high ? ray.range.high : ray.range.low, step_)) {
    checkpoint();
    std::vector<JointAngles> angles{ray.range.at(angle)};
    if (ray.held) angles.insert(angles.begin(), ray.held->range.at(ray.held->angle));
    const auto pose = poseByAngles(scene_->body.skeleton, angles);
    if (!pose) return pose.error();
    if (report.steps.empty())
      maker_.make(*pose);
    else
      maker_.moveTo(*pose, 0, std::abs(angle - before) / kPace);
    before = angle;
    const std::vector<VesselLoad> loads = meter_.run(maker_.points(), *maker_.avoider());
    RayReport::Step& step = report.steps.emplace_back();
    step.angle = angle;
    for (std::uint32_t v = 0; v < loads.size(); ++v) {
      if (std::abs(loads[v].strain) > std::abs(report.strains[v])) report.strains[v] = loads[v].strain;
      for (const LoadKind kind : kKinds) {
        const float severity = loads[v].severity(kind, limits_);
        if (severity > step.severity) step.severity = severity, step.vessel = {v}, step.kind = kind;
        if (severity < 1) continue;
        PoseFinding& finding = worst.try_emplace({v, kind}, PoseFinding{{v}, kind, angle}).first->second;
        if (severity <= finding.severity) continue;
        finding.angle = angle, finding.severity = severity;
        finding.value = loads[v].value(kind), finding.place = loads[v].place(kind);
      }
    }
  }
  for (const auto& [key, finding] : worst) report.findings.push_back(finding);
  std::ranges::stable_sort(report.findings, std::greater{}, &PoseFinding::severity);
  return report;
}

}  // namespace vasa
