#include "convert/fork_openings.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "curve/frame.h"

namespace vasa {
namespace {

constexpr float kInset = 0.12f;                       // of the radius: the strip between ring and wall
constexpr float kHalf = 0.45f, kAlmostAll = 0.9f;     // of a tube
constexpr float kStep = 0.25f, kFarthest = 8;         // radii: of moving out, and how far altogether
constexpr int kGrid = 10;                             // steps of the section's grid, to either side
constexpr float kGridStep = 0.19f;                    // radii: the grid ends before contours are too wide
constexpr float kMiddle = 0.5f;                       // radii: all of this has to be inside
constexpr float kLeastArea = 0.4f, kMostArea = 2.2f;  // of the round section
constexpr float kCore = 0.75f;                        // of the radius
constexpr float kCoreStep = 0.125f;                   // spans

ForkOpening openingAt(const Network& network, ForkOpening opening, float parameter) {
  const auto points = network.pointsOf(network.vessel(opening.vessel));
  const auto towards = [&](float u) { return opening.outward * unitTangent(points, u); };
  opening.parameter = parameter;
  opening.section = evaluate(points, parameter);
  opening.direction = towards(parameter);
  const float speed = std::max(glm::length(vec3(evaluateDerivative(points, parameter))), 1e-9f);
  const float inset = std::clamp(parameter - opening.outward * kInset * opening.section.w / speed, 0.0f,
                                 float(spanCount(points)));
  const vec4 inner = evaluate(points, inset);
  opening.cut = {vec3(inner), towards(inset), inner.w};
  return opening;
}

bool insideOf(std::span<const LooseWall* const> walls, vec3 p) {
  float sum = 0;
  for (const LooseWall* wall : walls) sum += wall->inside(p);
  return sum > 0.5f;
}

// What hangs together around the axis, on a grid in the plane of the cut.
bool oneSection(std::span<const LooseWall* const> walls, const WallOpening& cut) {
  constexpr int kSide = 2 * kGrid + 1;
  const vec3 u = anyPerpendicular(cut.outward), v = glm::cross(cut.outward, u);
  std::array<bool, kSide * kSide> seen{};
  std::vector<glm::ivec2> queue{{0, 0}};
  const auto numbered = [](glm::ivec2 at) { return std::size_t((at.y + kGrid) * kSide + at.x + kGrid); };
  seen[numbered({0, 0})] = true;
  std::size_t within = 0;
  for (std::size_t next = 0; next < queue.size(); ++next) {
    const glm::ivec2 at = queue[next];
    const vec2 place = kGridStep * vec2(at);
    if (!insideOf(walls, cut.centre + cut.radius * (place.x * u + place.y * v))) {
      if (glm::length(place) < kMiddle) return false;
      continue;
    }
    if (std::abs(at.x) == kGrid || std::abs(at.y) == kGrid || glm::length(place) > kGridStep * kGrid)
      return false;
    ++within;
    for (const glm::ivec2 step : {glm::ivec2(1, 0), glm::ivec2(-1, 0), glm::ivec2(0, 1), glm::ivec2(0, -1)})
      if (!seen[numbered(at + step)]) seen[numbered(at + step)] = true, queue.push_back(at + step);
  }
  const float area = float(within) * kGridStep * kGridStep / kPi;
  return area > kLeastArea && area < kMostArea;
}

void addCore(std::span<const vec4> points, float from, float to, std::vector<Capsule>& cores) {
  const int steps = std::max(1, int(std::ceil(std::abs(to - from) / kCoreStep)));
  for (int i = 0; i < steps; ++i) {
    const vec4 a = evaluate(points, glm::mix(from, to, float(i) / float(steps)));
    const vec4 b = evaluate(points, glm::mix(from, to, float(i + 1) / float(steps)));
    cores.push_back({vec3(a), vec3(b), kCore * std::min(a.w, b.w)});
  }
}

// From where a vessel ends to the nearest axis of the others' cores.
void addBridge(vec4 end, std::size_t trunkCores, std::vector<Capsule>& cores) {
  float least = std::numeric_limits<float>::infinity();
  vec3 nearest = vec3(end);
  for (const Capsule& core : std::span(cores).first(trunkCores))
    for (const vec3 place : {core.a, core.b})
      if (glm::distance(place, vec3(end)) < least) least = glm::distance(place, vec3(end)), nearest = place;
  if (trunkCores > 0) cores.push_back({vec3(end), nearest, kCore * end.w});
}

}  // namespace

std::vector<ForkOpening> forkOpenings(const Network& network, const ForkPlan& plan,
                                      const shared::ForkRecord& fork) {
  const ForkRings rings = ringsOf(plan, fork);
  std::vector<ForkOpening> openings;
  for (std::size_t i = 0; i < rings.count; ++i) {
    const float parameter = forkRingParameter(network, *rings.ring[i], rings.vessel[i]);
    ForkOpening opening{
        .vessel = {rings.vessel[i]}, .outward = rings.outward(i), .farthest = parameter, .cut = {}};
    if (const auto tube = tubeBehind(plan, rings.vessel[i], parameter, opening.outward))
      opening.farthest = glm::mix(tube->near, tube->far, tube->capped ? kAlmostAll : kHalf);
    openings.push_back(openingAt(network, opening, parameter));
  }
  return openings;
}

ForkOpening movedOut(const Network& network, ForkOpening opening, float distance) {
  const auto points = network.pointsOf(network.vessel(opening.vessel));
  const float speed = std::max(glm::length(vec3(evaluateDerivative(points, opening.parameter))), 1e-9f);
  const float further = opening.parameter + opening.outward * distance / speed;
  const bool beyond = opening.outward * (further - opening.farthest) > 0;
  return openingAt(network, opening, beyond ? opening.farthest : further);
}

void moveBeyondUnion(const Network& network, std::span<const LooseWall* const> walls,
                     std::span<ForkOpening> openings) {
  for (ForkOpening& opening : openings) {
    ForkOpening moved = opening;
    for (int step = 0; step <= int(kFarthest / kStep); ++step) {
      if (oneSection(walls, moved.cut)) {
        opening = moved;
        break;
      }
      const float before = moved.parameter;
      moved = movedOut(network, moved, kStep * opening.section.w);
      if (moved.parameter == before) break;
    }
  }
}

std::vector<Capsule> forkCores(const Network& network, std::span<const ForkOpening> openings) {
  std::vector<Capsule> cores;
  const ForkOpening &a = openings[0], &b = openings[1];
  const auto pointsOf = [&](const ForkOpening& opening) {
    return network.pointsOf(network.vessel(opening.vessel));
  };
  const auto inner = [&](const ForkOpening& opening) {
    return opening.outward > 0 ? 0.0f : float(spanCount(pointsOf(opening)));
  };
  if (a.vessel == b.vessel)
    addCore(pointsOf(a), a.parameter, b.parameter, cores);
  else {
    addCore(pointsOf(a), a.parameter, inner(a), cores);
    const std::size_t before = cores.size();
    addBridge(evaluate(pointsOf(b), inner(b)), before, cores);
    addCore(pointsOf(b), b.parameter, inner(b), cores);
  }
  const std::size_t trunk = cores.size();
  for (const ForkOpening& branch : openings.subspan(2)) {
    addCore(pointsOf(branch), branch.parameter, inner(branch), cores);
    addBridge(evaluate(pointsOf(branch), inner(branch)), trunk, cores);
  }
  return cores;
}

}  // namespace vasa
