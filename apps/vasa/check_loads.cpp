#include "check_loads.h"

#include <cmath>

namespace vasa::cli {
namespace {

// Of a vessel's length from one frame to the next: what a wall takes in a thirtieth of a second without a
// jerk.
constexpr float kFast = 0.05f;

void keepWorst(auto& worst, float value, float place, std::uint32_t frame) {
  if (std::abs(value) > std::abs(worst.value)) worst = {value, place, frame};
}

}  // namespace

void ClipLoads::look(std::uint32_t frame, std::span<const vec4> points, const Avoider& avoider) {
  const std::vector<VesselLoad> loads = meter_.run(points, avoider);
  const bool follows = !lengths_.empty();
  lengths_.resize(loads.size());
  for (std::size_t v = 0; v < loads.size(); ++v) {
    const float length = 1 + loads[v].strain;
    keepWorst(worst_[v].kink, loads[v].kink, loads[v].kinkPlace, frame);
    keepWorst(worst_[v].strain, loads[v].strain, 0, frame);
    if (follows) keepWorst(worst_[v].step, length / lengths_[v] - 1, 0, frame);
    lengths_[v] = length;
  }
}

Report ClipLoads::report() const {
  const LoadLimits limits;
  Report report{{"kinked", Report::array()}, {"strained", Report::array()}, {"fast", Report::array()}};
  for (std::size_t v = 0; v < worst_.size(); ++v) {
    const std::string& name = network_->vessels()[v].name;
    const auto& [kink, strain, step] = worst_[v];
    if (kink.value >= limits.kink)
      report["kinked"].push_back(
          {{"vessel", name}, {"at", kink.place}, {"bend", kink.value}, {"frame", kink.frame}});
    if (std::abs(strain.value) > limits.strain)
      report["strained"].push_back(
          {{"vessel", name}, {"length_change", strain.value}, {"frame", strain.frame}});
    if (std::abs(step.value) > kFast)
      report["fast"].push_back({{"vessel", name}, {"length_step", step.value}, {"frame", step.frame}});
  }
  return report;
}

}  // namespace vasa::cli
