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

TEST_CASE("a vessel that is told with its twigs is as long as its stem, whatever pieces it is cut into") {
  const VesselKind artery = VesselKind::artery;
  const Network plain = networkOf({{{"splenic artery", "", artery}, straight({0, 0, 0}, {0.1f, 0, 0})}});
  NetworkBuilder builder;
  const VesselId first =
      builder.addVessel({"splenic artery", "", artery}, straight({0, 0, 0}, {0.06f, 0, 0}));
  const VesselId second =
      builder.addVessel({"splenic artery (2)", "", artery}, straight({0.06f, 0, 0}, {0.1f, 0, 0}));
  const VesselId twig =
      builder.addVessel({"splenic artery (3)", "", artery}, straight({0.03f, 0, 0}, {0.03f, 0.02f, 0}));
  builder.addVessel({"splenic artery (4)", "", artery}, straight({0.03f, 0.2f, 0}, {0.03f, 0.23f, 0}));
  builder.addNode(std::nullopt, {{first, true}, {second, false}});
  builder.addNode(Host{first, 0.5f * float(straight({0, 0, 0}, {1, 0, 0}).size() - 3)}, {{twig, false}});
  const auto told = builder.build(1);
  REQUIRE(told.ok());
  const auto all = compareVessels(plain, *told);
  REQUIRE(all.size() == 1);
  CHECK(all[0].lengthRatio() == doctest::Approx(1).epsilon(1e-3));
  CHECK(all[0].otherWhole == doctest::Approx(0.15).epsilon(1e-3));
  CHECK(all[0].otherDistance < 1e-5);
}

TEST_CASE("of courses that one network tells farther than the other the stretch is compared that both tell") {
  const auto all = compareVessels(
      networkOf({{{"carotid artery", "", VesselKind::artery}, straight({0, 0, 0}, {0, 0.12f, 0})}}),
      networkOf(
          {{{"carotid artery", "", VesselKind::artery}, straight({0.01f, 0.04f, 0}, {0.01f, 0.15f, 0})}}));
  REQUIRE(all.size() == 1);
  CHECK(all[0].lengthRatio() == doctest::Approx(12.0 / 11).epsilon(1e-3));
  CHECK(all[0].shared == doctest::Approx(0.08).epsilon(0.03));
  CHECK(all[0].sharedRatio() == doctest::Approx(1).epsilon(0.03));
}

TEST_CASE("several vessels with the id of a class are compared with what the other calls by it at once") {
  const VesselKind vein = VesselKind::vein;
  const Network ours =
      networkOf({{{"first lumbar vein", "FMA15370", vein}, straight({0, 0, 0}, {0.1f, 0, 0})},
                 {{"second lumbar vein", "FMA15370", vein}, straight({0, 0.1f, 0}, {0.1f, 0.1f, 0})}});
  const Network theirs =
      networkOf({{{"set of lumbar veins", "FMA15370", vein}, straight({0, 0, 0}, {0.1f, 0, 0})},
                 {{"set of lumbar veins (2)", "FMA15370", vein}, straight({0, 0.1f, 0}, {0.1f, 0.1f, 0})}});
  const auto all = compareVessels(ours, theirs);
  REQUIRE(all.size() == 1);
  CHECK(all[0].name == "first lumbar vein");
  CHECK(all[0].otherName == "set of lumbar veins");
  CHECK(all[0].whole == doctest::Approx(0.2));
  CHECK(all[0].distance < 1e-5);
  CHECK(all[0].otherDistance < 1e-5);
}

TEST_CASE("networks without common vessels compare to nothing") {
  const Network one = networkOf({{{"a", "", VesselKind::vein}, straight({0, 0, 0}, {0.1f, 0, 0})}});
  const Network two = networkOf({{{"b", "", VesselKind::vein}, straight({0, 0, 0}, {0.1f, 0, 0})}});
  CHECK(compareVessels(one, two).empty());
}
