#include "avoid/side_places.h"

#include <algorithm>
#include <limits>

namespace vasa {
namespace {

// The parameter of the point on `tube` nearest to p: the best of some samples, then Newton on the squared
// distance.
float nearestParameter(const Bezier& tube, vec3 p) {
  float best = 0, least = std::numeric_limits<float>::infinity();
  for (int k = 0; k <= 8; ++k) {
    const vec3 gap = vec3(tube.at(float(k) / 8)) - p;
    if (glm::dot(gap, gap) < least) least = glm::dot(gap, gap), best = float(k) / 8;
  }
  for (int step = 0; step < 3; ++step) {
    const vec3 gap = vec3(tube.at(best)) - p, first(tube.derivative(best)),
               second(tube.secondDerivative(best));
    const float speed = glm::dot(first, first),
                curvature = std::max(speed + glm::dot(gap, second), 0.2f * speed);
    if (!(curvature > 0)) break;
    best = std::clamp(best - glm::dot(gap, first) / curvature, 0.0f, 1.0f);
  }
  return best;
}

}  // namespace

std::array<SidePlace, kSidePlaces> sidePlaces(const Contact& nearest, std::span<const Bezier> tubes) {
  std::array<SidePlace, kSidePlaces> places{{{nearest.s, nearest.t}}};
  for (std::size_t k = 1; k < kSidePlaces; ++k) {
    const float s = float(k - 1) / float(kSidePlaces - 2);
    places[k] = {s, nearestParameter(tubes[nearest.j], vec3(tubes[nearest.i].at(s)))};
  }
  return places;
}

}  // namespace vasa
