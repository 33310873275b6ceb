#include "body/volume.h"

#include <doctest/doctest.h>

#include <limits>

#include "network/sample_network.h"

using namespace vasa;

namespace {

Network sample() {
  auto network = test::sampleBuilder().build(1.75f);
  REQUIRE(network.ok());
  return std::move(network).value();
}

std::vector<vec4> stretched(const Network& network, float factor) {
  std::vector<vec4> points(network.points().begin(), network.points().end());
  for (vec4& p : points) p.y *= factor;
  return points;
}

}  // namespace

TEST_CASE("at rest nothing changes") {
  const Network network = sample();
  auto points = stretched(network, 1);
  const auto outcome = VolumeKeeper(network).run(points);
  CHECK(outcome.largestError < 1e-7f);
  for (std::size_t i = 0; i < points.size(); ++i)
    CHECK(points[i].w == doctest::Approx(network.points()[i].w).epsilon(1e-6));
}

TEST_CASE("stretched and squeezed vessels keep their volume to 1e-5, rings at forks unmoved") {
  const Network network = sample();
  const VolumeKeeper keeper(network);
  for (const float factor : {0.7f, 0.9f, 1.05f, 1.3f}) {
    auto points = stretched(network, factor);
    const auto outcome = keeper.run(points);
    CHECK(outcome.largestError < 1e-5f);
    CHECK(outcome.clampedCount == 0);
    for (const Vessel& vessel : network.vessels()) {
      const auto before = network.pointsOf(vessel), after = Network::pointsOf(vessel, points);
      CHECK(volumeOf(after) == doctest::Approx(volumeOf(before)).epsilon(2e-5));
      if (vessel.start.valid()) CHECK(after.front().w == before.front().w);
      if (vessel.end.valid()) CHECK(after.back().w == before.back().w);
      if (!vessel.end.valid() && vessel.kind == VesselKind::vein)
        CHECK(after.back().w == doctest::Approx(before.back().w / std::sqrt(factor)).epsilon(1e-4));
    }
  }
}

TEST_CASE("like walls: an artery's radii stay within a tenth, a vein gives way and does not fill") {
  const Network network = sample();
  const VolumeKeeper keeper(network, Keep::wall);
  for (const float factor : {0.7f, 0.95f, 1.05f, 1.3f}) {
    CAPTURE(factor);
    auto points = stretched(network, factor);
    keeper.run(points);
    for (const Vessel& vessel : network.vessels()) {
      if (vessel.end.valid()) continue;
      const float change = Network::pointsOf(vessel, points).back().w / network.pointsOf(vessel).back().w;
      const float wanted = 1 / std::sqrt(factor);
      if (vessel.kind == VesselKind::artery) {
        CHECK(change >= 0.9f * 0.9999f);
        CHECK(change <= 1.1f * 1.0001f);
        CHECK((change > 1) == (factor < 1));
        if (std::abs(factor - 1) < 0.06f)  // within its limits
          CHECK(volumeOf(Network::pointsOf(vessel, points)) ==
                doctest::Approx(volumeOf(network.pointsOf(vessel))).epsilon(2e-5));
      } else
        CHECK(change == doctest::Approx(std::min(wanted, 1.0f)).epsilon(1e-4));
    }
  }
}

TEST_CASE("beyond sane radii the rest is reported") {
  const Network network = sample();
  auto points = stretched(network, 30);
  const auto outcome = VolumeKeeper(network).run(points);
  CHECK(outcome.clampedCount > 0);
  CHECK(outcome.clampedError > 0.1f);
  CHECK(outcome.largestError < 1e-4f);
  for (std::size_t i = 0; i < points.size(); ++i)
    CHECK(points[i].w >= VolumeKeeper::kLowestFactor * network.points()[i].w * 0.9999f);
}

TEST_CASE("where a radius is held down the rest of the vessel keeps the volume") {
  const Network network = sample();
  const VolumeKeeper keeper(network);
  auto points = stretched(network, 0.95f);
  std::vector<float> most(points.size(), std::numeric_limits<float>::infinity());
  const Vessel& vessel = network.vessels()[0];
  const std::uint32_t held = vessel.firstPoint + vessel.pointCount / 2;
  most[held] = 0.8f * network.points()[held].w;
  const auto outcome = keeper.run(points, most);
  CHECK(outcome.largestError < 1e-5f);
  CHECK(outcome.clampedCount == 0);
  CHECK(points[held].w == most[held]);
  CHECK(volumeOf(Network::pointsOf(vessel, points)) ==
        doctest::Approx(volumeOf(network.pointsOf(vessel))).epsilon(2e-5));
  std::fill(most.begin(), most.end(), 0.0005f);
  points = stretched(network, 0.95f);
  CHECK(keeper.run(points, most).clampedCount > 0);
}

TEST_CASE(
    "with a memory of the last run the result is the same to the bit, whatever has moved or is held since") {
  const Network network = sample();
  const VolumeKeeper keeper(network);
  VolumeKeeper::Memory memory;
  std::vector<float> most(network.points().size(), std::numeric_limits<float>::infinity());
  const auto compare = [&](std::vector<vec4> points) {
    auto alone = points;
    const auto outcome = keeper.run(points, most, memory), expected = keeper.run(alone, most);
    CHECK(points == alone);
    CHECK(outcome.largestError == expected.largestError);
    CHECK(outcome.clampedError == expected.clampedError);
    CHECK(outcome.clampedCount == expected.clampedCount);
  };
  auto points = stretched(network, 0.8f);
  compare(points);
  compare(points);  // nothing has moved
  points[network.vessels()[1].firstPoint + 2].x += 0.002f;
  compare(points);  // one vessel has
  most[network.vessels()[0].firstPoint + 2] = 0.5f * network.points()[network.vessels()[0].firstPoint + 2].w;
  compare(points);  // one is held
  compare(stretched(network, 1.2f));
  CHECK(memory.outcomes.size() == network.vessels().size());
}
