#include "make_human/taper.h"

#include <algorithm>
#include <cmath>

namespace vasa::human {
namespace {

constexpr float kTipRadius = 0.25e-3f;                         // [m]
constexpr float kStretchOfRadius = 45;                         // over what the vessel loses of its radius
constexpr float kShortestShare = 0.25f, kLongestShare = 0.6f;  // of the vessel's length
constexpr float kPower = 0.7f;  // below 1: the last bit thins most, as where twig after twig leaves

}  // namespace

void thinOut(std::span<float> radii, float length, float most) {
  const float wide = radii.back(), tip = std::min(kTipRadius, wide);
  const float stretch = std::min(
      std::clamp(kStretchOfRadius * (wide - tip), kShortestShare * length, kLongestShare * length), most);
  for (std::size_t k = 0; k + 1 < radii.size(); ++k) {
    const float left = length * float(radii.size() - 1 - k) / float(radii.size() - 1);
    if (left < stretch) radii[k] = tip + (radii[k] - tip) * std::pow(left / stretch, kPower);
  }
  radii.back() = tip;
}

}  // namespace vasa::human
