#include "network/compare.h"

#include <doctest/doctest.h>

#include "network/sample_network.h"

using namespace vasa;

namespace {

Network networkOf(std::initializer_list<std::pair<NetworkBuilder::Label, std::vector<vec4>>> vessels) {
  NetworkBuilder builder;
  for (const auto& [label, points] : vessels) builder.addVessel(label, points);
  auto network = builder.build(1);
  REQUIRE(network.ok());
  return std::move(*network);
}

std::vector<vec4> straight(vec3 from, vec3 to) { return test::straightVessel(from, to, 0.002f, 4); }

}  // namespace

TEST_CASE("vessels of one name or one id are compared, others are not") {
  const VesselKind artery = VesselKind::artery;
  const Network ours =
      networkOf({{{"left renal artery", "FMA14753", artery}, straight({0, 0, 0}, {0.1f, 0, 0})},
                 {{"principal artery", "FMA1", artery}, straight({0, 0, 0}, {0, 0.1f, 0})},
                 {{"alone", "", artery}, straight({0, 0, 0}, {0, 0, 0.1f})}});
  const Network theirs =
      networkOf({{{"arteria princeps", "FMA1", artery}, straight({0, 0.2f, 0}, {0, 0.1f, 0})},
                 {{"left renal artery", "", artery}, straight({0, 0.003f, 0}, {0.1f, 0.003f, 0})},
                 {{"left renal artery (2)", "", artery}, straight({0.1f, 0.003f, 0}, {0.2f, 0.003f, 0})},
                 {{"other (left)", "", artery}, straight({0, 0, 0}, {0, 0, 0.1f})}});
  const auto all = compareVessels(ours, theirs);
  REQUIRE(all.size() == 2);
  CHECK(all[0].name == "left renal artery");
  CHECK(all[0].lengthRatio() == doctest::Approx(0.5));
  CHECK(all[0].distance == doctest::Approx(0.003));
  CHECK(all[0].otherDistance ==
        doctest::Approx(0.0265).epsilon(0.02));  // half of it lies 0 to 0.1 m beyond the end
  CHECK(all[0].apart() == all[0].distance);
  CHECK(all[1].name == "principal artery");
  CHECK(all[1].lengthRatio() == doctest::Approx(1));
  CHECK(all[1].distance == doctest::Approx(0.05));
}

TEST_CASE("networks without common vessels compare to nothing") {
  const Network one = networkOf({{{"a", "", VesselKind::vein}, straight({0, 0, 0}, {0.1f, 0, 0})}});
  const Network two = networkOf({{{"b", "", VesselKind::vein}, straight({0, 0, 0}, {0.1f, 0, 0})}});
  CHECK(compareVessels(one, two).empty());
}
