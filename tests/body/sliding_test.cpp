#include "body/sliding.h"

#include <doctest/doctest.h>

#include "curve/arc_length.h"
#include "network/builder.h"
#include "support/networks.h"

using namespace vasa;

namespace {

constexpr float kRadius = 0.003f;

// A vessel of so many spans of 1 cm along x, joined from parts of 10 spans each, and a branch on the side of
// the first part.
Network lineNetwork(std::uint32_t parts, bool backwards = false) {
  NetworkBuilder builder;
  std::vector<VesselId> line;
  for (std::uint32_t part = 0; part < parts; ++part) {
    std::vector<vec4> points;
    for (const float u :
         {0.0f, 1 / 3.0f, 1.0f, 2.0f, 3.0f, 4.0f, 5.0f, 6.0f, 7.0f, 8.0f, 9.0f, 10 - 1 / 3.0f, 10.0f})
      points.emplace_back(0.1f * float(part) + 0.01f * u, 0, 0, kRadius);
    if (backwards && part % 2) std::reverse(points.begin(), points.end());
    line.push_back(builder.addVessel({"part", "", VesselKind::artery}, points));
    if (part > 0)
      builder.joinEnds(
          {{line[part - 1], !(backwards && (part - 1) % 2)}, {line[part], backwards && part % 2}});
  }
  std::vector<vec4> branch;
  for (const float u : {0.0f, 1 / 3.0f, 1.0f, 2.0f, 3.0f - 1 / 3.0f, 3.0f})
    branch.emplace_back(0.08f, 0.01f * u, 0, 0.001f);
  builder.joinToSide({builder.addVessel({"branch", "", VesselKind::artery}, branch), false}, {line[0], 8});
  auto network = builder.build(1.75f);
  REQUIRE_MESSAGE(network.ok(), network.error().message);
  return std::move(network).value();
}

// What lies between two places along x is squeezed to a share of its length; what lies beyond moves along.
std::vector<vec4> squeezed(const Network& network, float from, float to, float share) {
  std::vector<vec4> points(network.points().begin(), network.points().end());
  for (vec4& p : points) p.x -= (1 - share) * std::clamp(p.x - from, 0.0f, to - from);
  pinEnds(network, points);
  return points;
}

float stretchOf(const Network& network, std::span<const vec4> points, std::uint32_t vessel, float from,
                float to) {
  const Vessel& own = network.vessels()[vessel];
  const ArcLength rest(network.pointsOf(own)), posed(Network::pointsOf(own, points));
  return (posed.along(to) - posed.along(from)) / (rest.along(to) - rest.along(from));
}

}  // namespace

TEST_CASE("sliding leaves the rest pose as it is, to the bit, and what is only moved and turned") {
  const Network network = test::branchingNetwork(30, 5);
  const VesselSlider slider(network);
  std::vector<vec4> points(network.points().begin(), network.points().end());
  slider.run(points);
  for (std::size_t i = 0; i < points.size(); ++i) CHECK(points[i] == network.points()[i]);
  const quat turn = glm::angleAxis(1.0f, glm::normalize(vec3(1, 2, 3)));
  for (vec4& p : points) p = vec4(turn * vec3(p) + vec3(0.3f, 0, 0), p.w);
  const std::vector<vec4> before = points;
  slider.run(points);
  for (std::size_t i = 0; i < points.size(); ++i)
    CHECK(glm::distance(vec3(points[i]), vec3(before[i])) < 5e-6f);
}

TEST_CASE(
    "strain evens out over the sliding length, across vessels joined end to end, in whichever direction they run") {
  for (const bool backwards : {false, true}) {
    const Network network = lineNetwork(24, backwards);
    std::vector<vec4> points = squeezed(network, 1.15f, 1.25f, 0.5f);
    const float before = stretchOf(network, points, 11, backwards ? 1.0f : 6.0f, backwards ? 4.0f : 9.0f),
                length = 2.35f;
    CHECK(before == doctest::Approx(0.5f).epsilon(0.01));
    VesselSlider(network).run(points);
    // A rod tied to its bed: the mean of the strain, weighted by e^(-distance / ℓ) / 2ℓ.
    const float l = VesselSlider::slidingLength(kRadius);
    const auto expected = [&](float s) {
      const auto integral = [&](float t) {
        return t < s ? 0.5f * std::exp((t - s) / l) : 1 - 0.5f * std::exp((s - t) / l);
      };
      return 1 - 0.5f * (integral(1.25f) - integral(1.15f));
    };
    CHECK(stretchOf(network, points, 11, backwards ? 3.0f : 6.0f, backwards ? 4.0f : 7.0f) ==
          doctest::Approx(expected(1.165f)).epsilon(0.02));
    CHECK(stretchOf(network, points, 10, 4, 6) == doctest::Approx(expected(1.05f)).epsilon(0.02));
    CHECK(stretchOf(network, points, 14, 4, 6) == doctest::Approx(expected(1.45f)).epsilon(0.03));
    // Between the ends, beyond which there is nothing to slide into, nothing is gained or lost, and no point
    // leaves the line.
    float whole = 0;
    for (std::uint32_t v = 0; v < 24; ++v) whole += lengthOf(Network::pointsOf(network.vessels()[v], points));
    CHECK(whole == doctest::Approx(length).epsilon(1e-4));
    CHECK(points[network.vessels()[0].firstPoint].x == network.points()[network.vessels()[0].firstPoint].x);
    for (std::uint32_t i = 0; i < network.vessels().back().firstPoint; ++i)
      CHECK(std::abs(points[i].y) < 1e-6f);
  }
}

TEST_CASE("a free end draws back where its vessel is stretched") {
  const Network network = lineNetwork(1);
  std::vector<vec4> points = squeezed(network, 0, 0.1f, 2.0f);
  VesselSlider(network).run(points);
  // Both ends are free and the bed is long for so short a rod: it keeps nearly its own length, in the middle.
  const auto own = Network::pointsOf(network.vessels()[0], points);
  const float l = VesselSlider::slidingLength(kRadius),
              expected = 0.1f + 0.1f * (1 - std::tanh(0.05f / l) / (0.05f / l));
  CHECK(lengthOf(own) == doctest::Approx(expected).epsilon(0.01));
  CHECK(own.front().x + own.back().x == doctest::Approx(0.2f).epsilon(1e-3));
}

TEST_CASE("what branches off goes along with its host and stays on it") {
  const Network network = lineNetwork(3);
  std::vector<vec4> points = squeezed(network, 0.1f, 0.2f, 0.4f);
  const std::vector<vec4> before = points;
  VesselSlider(network).run(points);
  const Vessel& branch = network.vessels().back();
  const auto own = Network::pointsOf(branch, points), was = Network::pointsOf(branch, before);
  const float shift = own.front().x - was.front().x;
  CHECK(shift < -0.005f);  // out of what is squeezed
  const vec4 place = evaluate(Network::pointsOf(network.vessels()[0], points), 8);
  CHECK(glm::distance(vec3(place), vec3(own.front())) < 1e-6f);
  for (std::size_t i = 1; i < own.size(); ++i) {
    CHECK(own[i].x - was[i].x < 0.3f * shift);  // 3 cm long: most of it comes along
    CHECK(own[i].x - was[i].x >= own[i - 1].x - was[i - 1].x);
    CHECK(own[i].y == was[i].y);
  }
}

TEST_CASE("a vessel slides past a side branch at a fork, and two that are alike hold it") {
  const auto shiftWith = [](float branchRadius) {
    NetworkBuilder builder;
    const auto line = [&](vec3 from, vec3 way, float radius) {
      std::vector<vec4> points;
      for (const float u : {0.0f, 1 / 3.0f, 1.0f, 2.0f, 3.0f, 4.0f, 5 - 1 / 3.0f, 5.0f})
        points.emplace_back(from + 0.02f * u * way, radius);
      return builder.addVessel({"part", "", VesselKind::vein}, points);
    };
    const VesselId trunk = line({0, 0, 0}, {1, 0, 0}, 1.2f * kRadius),
                   onward = line({0.1f, 0, 0}, {1, 0, 0}, kRadius),
                   branch = line({0.1f, 0, 0}, {0, 1, 0}, branchRadius);
    builder.joinEnds({{trunk, true}, {onward, false}, {branch, false}});
    auto network = builder.build(1.75f);
    REQUIRE(network.ok());
    std::vector<vec4> points =
        squeezed(*network, 0, 0.1f, 2.0f);  // the trunk is stretched, what lies beyond is not
    VesselSlider(*network).run(points);
    const vec3 start(points[network->vessels()[2].firstPoint]),
        fork(points[network->vessels()[1].firstPoint]);
    CHECK(start == fork);
    return fork.x - 0.2f;
  };
  CHECK(shiftWith(0.7f * kRadius) < -0.01f);
  CHECK(shiftWith(0.9f * kRadius) == doctest::Approx(0));
}

TEST_CASE("where a vessel is held it stays in its bed, whichever way it runs, and strain evens out between") {
  for (const bool backwards : {false, true}) {
    const Network network = lineNetwork(3, backwards);
    const std::vector<vec4> bed = squeezed(network, 0.1f, 0.2f, 0.5f);
    const std::vector<VesselHold> holds{{"part", 0.4f}, {"no vessel of this network", 0.5f}};
    std::vector<vec4> free = bed, held = bed;
    VesselSlider(network).run(free);
    VesselSlider(network, nullptr, holds).run(held);
    for (std::uint32_t part = 0; part < 3; ++part) {
      const std::uint32_t point = network.vessels()[part].firstPoint + 5;  // u = 4
      CHECK(held[point].x == doctest::Approx(bed[point].x).epsilon(1e-6));
      CHECK(std::abs(free[point].x - bed[point].x) > 1e-3f);
    }
    CHECK(stretchOf(network, bed, 1, 5, 9) == doctest::Approx(0.5f).epsilon(0.01));
    // From 4 cm to 14 or, where that part runs backwards, 16 cm, and from there to 24 cm.
    CHECK(stretchOf(network, held, 1, 5, 9) == doctest::Approx(backwards ? 0.75f : 0.7f).epsilon(0.005));
  }
}

TEST_CASE("sliding is continuous in the pose") {
  const Network network = lineNetwork(5);
  const VesselSlider slider(network);
  std::vector<vec4> last;
  for (float share = 1; share > 0.3f; share -= 0.01f) {
    std::vector<vec4> points = squeezed(network, 0.2f, 0.3f, share);
    slider.run(points);
    for (std::size_t i = 0; i < last.size(); ++i)
      CHECK(glm::distance(vec3(points[i]), vec3(last[i])) < 1.5e-3f);  // the bed: 1 mm
    last = points;
  }
}
