#include "viewer/way_profile.h"

#include <doctest/doctest.h>

#include "network/builder.h"

using namespace vasa;
using namespace vasa::viewer;

TEST_CASE("what is measured has a profile, while nothing is measured the chosen vessel") {
  NetworkBuilder builder;
  const auto straight = [](vec3 from, vec3 to) {
    std::vector<vec4> points;
    for (const float t : {0.0f, 1 / 6.0f, 0.5f, 5 / 6.0f, 1.0f})
      points.emplace_back(glm::mix(from, to, t), 0.01f);
    return points;
  };
  const VesselId trunk = builder.addVessel({"trunk"}, straight({0, 0, 0}, {0.3f, 0, 0}));
  const VesselId branch = builder.addVessel({"branch"}, straight({0.3f, 0, 0}, {0.3f, 0.4f, 0}));
  const VesselId apart = builder.addVessel({"apart"}, straight({0, 0, 1}, {1, 0, 1}));
  builder.joinEnds({{trunk, true}, {branch, false}});
  const Network network = *builder.build(1);
  ViewState state;
  CHECK_FALSE(profileOf(state, network, network.points()));
  state.selected = VesselPlace{branch, 1};
  const auto own = profileOf(state, network, network.points());
  REQUIRE(own);
  CHECK(own->title == "branch");
  CHECK(own->length() == doctest::Approx(0.4));
  state.measuring = true;
  CHECK_FALSE(profileOf(state, network, network.points()));
  state.from = VesselPlace{trunk, 0}, state.to = VesselPlace{branch, 2};
  const auto way = profileOf(state, network, network.points());
  REQUIRE(way);
  CHECK(way->title == "trunk to branch");
  CHECK(way->vessels == 2);
  CHECK(way->length() == doctest::Approx(0.7));
  CHECK(way->straight() == doctest::Approx(0.5));
  state.to = VesselPlace{apart, 1};
  CHECK_FALSE(profileOf(state, network, network.points()));
}
