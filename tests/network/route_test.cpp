#include "network/route.h"

#include <doctest/doctest.h>

#include "network/measure_profile.h"
#include "support/networks.h"

using namespace vasa;

namespace {

// A trunk along x with a branch from its middle, a twig on that one's end, and a vessel apart.
struct Tree {
  Tree() {
    NetworkBuilder builder;
    trunk = builder.addVessel({"trunk"}, test::straightVessel({0, 0, 0}, {1, 0, 0}, 0.01f, 2));
    branch = builder.addVessel({"branch"}, test::straightVessel({0.5f, 0, 0}, {0.5f, 0.4f, 0}, 0.01f, 2));
    twig = builder.addVessel({"twig"}, test::straightVessel({0.5f, 0.4f, 0}, {0.7f, 0.4f, 0}, 0.01f, 2));
    apart = builder.addVessel({"apart"}, test::straightVessel({0, 0, 1}, {1, 0, 1}, 0.01f, 2));
    builder.joinToSide({branch, false}, {trunk, 1});
    builder.joinEnds({{branch, true}, {twig, false}});
    network = *builder.build(1);
  }
  Network network;
  VesselId trunk, branch, twig, apart;
};

}  // namespace

TEST_CASE("relatives: parents and children by where vessels hang") {
  const Tree tree;
  CHECK(relativesOf(tree.network, tree.trunk).parents.empty());
  CHECK(relativesOf(tree.network, tree.trunk).children == std::vector{tree.branch});
  CHECK(relativesOf(tree.network, tree.branch).parents == std::vector{tree.trunk});
  CHECK(relativesOf(tree.network, tree.branch).children == std::vector{tree.twig});
  CHECK(relativesOf(tree.network, tree.twig).parents == std::vector{tree.branch});
  CHECK(treeBelow(tree.network, tree.trunk) == std::vector{tree.trunk, tree.branch, tree.twig});
  CHECK(treeBelow(tree.network, tree.apart) == std::vector{tree.apart});
}

TEST_CASE("a route runs along centre lines and changes vessels where they meet") {
  const Tree tree;
  const RouteFinder finder(tree.network, tree.network.points());
  const auto route = finder.find({tree.trunk, 0}, {tree.twig, 2});
  REQUIRE(route);
  CHECK(route->length == doctest::Approx(0.5 + 0.4 + 0.2).epsilon(1e-4));
  REQUIRE(route->legs.size() == 3);
  CHECK(route->legs[0].vessel == tree.trunk);
  CHECK(route->legs[0].to == doctest::Approx(1));
  CHECK(route->legs[2].vessel == tree.twig);
  const auto back = finder.find({tree.twig, 2}, {tree.trunk, 0});
  REQUIRE(back);
  CHECK(back->length == doctest::Approx(route->length));
}

TEST_CASE("routes within one vessel, and none between separate parts") {
  const Tree tree;
  const RouteFinder finder(tree.network, tree.network.points());
  CHECK(finder.find({tree.trunk, 0}, {tree.trunk, 2})->length == doctest::Approx(1).epsilon(1e-4));
  CHECK(finder.find({tree.trunk, 0.5f}, {tree.trunk, 0.5f})->length == doctest::Approx(0));
  CHECK_FALSE(finder.find({tree.trunk, 0}, {tree.apart, 1}));
}

TEST_CASE("routes keep the triangle inequality and are as long both ways") {
  const Network network = test::branchingNetwork(40, 3);
  const RouteFinder finder(network, network.points());
  const VesselPlace places[] = {{VesselId{0}, 0.5f}, {VesselId{7}, 0.2f}, {VesselId{23}, 0.9f}};
  const auto length = [&](int a, int b) {
    const auto route = finder.find(places[a], places[b]);
    return route ? route->length : 1e9f;
  };
  for (int i = 0; i < 3; ++i) CHECK(length(i, (i + 1) % 3) == doctest::Approx(length((i + 1) % 3, i)));
  CHECK(length(0, 2) <= length(0, 1) + length(1, 2) + 1e-5f);
}

TEST_CASE("stations along a route count on from vessel to vessel, whichever way each is passed") {
  const Tree tree;
  const RouteFinder finder(tree.network, tree.network.points());
  // From the twig's end, down the branch, to the trunk's start: half of them against their own direction.
  const auto route = finder.find({tree.twig, 2}, {tree.trunk, 0});
  REQUIRE(route);
  REQUIRE(route->legs.size() == 3);
  const auto stations = stationsAlong(tree.network, tree.network.points(), *route, 0.01f);
  CHECK(stations.front().along == 0);
  CHECK(stations.back().along == doctest::Approx(route->length));
  CHECK(glm::distance(stations.front().centre, vec3(0.7f, 0.4f, 0)) < 1e-6f);
  CHECK(glm::distance(stations.back().centre, vec3(0)) < 1e-6f);
  CHECK(stations.size() >= std::size_t(route->length / 0.01f));
  for (std::size_t k = 1; k < stations.size(); ++k) {
    CHECK(stations[k].along >= stations[k - 1].along);
    CHECK(glm::distance(stations[k].centre, stations[k - 1].centre) ==
          doctest::Approx(stations[k].along - stations[k - 1].along).epsilon(1e-3));
    CHECK(stations[k].radius == doctest::Approx(0.01f));
  }
  // A way that ends where one vessel meets the next does not end twice.
  const auto down = finder.find({tree.branch, 2}, {tree.trunk, 1});
  REQUIRE(down);
  const auto once = stationsAlong(tree.network, tree.network.points(), *down, 0.01f);
  CHECK(once.back().along > once[once.size() - 2].along);
}
