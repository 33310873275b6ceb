#include "avoid/room.h"

#include <algorithm>
#include <cmath>

namespace vasa {
namespace {

constexpr float kProbe = 1e-4f;      // [m]
constexpr float kThinnest = 2e-4f;   // [m] between the balls of a thin tube
constexpr int kMostBalls = 40;       // of a tube
constexpr float kCell = 0.004f;      // [m] of the grid

}  // namespace

std::uint32_t StretchLine::nearest(vec3 p) const {
  const auto nearer = [&](vec3 a, vec3 b) { return glm::dot(a - p, a - p) < glm::dot(b - p, b - p); };
  return std::uint32_t(std::ranges::min_element(places, nearer) - places.begin());
}

Room::Room(const Bones& bones, const Interference& interference, const StretchLine& line, float aside, float widest)
    : bones_(&bones), widest_(widest), firstTube_(line.tubes.front()) {
  for (const vec3& place : line.places) box_.add(place, aside);
  counts_ = ivec3(glm::ceil(box_.extent() / kCell)) + 1;
  cells_.resize(std::size_t(counts_.x) * std::size_t(counts_.y) * std::size_t(counts_.z));
  const std::uint32_t lastTube = line.tubes.back();
  for (std::uint32_t part = 0; part < bones.partCount(); ++part) {
    if (!bones.box(part).overlaps(box_)) continue;
    std::vector<float>& allowed = parts_.emplace_back(part).allowed;
    for (std::uint32_t tube = firstTube_; tube <= lastTube; ++tube) allowed.push_back(bones.allowed(tube, part));
  }
  const Aabb reach{box_.low - widest, box_.high + widest};
  const std::span<const Bezier> tubes = interference.tubes();
  for (std::uint32_t tube = 0; tube < tubes.size(); ++tube) {
    if (!tubes[tube].bounds().overlaps(reach) || (tube >= firstTube_ && tube <= lastTube)) continue;
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
    addBall({vec3(ball), ball.w + allowed});
  }
}

void Room::addBall(const Ball& ball) {
  const float reach = std::max(ball.radius, 0.0f) + widest_;
  const ivec3 low = glm::max(ivec3(glm::floor((ball.centre - reach - box_.low) / kCell)), ivec3(0));
  const ivec3 high = glm::min(ivec3(glm::floor((ball.centre + reach - box_.low) / kCell)), counts_ - 1);
  for (int z = low.z; z <= high.z; ++z)
    for (int y = low.y; y <= high.y; ++y)
      for (int x = low.x; x <= high.x; ++x) cells_[std::size_t((z * counts_.y + y) * counts_.x + x)].push_back(std::uint32_t(balls_.size()));
  balls_.push_back(ball);
}

std::span<const std::uint32_t> Room::ballsNear(vec3 place) const {
  const ivec3 cell = ivec3(glm::floor((place - box_.low) / kCell));
  if (glm::any(glm::lessThan(cell, ivec3(0))) || glm::any(glm::greaterThanEqual(cell, counts_))) return {};
  return cells_[std::size_t((cell.z * counts_.y + cell.y) * counts_.x + cell.x)];
}

float Room::at(vec3 place, float wanted, std::uint32_t tube) const {
  float room = wanted;
  for (const Part& part : parts_)
    if (bones_->box(part.number).overlaps({place, place})) room = std::min(room, bones_->distance(part.number, place) - part.allowed[tube - firstTube_]);
  for (const std::uint32_t number : ballsNear(place)) {
    const Ball& ball = balls_[number];
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
