#include "realism/clip_loads.h"

#include <cmath>

namespace vasa {
namespace {

void keepWorst(VesselBeyond& worst, float value, float place, std::uint32_t frame) {
  if (std::abs(value) > std::abs(worst.value)) worst = {worst.vessel, value, place, frame};
}

}  // namespace

ClipLoads::ClipLoads(const Network& network, const LoadLimits& limits) : meter_(network), limits_(limits) {
  for (std::uint32_t v = 0; v < network.vessels().size(); ++v) kinks_.push_back({.vessel = {v}});
  strains_ = steps_ = kinks_;
}

void ClipLoads::look(std::uint32_t frame, std::span<const vec4> points, const Avoider& avoider) {
  const std::vector<VesselLoad> loads = meter_.run(points, avoider);
  const bool follows = !lengths_.empty();
  lengths_.resize(loads.size());
  for (std::size_t v = 0; v < loads.size(); ++v) {
    const float length = 1 + loads[v].strain;
    keepWorst(kinks_[v], loads[v].kink, loads[v].kinkPlace, frame);
    keepWorst(strains_[v], loads[v].strain, 0, frame);
    if (follows && lengths_[v] > 0) keepWorst(steps_[v], length / lengths_[v] - 1, 0, frame);
    lengths_[v] = length;
  }
}

std::vector<VesselBeyond> ClipLoads::beyond(std::span<const VesselBeyond> worst, float limit) {
  std::vector<VesselBeyond> found;
  for (const VesselBeyond& vessel : worst)
    if (std::abs(vessel.value) >= limit) found.push_back(vessel);
  return found;
}

}  // namespace vasa
