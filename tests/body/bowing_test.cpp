#include "body/bowing.h"

#include <doctest/doctest.h>

#include "body/sliding.h"
#include "curve/arc_length.h"
#include "network/sample_network.h"

using namespace vasa;

namespace {

constexpr float kSpan = 0.012f;
constexpr std::uint32_t kSpans = 40;

// A vessel that hangs down on one side of the body, held by one across at either end.
Network hanging(float side, float radius) {
  NetworkBuilder builder;
  const vec3 top(0.1f * side, 1.0f, 0.04f), bottom = top - vec3(0, kSpan * kSpans, 0);
  const VesselId vessel = builder.addVessel({"vessel"}, test::straightVessel(top, bottom, radius, kSpans));
  for (const bool last : {false, true}) {
    const vec3 middle = last ? bottom : top;
    const VesselId host =
        builder.addVessel({"host"}, test::straightVessel(middle - vec3(0.05f * side, 0, 0),
                                                         middle + vec3(0.05f * side, 0, 0), 0.004f, 4));
    builder.joinToSide({vessel, last}, {host, 2});
  }
  auto network = builder.build(1.75f);
  REQUIRE_MESSAGE(network.ok(), network.error().message);
  return std::move(network).value();
}

// All of it on one joint, whose link runs down beside it.
Binding boundTo(const Network& network, float side) {
  Binding binding;
  SpineJoint joint;
  joint.centre = vec3(0.1f * side, 1.2f, 0), joint.axis = vec3(0, -1, 0);
  binding.spines.joints.push_back(joint);
  binding.pointCount = std::uint32_t(network.points().size());
  for (std::uint32_t i = 0; i < binding.pointCount; ++i) {
    if (i % Binding::kBlock == 0) binding.firstRecord.push_back(i);
    binding.records.emplace_back(Station{{0}, 2}, std::uint16_t(kWholeShare));
  }
  return binding;
}

std::vector<vec4> posed(const Network& network, const Binding& binding, float share, bool bows = true) {
  std::vector<vec4> points(network.points().begin(), network.points().end());
  for (vec4& p : points) p.y = 1 - (1 - p.y) * share;
  pinEnds(network, points);
  const std::vector<quat> turned(points.size(), quat(1, 0, 0, 0));
  VesselSlider(network, bows ? &binding : nullptr).run(points, turned);
  return points;
}

float lengthOf(const Network& network, std::span<const vec4> points) {
  return ArcLength(Network::pointsOf(network.vessels()[0], points)).length();
}

}  // namespace

TEST_CASE("a vessel that is squeezed bows out by a quarter of what it lost, one that is stretched does not") {
  const Network network = hanging(1, 0.003f);
  const Binding binding = boundTo(network, 1);
  const float rest = lengthOf(network, network.points());
  for (const float share : {1.0f, 1.2f}) {
    const auto points = posed(network, binding, share), straight = posed(network, binding, share, false);
    for (std::size_t i = 0; i < points.size(); ++i) CHECK(points[i] == straight[i]);
  }
  for (const float share : {0.95f, 0.85f, 0.7f}) {
    const float length = lengthOf(network, posed(network, binding, share));
    CAPTURE(share);
    // Ends of half a wave hold: there less comes back.
    CHECK(length > rest * (share + 0.25f * (1 - share) * 0.75f));
    CHECK(length < rest * (share + 0.25f * (1 - share) * 1.05f));
  }
}

TEST_CASE("a bowed vessel is a helix about its course, of the other hand on the other side of the body") {
  const Network left = hanging(1, 0.003f), right = hanging(-1, 0.003f);
  const auto a = posed(left, boundTo(left, 1), 0.8f), b = posed(right, boundTo(right, -1), 0.8f);
  for (std::size_t i = 0; i < a.size(); ++i)
    CHECK(glm::distance(vec3(-a[i].x, a[i].y, a[i].z), vec3(b[i])) < 1e-6f);
  // Of a helix whose length is 1.0625 times its course's: radius and pitch.
  const float radius = std::sqrt(1.0625f * 1.0625f - 1) * 0.8f * kBowWave / (2 * kPi);
  const auto own = Network::pointsOf(left.vessels()[0], std::span<const vec4>(a));
  float turned = 0, last = 0;
  for (float u = 12; u <= 28; u += 0.25f) {
    const vec4 p = evaluate(own, u);
    const vec2 off(p.x - 0.1f, p.z - 0.04f);
    CHECK(glm::length(off) == doctest::Approx(radius).epsilon(0.04));
    const float angle = std::atan2(off.y, off.x);
    if (u > 12) turned += angle - last - 2 * kPi * std::round((angle - last) / (2 * kPi));
    last = angle;
  }
  CHECK(std::abs(turned) == doctest::Approx(2 * kPi * 16 * kSpan / kBowWave).epsilon(0.03));
}

TEST_CASE("ends that hold and thin vessels do not bow") {
  const Network network = hanging(1, 0.003f), thin = hanging(1, 0.0007f);
  const Binding binding = boundTo(network, 1), ofThin = boundTo(thin, 1);
  const auto points = posed(network, binding, 0.8f), straight = posed(network, binding, 0.8f, false);
  const auto own = network.vessels()[0];
  CHECK(points[own.firstPoint] == straight[own.firstPoint]);
  CHECK(points[own.firstPoint + own.pointCount - 1] == straight[own.firstPoint + own.pointCount - 1]);
  const auto still = posed(thin, ofThin, 0.8f), course = posed(thin, ofThin, 0.8f, false);
  for (std::size_t i = 0; i < still.size(); ++i) CHECK(still[i] == course[i]);
}

TEST_CASE("bowing is continuous in the pose") {
  const Network network = hanging(1, 0.003f);
  const Binding binding = boundTo(network, 1);
  std::vector<vec4> last;
  for (float share = 1.05f; share > 0.5f; share -= 0.002f) {
    const auto points = posed(network, binding, share);
    for (std::size_t i = 0; i < last.size(); ++i)
      // The bed moves by 1 mm a step, the radius grows as the root of what is lost, by 0.6 mm in the first.
      CHECK(glm::distance(vec3(points[i]), vec3(last[i])) < 1.7e-3f);
    last = points;
  }
}
