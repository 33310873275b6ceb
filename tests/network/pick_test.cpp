#include "network/pick.h"

#include <doctest/doctest.h>

#include "support/networks.h"

using namespace vasa;

namespace {

// Two vessels along x, one 0.2 m behind the other as seen from +Z.
Network twoLines() {
  NetworkBuilder builder;
  builder.addVessel({"front", "", VesselKind::artery},
                    test::straightVessel({0, 0, 0.2f}, {1, 0, 0.2f}, 0.01f, 2));
  builder.addVessel({"back", "", VesselKind::vein}, test::straightVessel({0, 0, 0}, {1, 0, 0}, 0.05f, 2));
  return test::built(builder);
}

}  // namespace

TEST_CASE("a ray meets the nearest vessel, where it enters the tube") {
  const Network network = twoLines();
  const auto hit = pick(network, network.points(), {{0.5f, 0, 2}, {0, 0, -1}});
  REQUIRE(hit);
  CHECK(hit->vessel == VesselId{0});
  CHECK(hit->parameter == doctest::Approx(1).epsilon(0.01));  // two spans
  CHECK(hit->distance == doctest::Approx(2 - 0.21f).epsilon(1e-4));
  const auto past = pick(network, network.points(), {{0.25f, 0.03f, 2}, {0, 0, -1}});
  REQUIRE(past);
  CHECK(past->vessel == VesselId{1});
  CHECK(past->distance == doctest::Approx(2 - 0.04f).epsilon(1e-4));
}

TEST_CASE("hidden vessels and what is cut off are not met") {
  const Network network = twoLines();
  const Ray ray{{0.5f, 0, 2}, {0, 0, -1}};
  CHECK(pick(network, network.points(), ray, [](VesselId v) { return v.value == 1; })->vessel == VesselId{1});
  CHECK(pick(network, network.points(), {ray.origin, ray.direction, 1.9f})->vessel == VesselId{1});
  CHECK_FALSE(pick(network, network.points(), {ray.origin, ray.direction, 3}));
  CHECK_FALSE(pick(network, network.points(), {{0.5f, 0.2f, 2}, {0, 0, -1}}));
  CHECK_FALSE(pick(network, network.points(), {{0.5f, 0, 2}, {0, 0, 1}}));
}

TEST_CASE("slack lets a ray meet a vessel that it just misses") {
  const Network network = twoLines();
  const Ray ray{{0.5f, 0.06f, 2}, {0, 0, -1}};
  CHECK_FALSE(pick(network, network.points(), ray));
  CHECK(pick(network, network.points(), ray, {}, 0.04f)->vessel == VesselId{0});
}
