#include "support/networks.h"

#include <algorithm>
#include <random>
#include <stdexcept>

namespace vasa::test {
namespace {

// Of calls among the arguments of another the order is a compiler's own: braces, and names of their own, keep
// it, so that every compiler makes the same networks.
class Random {
 public:
  explicit Random(std::uint32_t seed) : engine_(seed) {}
  float in(float low, float high) { return low + (high - low) * float(engine_() >> 8) / float(1 << 24); }
  std::uint32_t below(std::uint32_t count) { return engine_() % count; }
  vec3 direction() {
    for (;;) {
      const vec3 v{in(-1, 1), in(-1, 1), in(-1, 1)};
      const float length = glm::length(v);
      if (length > 0.1f && length < 1) return v / length;
    }
  }

 private:
  std::mt19937 engine_;
};

std::vector<vec4> windingPoints(Random& random, vec3 start, std::uint32_t count) {
  std::vector<vec4> points;
  vec3 heading = random.direction();
  const float step = random.in(0.01f, 0.03f);
  float radius = random.in(0.002f, 0.008f);
  for (std::uint32_t i = 0; i < count; ++i) {
    points.emplace_back(start, radius);
    heading = glm::normalize(heading + 0.6f * random.direction());
    start += step * heading;
    radius *= random.in(0.85f, 1.1f);
  }
  return points;
}

constexpr VesselKind kKinds[] = {VesselKind::artery, VesselKind::vein, VesselKind::portalVein,
                                 VesselKind::other};

}  // namespace

Network windingNetwork(std::uint32_t vessels, std::uint32_t seed) {
  Random random(seed);
  NetworkBuilder builder;
  for (std::uint32_t i = 0; i < vessels; ++i) {
    const std::uint32_t count = 4 + random.below(12);
    vec3 start{random.in(-0.3f, 0.3f), random.in(0, 1), random.in(-0.2f, 0.2f)};
    const bool branch = i % 3 == 2;
    const VesselId host{branch ? random.below(i) : 0};
    float parameter = 0;
    if (branch) {
      const auto& points = builder.pointsOf(host);
      parameter = random.in(0.1f, 0.9f) * float(spanCount(points));
      start = vec3(evaluate(points, parameter));
    }
    const VesselId vessel = builder.addVessel({"vessel " + std::to_string(i), "", kKinds[i % 4]},
                                              windingPoints(random, start, count));
    if (branch) builder.joinToSide({vessel, false}, {host, parameter});
  }
  return built(builder);
}

Network branchingNetwork(std::uint32_t vessels, std::uint32_t seed) {
  Random random(seed);
  NetworkBuilder builder;
  // A gently bent vessel of some length, from a point on along a direction.
  const auto add = [&](vec3 start, vec3 heading, float radius) {
    std::vector<vec4> points;
    const float step = random.in(3, 6) * radius;
    for (std::uint32_t i = 0, count = 6 + random.below(4); i < count; ++i) {
      points.emplace_back(start, radius);
      start += step * (i == 0 || i + 2 == count ? 0.4f : 1.0f) * heading;
      heading = glm::normalize(heading + 0.15f * random.direction());
      radius *= random.in(0.93f, 1.02f);
    }
    return builder.addVessel({"vessel " + std::to_string(builder.vesselCount()), "", kKinds[0]},
                             std::move(points));
  };
  while (builder.vesselCount() < vessels) {
    const vec3 place{random.in(-0.4f, 0.4f), random.in(0, 1), random.in(-0.4f, 0.4f)};
    const vec3 heading = random.direction();
    const VesselId trunk = add(place, heading, random.in(0.003f, 0.006f));
    const std::vector<vec4> points = builder.pointsOf(trunk);
    const float parameter = random.in(0.4f, 0.7f) * float(spanCount(points));
    const vec4 at = evaluate(points, parameter);
    const vec3 along = glm::normalize(vec3(evaluateDerivative(points, parameter)));
    const auto leaving = [&](float most) {
      const vec3 side = glm::normalize(glm::cross(along, random.direction()));
      const float angle = random.in(0.45f, most);
      return std::cos(angle) * along + std::sin(angle) * side;
    };
    for (std::uint32_t i = 0, count = 1 + random.below(3); i < count; ++i) {  // often at one place
      const vec3 away = leaving(2.6f);
      builder.joinToSide({add(vec3(at), away, at.w * random.in(0.15f, 1)), false}, {trunk, parameter});
    }
    const vec4 tip = points.back();
    const vec3 onward = glm::normalize(vec3(points.back() - points[points.size() - 2]));
    std::vector<VesselEnd> ends{{trunk, true}};
    for (std::uint32_t i = 0, count = 1 + random.below(3); i < count; ++i) {
      const vec3 side = glm::normalize(glm::cross(onward, random.direction()));
      const float angle = count == 1 ? 0.3f : random.in(0.35f, 0.9f);
      ends.push_back(
          {add(vec3(tip), std::cos(angle) * onward + std::sin(angle) * side, tip.w * random.in(0.5f, 0.95f)),
           false});
    }
    builder.joinEnds(ends);
  }
  return built(builder);
}

Network built(const NetworkBuilder& builder) {
  Result<Network> network = builder.build(1.0f);
  if (!network) throw std::logic_error(network.error().message);
  return std::move(*network);
}

std::vector<vec4> straightVessel(vec3 from, vec3 to, float radius, std::uint32_t spans) {
  std::vector<vec4> points;
  // Greville abscissae make the curve run along the line at constant speed.
  for (std::uint32_t i = 0; i < spans + 3; ++i) {
    const auto knot = [&](int k) { return float(std::clamp(k, 0, int(spans))); };
    const float u = (knot(int(i) - 2) + knot(int(i) - 1) + knot(int(i))) / 3;
    points.push_back(vec4(glm::mix(from, to, u / float(spans)), radius));
  }
  return points;
}

Network straightVessel(float length, float r0, float r1, std::uint32_t spans) {
  std::vector<vec4> points;
  // Greville abscissae of the clamped knots make C(u) and r(u) linear in u.
  for (std::uint32_t i = 0; i < spans + 3; ++i) {
    const auto knot = [&](int k) { return float(std::min(std::max(k, 0), int(spans))); };
    const float f = (knot(int(i) - 2) + knot(int(i) - 1) + knot(int(i))) / float(3 * spans);
    points.emplace_back(0, 0, f * length, r0 + f * (r1 - r0));
  }
  NetworkBuilder builder;
  builder.addVessel({"straight", "", VesselKind::artery}, std::move(points));
  return built(builder);
}

Network levelVessel(float reach, float y) {
  std::vector<vec4> points;
  for (int k = 0; k < 20; ++k) points.emplace_back(-reach + 2 * reach * float(k) / 19, y, 0, 0.002f);
  NetworkBuilder builder;
  builder.addVessel({"level", "", VesselKind::artery}, std::move(points));
  return built(builder);
}

}  // namespace vasa::test
