#include "viewer/cut_plane.h"

#include <algorithm>
#include <cmath>

namespace vasa::viewer {
namespace {

// Half the box's length along a direction.
float reachAlong(const Aabb& box, vec3 direction) {
  return 0.5f * glm::dot(glm::abs(direction), box.extent());
}

vec3 middleOf(const CutPlane& cut, const Aabb& box) {
  const vec3 away = cutDirection(cut);
  return box.centre() + reachAlong(box, away) * (1 - 2 * cut.place) * away;
}

}  // namespace

vec3 cutDirection(const CutPlane& cut) {
  const float turn = glm::radians(cut.turn), tilt = glm::radians(cut.tilt);
  return {std::sin(turn) * std::cos(tilt), std::sin(tilt), std::cos(turn) * std::cos(tilt)};
}

vec4 cutThrough(const CutPlane& cut, const Aabb& box) {
  const vec3 away = cutDirection(cut);
  return {-away, glm::dot(away, middleOf(cut, box))};
}

std::array<vec3, 4> cutOutline(const CutPlane& cut, const Aabb& box) {
  const float turn = glm::radians(cut.turn);
  const vec3 away = cutDirection(cut), across{std::cos(turn), 0, -std::sin(turn)},
             up = glm::cross(away, across);
  const vec3 middle = middleOf(cut, box), a = reachAlong(box, across) * across, b = reachAlong(box, up) * up;
  return {middle - a - b, middle + a - b, middle + a + b, middle - a + b};
}

void faceViewer(CutPlane& cut, vec3 forward) {
  cut.tilt = glm::degrees(std::asin(std::clamp(-forward.y, -1.0f, 1.0f)));
  cut.turn = glm::degrees(std::atan2(-forward.x, -forward.z));
}

}  // namespace vasa::viewer
