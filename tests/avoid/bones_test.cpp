#include "avoid/bones.h"

#include <doctest/doctest.h>

#include "avoid/solver.h"
#include "collide/network_tubes.h"
#include "network/builder.h"
#include "support/meshes.h"
#include "support/networks.h"

using namespace vasa;

namespace {

// A bone of 40 x 20 x 40 mm that hangs on the only joint, and a vessel over it along x.
struct Setting {
  Body body;
  Network network;
};

Setting settingAt(float y) {
  Setting setting{{}, test::levelVessel(0.1f, y)};
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
  CHECK(solve(avoider, setting, 0.001f, mat4(1), points).bones.contacts == 0);
  for (const float lowered : {0.003f, 0.006f, 0.012f, 0.016f}) {
    CAPTURE(lowered);
    const AvoidReport report = solve(avoider, setting, lowered, mat4(1), points);
    CHECK(report.bones.contacts > 0);
    CHECK(report.bones.depth == doctest::Approx(std::min(lowered - 0.002f, 0.008f)).epsilon(0.15));
    CHECK(report.bonesAfter.contacts == 0);
    CHECK(lowestAbove(setting.network, points) > 0.0095f);
  }
}

TEST_CASE("a bone that moves takes its field along") {
  const Setting setting = settingAt(0.02f);
  Avoider avoider(setting.network, &setting.body);
  std::vector<vec4> points;
  const mat4 up = glm::translate(mat4(1), vec3(0, 0.012f, 0));
  CHECK(solve(avoider, setting, 0, mat4(1), points).bones.contacts == 0);
  const AvoidReport report = solve(avoider, setting, 0, up, points);
  CHECK(report.bones.contacts > 0);
  CHECK(report.bonesAfter.contacts == 0);
  CHECK(lowestAbove(setting.network, points) > 0.0215f);
}

TEST_CASE("a vessel that lies in a bone at rest may stay there") {
  const Setting setting = settingAt(0.009f);
  Avoider avoider(setting.network, &setting.body);
  std::vector<vec4> points;
  CHECK(solve(avoider, setting, 0, mat4(1), points).bones.contacts == 0);
  const AvoidReport deeper = solve(avoider, setting, 0.002f, mat4(1), points);
  CHECK(deeper.bones.contacts == 0);
  CHECK(deeper.bones.deeper > 0);
  CHECK(deeper.bonesAfter.deeper == 0);
}

TEST_CASE("a vessel that a bone's turning has passed belongs where the pose has it, not where it was at rest") {
  // Half a turn about z takes what was above the bone below it; the vessel stays above, a little in the bone.
  const Setting setting = settingAt(0.014f);
  Avoider avoider(setting.network, &setting.body);
  std::vector<vec4> points;
  const mat4 turned = glm::rotate(mat4(1), kPi, vec3(0, 0, 1));
  const AvoidReport report = solve(avoider, setting, 0.003f, turned, points);
  CHECK(report.bones.contacts > 0);
  CHECK(report.bonesAfter.contacts == 0);
  CHECK(lowestAbove(setting.network, points) > 0.0095f);
  CHECK(report.movedMax < 0.004f);
}

TEST_CASE("a vessel that is pushed into a bone from farther than its field reaches is held off it") {
  // A second vessel above comes down on the first, far enough to bury it.
  Setting setting = settingAt(0.024f);
  NetworkBuilder builder;
  std::vector<vec4> low, high;
  for (int k = 0; k < 20; ++k) {
    const float along = -0.1f + 0.2f * float(k) / 19;
    low.emplace_back(along, 0.024f, 0, 0.002f);
    high.emplace_back(0.0005f, 0.05f, along, 0.006f);
  }
  builder.addVessel({"low", "", VesselKind::artery}, low);
  builder.addVessel({"high", "", VesselKind::vein}, high);
  auto network = builder.build(1);
  REQUIRE(network.ok());
  setting.network = std::move(*network);
  std::vector<vec4> posed(setting.network.points().begin(), setting.network.points().end());
  for (std::size_t p = low.size(); p < posed.size(); ++p) posed[p].y = 0.021f;
  std::vector<vec4> points = posed;
  const std::vector<quat> rotations(posed.size(), quat(1, 0, 0, 0));
  const std::vector<mat4> joints{mat4(1)};
  Avoider avoider(setting.network, &setting.body);
  const AvoidReport report = avoider.run({posed, rotations, joints}, nullptr, points);
  CHECK(report.before.contacts > 0);
  CHECK(report.after.holds());
  CHECK(report.sidesChangedAfter == 0);
  CHECK(report.bonesAfter.contacts == 0);
}

TEST_CASE("a vessel that the bone's faces push against one another in comes out even so") {
  // Turned and tilted about a place of its own, from one face of the lower bone through another and past the upper one.
  Setting setting = settingAt(0.011f);
  setting.body.skeleton.joints.push_back({.name = "high", .parent = {0}});
  SkinnedMesh high = test::boxMesh("bones", {-0.015f, 0.016f, -0.03f}, {0.015f, 0.03f, 0.03f});
  for (SkinInfluence& influence : high.influences) influence.joints = {1, 0, 0, 0};
  setting.body.meshes = {test::boxMesh("bones", {-0.012f, -0.006f, -0.03f}, {0.012f, 0.006f, 0.03f}), high};
  Avoider avoider(setting.network, &setting.body);
  struct Through {
    float turn, tilt, lowered, aside;
  };
  for (const auto& [turn, tilt, lowered, aside] :
       {Through{-0.97f, 0.5672f, 0.0095f, 0.0053f}, Through{-0.9184f, 0.5774f, 0.0136f, 0.0023f}, Through{0.9932f, -0.54f, 0.015f, -0.0098f}}) {
    CAPTURE(turn);
    const mat4 turned = glm::rotate(glm::rotate(mat4(1), turn, vec3(0, 1, 0)), tilt, vec3(0, 0, 1));
    const mat4 move = glm::translate(mat4(1), vec3(0, 0.011f - lowered, aside)) * turned * glm::translate(mat4(1), vec3(0, -0.011f, 0));
    std::vector<vec4> posed;
    for (const vec4& p : setting.network.points()) posed.emplace_back(vec3(move * vec4(vec3(p), 1)), p.w);
    std::vector<vec4> points = posed;
    const std::vector<quat> rotations(posed.size(), glm::quat_cast(mat3(move)));
    const std::vector<mat4> joints{mat4(1), mat4(1)};
    const AvoidReport report = avoider.run({posed, rotations, joints}, nullptr, points);
    CHECK(report.bones.contacts > 0);
    CHECK(report.bonesAfter.contacts == 0);
  }
}

TEST_CASE("a vessel between two bones that leave it too little room gives way") {
  // 3 mm between two slabs for a vessel of 4 mm.
  Setting setting{{}, test::levelVessel(0.1f, 0.0022f)};
  setting.body.skeleton.joints.push_back({.name = "low"});
  setting.body.skeleton.joints.push_back({.name = "high", .parent = {0}});
  const SkinnedMesh low = test::boxMesh("bones", {-0.02f, -0.01f, -0.02f}, {0.02f, 0, 0.02f});
  SkinnedMesh high = test::boxMesh("bones", {-0.02f, 0.01f, -0.02f}, {0.02f, 0.02f, 0.02f});
  for (SkinInfluence& influence : high.influences) influence.joints = {1, 0, 0, 0};
  setting.body.meshes = {low, high};
  Avoider avoider(setting.network, &setting.body);
  const VolumeKeeper volume(setting.network);
  const std::vector<vec4> posed(setting.network.points().begin(), setting.network.points().end());
  std::vector<vec4> points = posed;
  const std::vector<quat> rotations(posed.size(), quat(1, 0, 0, 0));
  const std::vector<mat4> joints{mat4(1), glm::translate(mat4(1), vec3(0, -0.007f, 0))};
  const AvoidReport report = avoider.run({posed, rotations, joints}, &volume, points);
  CHECK(report.bones.contacts > 0);
  CHECK(report.bonesAfter.contacts == 0);
  CHECK(report.narrowSpans > 0);
  CHECK(report.leastLumen > 0.4f);
  CHECK(report.leastLumen < 0.85f);
}

TEST_CASE("what was seen in earlier poses changes nothing of what is found in a bone now") {
  // Steps small and large: near the bone, away from it, in it, and back; a thin vessel, one thicker than the field is wide,
  // and one that lies deeper in the bone at rest than that.
  for (const vec2 radiusAndHeight : {vec2(0.002f, 0.014f), vec2(0.012f, 0.025f), vec2(0.012f, 0.012f)}) {
    const Setting setting = settingAt(radiusAndHeight.y);
    const NetworkTubes layout(setting.network);
    std::vector<vec4> thick(setting.network.points().begin(), setting.network.points().end());
    for (vec4& p : thick) p.w = radiusAndHeight.x;
    std::vector<Bezier> rest(layout.count()), now(rest), later(rest);
    layout.shape(thick, rest);
    Bones kept(setting.body, rest);
    std::size_t found = 0;
    for (int step = 0; step < 60; ++step) {
      const float down = 0.011f * (1 - std::cos(0.21f * float(step))) + (step % 7 == 0 ? 0.004f : 0.0f);
      const std::vector<mat4> joints{glm::rotate(mat4(1), 0.02f * float(step % 11), vec3(0, 0, 1))};
      std::vector<vec4> points = thick;
      for (vec4& p : points) p.y -= down;
      layout.shape(points, now);
      Bones fresh(setting.body, rest);
      for (Bones* bones : {&kept, &fresh}) bones->pose(joints);
      const auto a = kept.contacts(now, {now, {}}), b = fresh.contacts(now, {now, {}});
      CAPTURE(step);
      REQUIRE(a.size() == b.size());
      for (std::size_t k = 0; k < a.size(); ++k) {
        CHECK(a[k].tube == b[k].tube);
        CHECK(a[k].s == b[k].s);
        CHECK(a[k].f == b[k].f);
        CHECK(a[k].normal == b[k].normal);
      }
      found += a.size();
      for (vec4& p : points) p.y -= 0.001f;
      layout.shape(points, later);
      const auto c = kept.contacts(later, {now, {}}, Bones::Which::nearAtLast), d = fresh.contacts(later, {now, {}});
      REQUIRE(c.size() == d.size());
      for (std::size_t k = 0; k < c.size(); ++k) CHECK(c[k].f == d[k].f);
    }
    CHECK(found > 20);
  }
}
