#include "body/phases.h"

#include <doctest/doctest.h>

#include "body/chain.h"

using namespace vasa;
using namespace vasa::test;

TEST_CASE("a step in a phase along a vessel becomes a ramp, and what is flat stays") {
  const Body body = chainBody({{0, 0, 0}, {0, 1, 0}, {0, 2, 0}});
  Result<SpineSet> spines = deriveSpines(body.skeleton, body.name);
  REQUIRE(spines);
  spines->joints[1].arc = 0.5f;
  constexpr std::uint32_t kCount = 21;
  std::vector<vec4> points;
  std::vector<Tie> ties;
  for (std::uint32_t i = 0; i < kCount; ++i) {
    points.emplace_back(0, 0.05f * float(i), 0, 0.001f);
    if (i) ties.push_back({i - 1, i});
  }
  Phases phases{kCount, std::vector<float>(3 * kCount, 1.0f), std::vector<float>(3 * kCount, 1.0f),
                std::vector<float>(3 * kCount, 1.0f)};
  for (std::uint32_t i = 0; i < kCount / 2; ++i) phases.bend[phases.at(1, i)] = 0;
  limitSlopes(phases, *spines, points, ties);

  const float steepest = 1.5f * 1.25f / 0.5f * 0.05f;
  for (std::uint32_t i = 1; i < kCount; ++i) {
    const float change = phases.bend[phases.at(1, i)] - phases.bend[phases.at(1, i - 1)];
    CHECK(change >= 0);
    CHECK(change <= steepest + 1e-5f);
  }
  CHECK(phases.bend[phases.at(1, 0)] == 0);
  CHECK(phases.bend[phases.at(1, kCount - 1)] == 1);
  for (std::uint32_t i = 0; i < kCount; ++i) {
    CHECK(phases.bend[phases.at(0, i)] == 1);
    CHECK(phases.twist[phases.at(1, i)] == 1);
  }
}

TEST_CASE("a joint has set in behind it and not before it") {
  const Body body = chainBody({{0, 0, 0}, {0, 1, 0}, {0, 2, 0}});
  Result<SpineSet> spines = deriveSpines(body.skeleton, body.name);
  REQUIRE(spines);
  for (SpineJoint& joint : spines->joints) joint.arc = 0.2f;
  const BoneField bones(body, *spines);
  const std::vector<vec4> points{{0.05f, 0.5f, 0, 1}, {0.05f, 1, 0, 1}, {0.05f, 1.5f, 0, 1}};
  const Phases phases = measurePhases(*spines, bones, points);
  CHECK(phases.bend[phases.at(1, 0)] == 0);
  CHECK(phases.bend[phases.at(1, 1)] == doctest::Approx(0.5));
  CHECK(phases.bend[phases.at(1, 2)] == 1);
  CHECK(phases.nearness[phases.at(0, 1)] == 1);
}
