#include "network/kinks.h"

#include <doctest/doctest.h>

#include <random>

#include "support/networks.h"

using namespace vasa;

namespace {

Network lineOf(std::uint32_t count, float radius) {
  std::vector<vec4> points;
  for (std::uint32_t k = 0; k < count; ++k) points.emplace_back(0.01f * float(k), 0, 0, radius);
  NetworkBuilder builder;
  builder.addVessel({"line", "", VesselKind::artery}, points);
  return test::built(builder);
}

// Bent at its middle by more than a right angle, too sharply for its radius.
std::vector<vec4> bent(const Network& network) {
  std::vector<vec4> points(network.points().begin(), network.points().end());
  const std::size_t middle = points.size() / 2;
  for (std::size_t k = middle; k < points.size(); ++k)
    points[k] = points[middle - 1] + vec4(-0.003f, 0.0095f, 0, 0) * float(k - middle + 1);
  return points;
}

}  // namespace

TEST_CASE("what the control polygon calls straight never kinks") {
  std::mt19937 random(8);
  std::normal_distribution<float> normal(0, 0.004f);
  int sharp = 0;
  for (int trial = 0; trial < 5000; ++trial) {
    Bezier tube;
    for (std::size_t k = 0; k < 4; ++k)
      tube.b[k] = vec4(0.01f * float(k) + normal(random), normal(random), normal(random), 0.004f);
    bool slow = false;  // by 200 samples
    for (int k = 0; k <= 200; ++k) {
      const vec3 first(tube.derivative(float(k) / 200)), second(tube.secondDerivative(float(k) / 200));
      const float speed = glm::length(first);
      slow |= 0.004f * glm::length(glm::cross(first, second)) >= speed * speed * speed;
    }
    sharp += slow;
    if (kinks(tube)) CHECK(slow);
  }
  CHECK(sharp > 100);
}

TEST_CASE("a sharp bend is a kink, and is straightened where the pose made it") {
  const Network network = lineOf(24, 0.006f);
  CHECK(kinkCount(network, network.points()) == 0);
  std::vector<vec4> points = bent(network);
  const std::uint32_t before = kinkCount(network, points);
  CHECK(before > 0);
  CHECK(KinkRelaxer(network).run(points) == before);
  CHECK(kinkCount(network, points) < before);
  for (const vec4& p : points) CHECK(p.w == 0.006f);
}

TEST_CASE("kinks at rest, and vessels without any, are left alone") {
  const Network straight = lineOf(24, 0.006f);
  NetworkBuilder builder;
  builder.addVessel({"bend", "", VesselKind::vein}, bent(straight));
  auto network = builder.build(1);
  REQUIRE(network.ok());
  std::vector<vec4> points(network->points().begin(), network->points().end());
  CHECK(kinkCount(*network, points) > 0);
  CHECK(KinkRelaxer(*network).run(points) == 0);
  CHECK(std::equal(points.begin(), points.end(), network->points().begin()));
}
