#include "avoid/bones.h"

#include <doctest/doctest.h>

#include "avoid/solver.h"
#include "network/builder.h"
#include "support/meshes.h"

using namespace vasa;

namespace {

// A bone of 40 x 20 x 40 mm that hangs on the only joint, and a vessel over it along x.
struct Setting {
  Body body;
  Network network;
};

Network vesselAt(float y) {
  std::vector<vec4> points;
  for (int k = 0; k < 20; ++k) points.emplace_back(-0.1f + 0.2f * float(k) / 19, y, 0, 0.002f);
  NetworkBuilder builder;
  builder.addVessel({"vessel", "", VesselKind::artery}, points);
  auto network = builder.build(1);
  REQUIRE(network.ok());
  return std::move(*network);
}

Setting settingAt(float y) {
  Setting setting{{}, vesselAt(y)};
  setting.body.skeleton.joints.push_back({.name = "root"});
  setting.body.meshes.push_back(test::boxMesh("bones", {-0.02f, -0.01f, -0.02f}, {0.02f, 0.01f, 0.02f}));
  return setting;
}

AvoidReport solve(Avoider& avoider, const Setting& setting, float lowered, const mat4& joint, std::vector<vec4>& points) {
  std::vector<vec4> posed(setting.network.points().begin(), setting.network.points().end());
  for (vec4& p : posed) p.y -= lowered;
  points = posed;
  const std::vector<quat> rotations(posed.size(), quat(1, 0, 0, 0));
  const std::vector<mat4> joints{joint};
  return avoider.run({posed, rotations, joints}, nullptr, points);
}

float lowestAbove(const Network& network, std::span<const vec4> points) {
  float lowest = 1;
  for (float u = 0; u < float(network.sweepCount()); u += 0.05f) {
    const vec4 p = evaluate(points, u);
    if (std::abs(p.x) < 0.019f) lowest = std::min(lowest, p.y - p.w);
  }
  return lowest;
}

}  // namespace

TEST_CASE("a vessel pressed into a bone comes out on the side where it was") {
  const Setting setting = settingAt(0.014f);
  Avoider avoider(setting.network, &setting.body);
  std::vector<vec4> points;
  CHECK(solve(avoider, setting, 0.001f, mat4(1), points).boneContacts == 0);
  for (const float lowered : {0.003f, 0.006f, 0.012f, 0.016f}) {
    CAPTURE(lowered);
    const AvoidReport report = solve(avoider, setting, lowered, mat4(1), points);
    CHECK(report.boneContacts > 0);
    CHECK(report.boneDepth == doctest::Approx(std::min(lowered - 0.002f, 0.008f)).epsilon(0.15));
    CHECK(report.boneContactsAfter == 0);
    CHECK(lowestAbove(setting.network, points) > 0.0095f);
  }
}

TEST_CASE("a bone that moves takes its field along") {
  const Setting setting = settingAt(0.02f);
  Avoider avoider(setting.network, &setting.body);
  std::vector<vec4> points;
  const mat4 up = glm::translate(mat4(1), vec3(0, 0.012f, 0));
  CHECK(solve(avoider, setting, 0, mat4(1), points).boneContacts == 0);
  const AvoidReport report = solve(avoider, setting, 0, up, points);
  CHECK(report.boneContacts > 0);
  CHECK(report.boneContactsAfter == 0);
  CHECK(lowestAbove(setting.network, points) > 0.0215f);
}

TEST_CASE("a vessel that lies in a bone at rest may stay there") {
  const Setting setting = settingAt(0.009f);
  Avoider avoider(setting.network, &setting.body);
  std::vector<vec4> points;
  CHECK(solve(avoider, setting, 0, mat4(1), points).boneContacts == 0);
  CHECK(solve(avoider, setting, 0.002f, mat4(1), points).boneContacts > 0);
}
