#include "avoid/room.h"

#include <algorithm>
#include <cmath>

namespace vasa {
namespace {

constexpr float kProbe = 1e-4f;      // [m]
constexpr float kThinnest = 2e-4f;   // [m] between the balls of a thin tube
constexpr int kMostBalls = 40;       // of a tube

}  // namespace

std::uint32_t StretchLine::nearest(vec3 p) const {
  const auto nearer = [&](vec3 a, vec3 b) { return glm::dot(a - p, a - p) < glm::dot(b - p, b - p); };
  return std::uint32_t(std::ranges::min_element(places, nearer) - places.begin());
}

Room::Room(const Bones& bones, const Interference& interference, const StretchLine& line, float reach)
    : bones_(&bones), firstTube_(line.tubes.front()) {
  const std::uint32_t lastTube = line.tubes.back();
  for (std::uint32_t tube = firstTube_; tube <= lastTube; ++tube) {
    std::vector<float>& allowed = allowed_.emplace_back();
    for (std::uint32_t part = 0; part < bones.partCount(); ++part) allowed.push_back(bones.allowed(tube, part));
  }
  Aabb box;
  for (const vec3& place : line.places) box.add(place, reach);
  const std::span<const Bezier> tubes = interference.tubes();
  for (std::uint32_t tube = 0; tube < tubes.size(); ++tube) {
    if (!tubes[tube].bounds().overlaps(box) || (tube >= firstTube_ && tube <= lastTube)) continue;
    bool belongs = false;
    float allowed = 0;
    for (std::uint32_t own = firstTube_; own <= lastTube && !belongs; ++own) {
      const TubePair pair{std::min(own, tube), std::max(own, tube)};
      belongs = interference.layout().neighbours().find(pair) != nullptr;
      allowed = std::min(allowed, interference.allowed(pair));
    }
    if (!belongs) addTube(tubes[tube], allowed);
  }
}

void Room::addTube(const Bezier& tube, float allowed) {
  const float length = glm::distance(vec3(tube.b[0]), vec3(tube.b[3])), apart = std::max(tube.at(0.5f).w, kThinnest);
  const int pieces = std::clamp(int(std::ceil(length / apart)), 1, kMostBalls);
  for (int k = 0; k <= pieces; ++k) {
    const vec4 ball = tube.at(float(k) / float(pieces));
    balls_.push_back({vec3(ball), ball.w + allowed});
  }
}

float Room::at(vec3 place, float wanted, std::uint32_t tube) const {
  float room = std::min(wanted, bones_->room(place, allowed_[tube - firstTube_]));
  for (const Ball& ball : balls_) {
    const vec3 gap = place - ball.centre;
    const float reach = std::max(ball.radius + room, 0.0f);
    if (glm::dot(gap, gap) < reach * reach) room = glm::length(gap) - ball.radius;
  }
  return room;
}

vec3 Room::slope(vec3 place, float wanted, std::uint32_t tube) const {
  vec3 slope(0);
  for (int axis = 0; axis < 3; ++axis) {
    vec3 aside(0);
    aside[axis] = kProbe;
    slope[axis] = at(place + aside, wanted, tube) - at(place - aside, wanted, tube);
  }
  const float size = glm::length(slope);
  return size > 0.1f * kProbe ? slope / size : vec3(0);
}

}  // namespace vasa
