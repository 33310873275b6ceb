#include "network/builder.h"

#include <doctest/doctest.h>

#include <limits>

#include "network/sample_network.h"

using namespace vasa;
using test::sampleBuilder;
using test::straightVessel;

namespace {

std::string messageOf(const NetworkBuilder& builder) {
  const auto network = builder.build(1.75f);
  REQUIRE(!network.ok());
  CHECK(network.error().fault == Fault::badInput);
  return network.error().message;
}

}  // namespace

TEST_CASE("a small tree is built and counted") {
  const auto network = sampleBuilder().build(1.75f);
  REQUIRE(network.ok());
  CHECK(network->vessels().size() == 5);
  CHECK(network->sweepCount() == 17);
  CHECK(network->sectionCount() == 22);
  CHECK(network->junctionCount() == 2);
  CHECK(network->componentCount() == 2);
  CHECK(network->components() == std::vector<std::uint32_t>{0, 0, 0, 0, 1});
  CHECK(network->node(network->vessel({1}).start).valence() == 3);
  CHECK(!network->vessel({1}).end.valid());
}

TEST_CASE("ends are moved exactly onto their nodes, and follow when the network moves") {
  NetworkBuilder builder = sampleBuilder();
  const auto network = builder.build(1.75f);
  REQUIRE(network.ok());
  std::vector<vec4> points(network->points().begin(), network->points().end());
  for (std::size_t i = 0; i < points.size(); ++i)
    points[i] += vec4(0.01f * std::sin(float(i)), 0, 0.02f * std::cos(float(3 * i)), 0);
  pinEnds(*network, points);
  const auto of = [&](std::uint32_t v) { return Network::pointsOf(network->vessel({v}), points); };
  CHECK(vec3(of(1).front()) == vec3(evaluate(of(0), 2.5f)));
  CHECK(vec3(of(2).front()) == vec3(of(0).back()));
  CHECK(vec3(of(3).front()) == vec3(of(0).back()));
}

TEST_CASE("a chain of side branches is pinned from the trunk outwards, whatever the order of building") {
  NetworkBuilder builder;
  const VesselId twig = builder.addVessel({"twig"}, straightVessel({1, 1, 0}, {1, 2, 0}, 0.1f, 1));
  const VesselId branch = builder.addVessel({"branch"}, straightVessel({0, 1, 0}, {2, 1, 0}, 0.1f, 1));
  const VesselId trunk = builder.addVessel({"trunk"}, straightVessel({0, 0, 0}, {0, 2, 0}, 0.1f, 1));
  builder.joinToSide({twig, false}, {branch, 0.5f});
  builder.joinToSide({branch, false}, {trunk, 0.5f});
  const auto network = builder.build(2);
  REQUIRE(network.ok());
  std::vector<vec4> points(network->points().begin(), network->points().end());
  for (vec4& p : Network::pointsOf(network->vessel(trunk), std::span(points))) p.z += 0.05f;
  pinEnds(*network, points);
  CHECK(Network::pointsOf(network->vessel(branch), points).front().z == doctest::Approx(0.05f));
  CHECK(Network::pointsOf(network->vessel(twig), points).front().z > 0);
}

TEST_CASE("what cannot be a network is refused by name and cause") {
  NetworkBuilder builder;
  SUBCASE("too few points") {
    builder.addVessel({"stub"}, std::vector<vec4>(3, vec4(0, 0, 0, 1)));
    CHECK(messageOf(builder) == "vessel 0 'stub' has 3 control points; a cubic needs at least 4");
  }
  SUBCASE("radius") {
    auto points = straightVessel({0, 0, 0}, {0, 1, 0}, 0.01f, 1);
    points[2].w = -0.2f;
    builder.addVessel({"aorta"}, points);
    CHECK(messageOf(builder) == "vessel 0 'aorta': point 2: radius -0.200000 must be positive");
  }
  SUBCASE("not finite") {
    auto points = straightVessel({0, 0, 0}, {0, 1, 0}, 0.01f, 1);
    points[1].x = std::numeric_limits<float>::quiet_NaN();
    builder.addVessel({"aorta"}, points);
    CHECK(messageOf(builder) == "vessel 0 'aorta': point 1 is not finite");
  }
  SUBCASE("so far off that numbers tell no parts of a millimetre") {
    builder.addVessel({"aorta"}, straightVessel({9e5f, 0, 0}, {9e5f, 1, 0}, 0.01f, 1));
    CHECK(messageOf(builder).starts_with("vessel 0 'aorta': point 0 lies more than 1 km from the origin"));
  }
  SUBCASE("no length") {
    builder.addVessel({"dot"}, std::vector<vec4>(5, vec4(1, 1, 1, 1)));
    CHECK(messageOf(builder) == "vessel 0 'dot' has no length");
  }
  SUBCASE("an end in two nodes") {
    builder = sampleBuilder();
    builder.joinEnds({{{1}, false}, {{4}, false}});
    CHECK(messageOf(builder).find("belongs to node 0 already") != std::string::npos);
  }
  SUBCASE("host parameter") {
    builder = sampleBuilder();
    builder.joinToSide({{4}, false}, {{0}, 5.5f});
    CHECK(messageOf(builder).find("lies outside vessel 0 'trunk'") != std::string::npos);
  }
  SUBCASE("hangs on itself") {
    builder = sampleBuilder();
    builder.joinToSide({{4}, false}, {{4}, 1.0f});
    CHECK(messageOf(builder).find("would hang on itself") != std::string::npos);
  }
  SUBCASE("far from its node") {
    builder = sampleBuilder();
    builder.joinToSide({{4}, false}, {{0}, 3.0f});
    CHECK(messageOf(builder).find("more than 5 % of the body height") != std::string::npos);
  }
  SUBCASE("unknown vessel") {
    builder = sampleBuilder();
    builder.joinEnds({{{17}, false}, {{4}, false}});
    CHECK(messageOf(builder).find("vessel 17 does not exist") != std::string::npos);
  }
  SUBCASE("a lone end") {
    builder = sampleBuilder();
    builder.joinEnds({{{4}, false}});
    CHECK(messageOf(builder).find("joins nothing") != std::string::npos);
  }
  SUBCASE("a circle of hosts") {
    const VesselId a = builder.addVessel({"a"}, straightVessel({0, 0, 0}, {0.1f, 0, 0}, 0.01f, 1));
    const VesselId b = builder.addVessel({"b"}, straightVessel({0, 0, 0}, {0.1f, 0, 0}, 0.01f, 1));
    builder.joinToSide({a, false}, {b, 0.0f});
    builder.joinToSide({b, false}, {a, 0.0f});
    CHECK(messageOf(builder).find("hang on one another in a circle") != std::string::npos);
  }
  SUBCASE("too many in one place") {
    enum class Joined { atTheirEnds, atOnePlace, withinARadius };
    const auto star = [](std::size_t rays, Joined joined) {
      NetworkBuilder made;
      const VesselId host = made.addVessel({"host"}, straightVessel({0, -1, 0}, {0, 1, 0}, 0.01f, 2));
      std::vector<VesselEnd> ends;
      for (std::size_t i = 0; i < rays; ++i) {
        ends.push_back({made.addVessel({"ray"}, straightVessel({0, 0, 0}, {1, 1, 0}, 0.01f, 1)), false});
        // A span is a metre long, so that all of them lie within 9 mm.
        const float aside = joined == Joined::withinARadius ? 0.009f * float(i) / float(rays) : 0;
        if (joined != Joined::atTheirEnds) made.addNode(Host{host, 1 - aside}, {ends.back()});
      }
      if (joined == Joined::atTheirEnds) made.addNode(std::nullopt, ends);
      return made;
    };
    for (const Joined joined : {Joined::atTheirEnds, Joined::atOnePlace, Joined::withinARadius}) {
      builder = star(kMostEndsAtNode + 1, joined);
      const std::string message = messageOf(builder);
      CHECK(message.find("more than 256 vessels would meet ") != std::string::npos);
      CHECK(message.find(joined == Joined::atTheirEnds
                             ? "in one place"
                             : "within a radius of vessel 0 'host'") != std::string::npos);
      CHECK(message.find(", among them vessel ") != std::string::npos);
      CHECK(star(kMostEndsAtNode, joined).build(1.75f).ok());
    }
  }
  SUBCASE("many on one vessel, apart from one another") {
    builder = NetworkBuilder();
    const VesselId host = builder.addVessel({"host"}, straightVessel({0, -1, 0}, {0, 1, 0}, 0.001f, 2));
    for (std::size_t i = 0; i < 4 * kMostEndsAtNode; ++i) {
      const float at = 2 * float(i) / float(4 * kMostEndsAtNode);
      const VesselId tooth =
          builder.addVessel({"tooth"}, straightVessel({0, at - 1, 0}, {1, at - 1, 0}, 0.001f, 1));
      builder.joinToSide({tooth, false}, {host, at});
    }
    CHECK(builder.build(1.75f).ok());
    return;
  }
  SUBCASE("body height") { CHECK(!builder.build(0).ok()); }
}
