#include "scene/correction_step.h"

#include <algorithm>
#include <tuple>

// A sample's neighbours are looked up in a grid that is never laid out: those that can raise a bound above
// kAllowed are sorted by the number of their cell, and within it by their step, so that the first one near
// enough is all that a cell has to say.
namespace vasa {
namespace {

// A power of two, so that dividing by it rounds nothing, and no less than kNear: what is near lies in the
// same cell or a neighbouring one.
constexpr float kCell = 0.0625f;
static_assert(kCell >= CorrectionSteps::kNear);

// Places so far out that their cells have no number of their own share the outermost.
ivec3 cellOf(vec3 place) {
  constexpr float kOutermost = float(1 << 20) - 2;
  return ivec3(glm::clamp(glm::floor(place / kCell), -kOutermost, kOutermost));
}

std::uint64_t numberOf(ivec3 cell) {
  const auto axis = [](int c) { return std::uint64_t(c + (1 << 20)); };
  return axis(cell.x) << 42 | axis(cell.y) << 21 | axis(cell.z);
}

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
  if (!beyond.empty()) sortMoved(places);
  for (const auto& [i, step] : beyond) {
    const float bound = boundAt(lastPosed_[i], step);
    if (step <= bound) continue;
    ++steps.excess;
    if (!steps.worst || step - bound > steps.worst->step - steps.worst->bound)
      steps.worst = {samples_[i].vessel, samples_[i].parameter, step, bound};
  }
  return steps;
}

// Where samples that moved lie now. @param before  where all were posed in the frame before
void CorrectionSteps::sortMoved(std::span<const vec3> before) {
  moved_.clear();
  for (std::size_t i = 0; i < before.size(); ++i) {
    const float step = glm::distance(lastPosed_[i], before[i]);
    if (step > kAllowed) moved_.push_back({numberOf(cellOf(lastPosed_[i])), step, lastPosed_[i]});
  }
  std::ranges::sort(moved_, {}, [](const Moved& m) { return std::tuple(m.cell, -m.step); });
}

// The bound of a step at a place, or some part of it that is `enough`.
float CorrectionSteps::boundAt(vec3 place, float enough) const {
  float bound = kAllowed;
  const ivec3 middle = cellOf(place);
  for (int k = 0; k < 27 && bound < enough; ++k) {
    const std::uint64_t cell = numberOf(middle + ivec3(k / 9, k / 3 % 3, k % 3) - 1);
    for (auto m = std::ranges::lower_bound(moved_, cell, {}, &Moved::cell);
         m != moved_.end() && m->cell == cell && m->step > bound; ++m)
      if (glm::all(glm::lessThan(glm::abs(m->place - place), vec3(kNear)))) bound = m->step;
  }
  return bound;
}

}  // namespace vasa
