#include "body/strain.h"

#include <algorithm>
#include <cmath>

namespace vasa {
namespace {

constexpr std::uint32_t kStepsPerSpan = 4;

float strainOf(const VesselStrain& strain) {
  return std::max(std::abs(std::log(strain.least)), std::abs(std::log(strain.most)));
}

}  // namespace

std::vector<VesselStrain> measureStrain(const Network& network, std::span<const vec4> before,
                                        std::span<const vec4> after, float factor) {
  std::vector<VesselStrain> all;
  for (std::uint32_t v = 0; v < network.vessels().size(); ++v) {
    const auto from = Network::pointsOf(network.vessels()[v], before),
               to = Network::pointsOf(network.vessels()[v], after);
    const std::uint32_t steps = kStepsPerSpan * network.vessels()[v].spanCount();
    VesselStrain strain{{v}, 1, 1, vec3(evaluate(to, 0))};
    bool first = true;
    const auto look = [&](float was, float is, std::uint32_t step) {
      if (!(was > 0)) return;
      const float ratio = std::max(is / (factor * was), 1e-6f);
      const float worst = first ? -1 : strainOf(strain);
      strain.least = first ? ratio : std::min(strain.least, ratio);
      strain.most = first ? ratio : std::max(strain.most, ratio);
      first = false;
      if (strainOf(strain) > worst) strain.place = vec3(evaluate(to, float(step) / kStepsPerSpan));
    };
    float was = 0, is = 0;
    bool whole = true;
    for (std::uint32_t i = 1; i <= steps; ++i) {
      const float a = float(i - 1) / kStepsPerSpan, b = float(i) / kStepsPerSpan;
      was += glm::distance(vec3(evaluate(from, a)), vec3(evaluate(from, b)));
      is += glm::distance(vec3(evaluate(to, a)), vec3(evaluate(to, b)));
      if (was < kStrainPiece) continue;
      look(was, is, i);
      was = is = 0, whole = false;
    }
    if (whole) look(was, is, steps);
    all.push_back(strain);
  }
  std::ranges::stable_sort(all, std::greater{}, strainOf);
  return all;
}

}  // namespace vasa
