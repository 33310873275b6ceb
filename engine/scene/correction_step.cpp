#include "scene/correction_step.h"

#include <algorithm>

namespace vasa {
namespace {

vec3 placeOf(std::span<const vec4> points, std::uint32_t first, vec4 weights) {
  return weights.x * vec3(points[first]) + weights.y * vec3(points[first + 1]) +
         weights.z * vec3(points[first + 2]) + weights.w * vec3(points[first + 3]);
}

}  // namespace

CorrectionSteps::CorrectionSteps(const Network& network) {
  std::vector<std::vector<float>> parameters(network.vessels().size());
  for (std::size_t v = 0; v < parameters.size(); ++v)
    for (std::uint32_t i = 0, count = network.vessels()[v].spanCount() * kSamplesPerSpan; i <= count; ++i)
      parameters[v].push_back(float(i) / float(kSamplesPerSpan));
  for (const Node& node : network.nodes())
    if (node.host) parameters[node.host->vessel.value].push_back(node.host->parameter);
  for (std::size_t v = 0; v < parameters.size(); ++v)
    addSamples(network, {std::uint32_t(v)}, std::move(parameters[v]));
}

void CorrectionSteps::addSamples(const Network& network, VesselId id, std::vector<float> parameters) {
  const Vessel& vessel = network.vessel(id);
  std::ranges::sort(parameters);
  parameters.erase(std::unique(parameters.begin(), parameters.end()), parameters.end());
  for (const float u : parameters) {
    const SpanParameter at = locate(u, vessel.spanCount());
    samples_.push_back(
        {id, u, vessel.firstPoint + at.span, deBoorWeights(at.span, vessel.spanCount(), at.t)});
  }
}

std::optional<CorrectionSteps::Steps> CorrectionSteps::next(std::span<const vec4> posed,
                                                            std::span<const vec4> corrected) {
  std::vector<vec3> places, corrections;
  places.reserve(samples_.size()), corrections.reserve(samples_.size());
  for (const Sample& sample : samples_) {
    places.push_back(placeOf(posed, sample.firstPoint, sample.weights));
    corrections.push_back(placeOf(corrected, sample.firstPoint, sample.weights) - places.back());
  }
  std::swap(lastPosed_, places), std::swap(lastCorrection_, corrections);
  if (places.empty()) return std::nullopt;

  Steps steps;
  std::vector<std::pair<std::uint32_t, float>> beyond;  // samples and their steps
  for (std::uint32_t i = 0; i < samples_.size(); ++i) {
    const float step = glm::distance(lastCorrection_[i], corrections[i]);
    steps.largest = std::max(steps.largest, step);
    if (step > kAllowed) beyond.emplace_back(i, step);
  }
  if (!beyond.empty())
    posedSteps_.set(kAllowed, places.size(), [&](std::size_t i) {
      return std::pair(lastPosed_[i], glm::distance(lastPosed_[i], places[i]));
    });
  for (const auto& [i, step] : beyond) {
    const float bound = posedSteps_.longest(lastPosed_[i], step);
    if (step <= bound) continue;
    ++steps.excess;
    if (!steps.worst || step - bound > steps.worst->step - steps.worst->bound)
      steps.worst = {samples_[i].vessel, samples_[i].parameter, step, bound};
  }
  return steps;
}

}  // namespace vasa
