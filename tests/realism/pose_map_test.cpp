#include "realism/pose_map.h"

#include <algorithm>
#include <array>

#include "realism/two_legs.h"

using namespace vasa;

namespace {

JointRange knee(const char* side, float degrees) {
  return {std::string(side) + " knee flexion", std::string(side) + "LowerLeg", JointRange::Motion::flexion, 0,
          glm::radians(degrees)};
}

constexpr LoadLimits kTight{.strain = 0.1f};  // 3 cm behind the axis 90 degrees take 47 of 300 mm

}  // namespace

TEST_CASE("ways outwards: both ends that are not rest, and of a pair one a held angle") {
  JointRange turn{"neck turn", "neck", JointRange::Motion::twist, -0.6f, 0.6f};
  const auto single = singleRays(std::array{turn, knee("left", 90)});
  REQUIRE(single.size() == 3);
  CHECK(single[0].name() == "neck turn to -34");
  CHECK(single[2].name() == "left knee flexion to 90");
  const auto pairs = pairedRays(turn, knee("left", 90), 0.3f);
  REQUIRE(pairs.size() == 5);
  CHECK(pairs.front().held->angle == doctest::Approx(-0.6f));
  CHECK(pairs[2].held->angle == 0);
  CHECK(pairs[1].name() == "left knee flexion to 90, neck turn -17");
}

TEST_CASE("a bent knee shortens what runs behind it on that side, from some angle on, the more the more") {
  const Scene scene = test::twoLegs();
  PoseMap map(scene, {}, kTight, glm::radians(15.0f));
  const auto report = map.walk({knee("left", 90), true, {}});
  REQUIRE_MESSAGE(report.ok(), report.error().message);
  REQUIRE(report->steps.size() == 7);
  CHECK(report->steps.front().severity < 0.1f);
  for (std::size_t i = 1; i < report->steps.size(); ++i)
    CHECK(report->steps[i].severity >= 0.99f * report->steps[i - 1].severity);
  for (const PoseFinding& finding : report->findings)
    CHECK(scene.network.vessel(finding.vessel).name.starts_with("left"));
  const auto found = std::ranges::find(report->findings, LoadKind::shortening, &PoseFinding::kind);
  REQUIRE(found != report->findings.end());
  const PoseFinding& worst = *found;
  CHECK(worst.value < -10);
  CHECK(worst.from > 0);
  CHECK(worst.from <= worst.angle);
  CHECK(worst.severity == doctest::Approx(-worst.value / 10).epsilon(1e-3));
  CHECK(report->strains[worst.vessel.value] == doctest::Approx(worst.value / 100).epsilon(1e-3));
}

TEST_CASE("what was walked before counts for nothing, and a held joint adds its own") {
  const Scene scene = test::twoLegs();
  const PoseRay ray{knee("left", 60), true, {}};
  PoseMap fresh(scene, {}, kTight, glm::radians(20.0f)), used(scene, {}, kTight, glm::radians(20.0f));
  const PoseRay both{knee("left", 60), true, PoseRay::Held{knee("right", 80), glm::radians(80.0f)}};
  const auto paired = used.walk(both);
  REQUIRE(paired.ok());
  CHECK(scene.network.vessel(paired->steps.front().vessel).name.starts_with("right"));
  const auto a = fresh.walk(ray), b = used.walk(ray);
  REQUIRE((a.ok() && b.ok()));
  CHECK(a->strains == b->strains);
}

TEST_CASE("a skeleton without the joint is told so") {
  const Scene scene = test::twoLegs();
  PoseMap map(scene, {});
  const auto report =
      map.walk({{"left wrist flexion", "leftHand", JointRange::Motion::flexion, 0, 1}, true, {}});
  REQUIRE_FALSE(report.ok());
  CHECK(report.error().message.find("leftHand") != std::string::npos);
}
