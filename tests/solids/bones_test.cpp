#include "solids/bones.h"

#include <doctest/doctest.h>

#include <algorithm>

#include "collide/network_tubes.h"
#include "network/builder.h"
#include "support/meshes.h"
#include "support/networks.h"
#include "support/walk.h"

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

test::Posed lowered(const Setting& setting, float by, const mat4& joint = mat4(1)) {
  test::Posed posed = test::atRest(setting.network);
  for (vec4& p : posed.points) p.y -= by;
  posed.joints = {joint};
  return posed;
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
  test::Walker walker(avoider, lowered(setting, 0));
  CHECK(walker.to(lowered(setting, 0.001f)).movedMax == 0);
  walker.seen = [&](const AvoidReport& report) {
    CHECK(report.bonesAfter.contacts == 0);
    CHECK(lowestAbove(setting.network, walker.points()) > 0.0095f);
  };
  for (const float by : {0.003f, 0.006f, 0.012f, 0.016f, 0.03f, 0.04f}) {  // in the end all the way through
    CAPTURE(by);
    const test::Posed posed = lowered(setting, by);
    walker.to(posed);
    const BoneReport before = avoider.look(posed, posed.points).bones;
    CHECK((before.contacts > 0) == (by < 0.026f));
    if (by < 0.012f) CHECK(std::abs(before.depth - (by - 0.002f)) < 0.0005f);
  }
}

TEST_CASE("a bone that moves takes its field along") {
  const Setting setting = settingAt(0.02f);
  Avoider avoider(setting.network, &setting.body);
  const test::Posed up = lowered(setting, 0, glm::translate(mat4(1), vec3(0, 0.012f, 0)));
  test::Walker walker(avoider, lowered(setting, 0));
  CHECK(walker.stay(1).movedMax == 0);
  const AvoidReport report = walker.to(up);
  CHECK(avoider.look(up, up.points).bones.contacts > 0);
  CHECK(report.bonesAfter.contacts == 0);
  CHECK(lowestAbove(setting.network, walker.points()) > 0.0215f);
}

TEST_CASE("a vessel that lies in a bone at rest may stay there") {
  const Setting setting = settingAt(0.011f);
  Avoider avoider(setting.network, &setting.body);
  test::Walker walker(avoider, lowered(setting, 0));
  CHECK(walker.stay(1).movedMax == 0);
  const test::Posed posed = lowered(setting, 0.002f);
  const AvoidReport report = walker.to(posed);
  const BoneReport before = avoider.look(posed, posed.points).bones;
  CHECK(before.contacts == 0);
  CHECK(before.deeper > 0);
  CHECK(report.bonesAfter.deeper == 0);
}

TEST_CASE("a vessel whose axis lies in a bone at rest is not held out of that bone") {
  const Setting setting = settingAt(0.009f);
  Avoider avoider(setting.network, &setting.body);
  test::Walker walker(avoider, lowered(setting, 0));
  const test::Posed posed = lowered(setting, 0.002f);
  CHECK(walker.to(posed).movedMax == 0);
  CHECK(avoider.look(posed, posed.points).bones.deeper == 0);
  CHECK(avoider.restBoneContactCount() > 0);
}

TEST_CASE("a bone that turns over under a vessel lifts it and lets it down again") {
  // Half a turn about z takes what was above the bone below it; the vessel stays above, a little in the bone.
  const Setting setting = settingAt(0.014f);
  Avoider avoider(setting.network, &setting.body);
  const test::Posed rest = lowered(setting, 0);
  test::Walker walker(avoider, rest);
  float highest = 0;
  walker.seen = [&](const AvoidReport& report) {
    CHECK(report.bonesAfter.contacts == 0);
    highest = std::max(highest, report.movedMax);
  };
  walker.along(
      [&](float share) {
        return lowered(setting, 0.003f * share, glm::rotate(mat4(1), kPi * share, vec3(0, 0, 1)));
      },
      60, 2);
  CHECK(highest > 0.008f);
  const AvoidReport report = walker.stay(60);
  CHECK(lowestAbove(setting.network, walker.points()) > 0.0095f);
  CHECK(report.movedMax < 0.004f);
  // It does not creep along the bone's edges either, however long all stands still.
  walker.stay(240);
  const std::vector<vec4> there(walker.points().begin(), walker.points().end());
  walker.stay(300);
  for (std::size_t p = 0; p < there.size(); ++p)
    CHECK(glm::distance(vec3(there[p]), vec3(walker.points()[p])) < 1e-4f);
}

TEST_CASE("shorter steps of a bone change corrections the less, and lead to about the same place") {
  const Setting setting = settingAt(0.014f);
  const auto go = [&](unsigned steps) {
    Avoider avoider(setting.network, &setting.body);
    test::Walker walker(avoider, lowered(setting, 0));
    walker.seen = [&](const AvoidReport& report) { CHECK(report.bonesAfter.contacts == 0); };
    return test::wayOf(
        walker, [&](float share) { return lowered(setting, 0, glm::rotate(mat4(1), share, vec3(0, 0, 1))); },
        steps);
  };
  // Apart by its radius: how far a vessel slides over the corner of a box depends on the way.
  test::checkShorterSteps(go, 0.002f, 0.4f);
}

TEST_CASE("a vessel that another one pushes towards a bone is held off it") {
  // The second vessel comes down on the first, far enough to bury it.
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
  test::Posed posed = lowered(setting, 0);
  for (std::size_t p = low.size(); p < posed.points.size(); ++p) posed.points[p].y = 0.021f;
  Avoider avoider(setting.network, &setting.body);
  test::Walker walker(avoider, lowered(setting, 0));
  walker.seen = [&](const AvoidReport& report) {
    CHECK(report.after.holds());
    CHECK(report.bonesAfter.contacts == 0);
  };
  walker.to(posed);
  CHECK(avoider.look(posed, posed.points).vessels.contacts > 0);
  CHECK(test::changedSides(setting.network, posed, walker.points()) == 0);
}

TEST_CASE("a vessel that is turned through two bones stays between them") {
  // Turned and tilted about a place of its own, from one face of the lower bone through another and past the
  // upper one.
  Setting setting = settingAt(0.011f);
  setting.body.skeleton.joints.push_back({.name = "high", .parent = {0}});
  SkinnedMesh high = test::boxMesh("bones", {-0.015f, 0.016f, -0.03f}, {0.015f, 0.03f, 0.03f});
  for (SkinInfluence& influence : high.influences) influence.joints = {1, 0, 0, 0};
  setting.body.meshes = {test::boxMesh("bones", {-0.012f, -0.006f, -0.03f}, {0.012f, 0.006f, 0.03f}), high};
  Avoider avoider(setting.network, &setting.body);
  const test::Posed rest = test::atRest(setting.network, 2);
  struct Through {
    float turn, tilt, lowered, aside;
  };
  for (const Through& through :
       {Through{-0.97f, 0.5672f, 0.0095f, 0.0053f}, Through{-0.9184f, 0.5774f, 0.0136f, 0.0023f},
        Through{0.9932f, -0.54f, 0.015f, -0.0098f}}) {
    CAPTURE(through.turn);
    const auto posedAt = [&](float share) {
      const auto& [turn, tilt, lowered, aside] = through;
      const mat4 turned =
          glm::rotate(glm::rotate(mat4(1), share * turn, vec3(0, 1, 0)), share * tilt, vec3(0, 0, 1));
      const mat4 move = glm::translate(mat4(1), vec3(0, 0.011f - share * lowered, share * aside)) * turned *
                        glm::translate(mat4(1), vec3(0, -0.011f, 0));
      test::Posed posed = rest;
      for (vec4& p : posed.points) p = vec4(vec3(move * vec4(vec3(p), 1)), p.w);
      std::ranges::fill(posed.rotations, glm::quat_cast(mat3(move)));
      return posed;
    };
    test::Walker walker(avoider, rest);
    walker.seen = [](const AvoidReport& report) { CHECK(report.bonesAfter.contacts == 0); };
    walker.along(posedAt, 60, 2);
    CHECK(avoider.look(posedAt(1), posedAt(1).points).bones.contacts > 0);
  }
}

TEST_CASE("a vessel on which two bones close gives way, and widens again when they open") {
  // 10 mm between two slabs go down to 3 mm for a vessel of 4 mm.
  Setting setting{{}, test::levelVessel(0.1f, 0.0022f)};
  setting.body.skeleton.joints.push_back({.name = "low"});
  setting.body.skeleton.joints.push_back({.name = "high", .parent = {0}});
  const SkinnedMesh low = test::boxMesh("bones", {-0.02f, -0.01f, -0.02f}, {0.02f, 0, 0.02f});
  SkinnedMesh high = test::boxMesh("bones", {-0.02f, 0.01f, -0.02f}, {0.02f, 0.02f, 0.02f});
  for (SkinInfluence& influence : high.influences) influence.joints = {1, 0, 0, 0};
  setting.body.meshes = {low, high};
  Avoider avoider(setting.network, &setting.body);
  const VolumeKeeper volume(setting.network);
  const test::Posed open = test::atRest(setting.network, 2);
  test::Posed closed = open;
  closed.joints[1] = glm::translate(mat4(1), vec3(0, -0.007f, 0));
  test::Walker walker(avoider, open, &volume);
  float lumen = 1;
  walker.seen = [&](const AvoidReport& report) {
    CHECK(report.after.holds());
    CHECK(report.bonesAfter.contacts == 0);
    CHECK(std::abs(report.leastLumen - lumen) <
          0.5f);  // the gap closes by 1 mm a step, a quarter of the vessel
    lumen = report.leastLumen;
    CHECK(walker.correctionStep() < 0.0015f);
  };
  const AvoidReport narrow = walker.to(closed);
  CHECK(avoider.look(closed, closed.points).bones.contacts > 0);
  CHECK(narrow.narrowSpans > 0);
  CHECK(narrow.leastLumen > 0.4f);
  CHECK(narrow.leastLumen < 0.85f);
  const AvoidReport held = walker.stay(30);
  CHECK(held.leastLumen > 0.4f);
  CHECK(held.leastLumen < 0.85f);
  walker.to(open);
  const AvoidReport wide = walker.stay(360);
  CHECK(wide.narrowSpans == 0);
  CHECK(wide.leastLumen == 1);
  CHECK(wide.movedMax < 1e-6f);
}

TEST_CASE("where bones leave a vessel no room at all, it keeps its least lumen and that is told") {
  Setting setting{{}, test::levelVessel(0.1f, 0.005f)};
  setting.body.skeleton.joints.push_back({.name = "low"});
  setting.body.skeleton.joints.push_back({.name = "high", .parent = {0}});
  SkinnedMesh high = test::boxMesh("bones", {-0.02f, 0.01f, -0.02f}, {0.02f, 0.02f, 0.02f});
  for (SkinInfluence& influence : high.influences) influence.joints = {1, 0, 0, 0};
  setting.body.meshes = {test::boxMesh("bones", {-0.02f, -0.01f, -0.02f}, {0.02f, 0, 0.02f}), high};
  Avoider avoider(setting.network, &setting.body);
  const test::Posed open = test::atRest(setting.network, 2);
  test::Posed closed = open;
  closed.joints[1] = glm::translate(mat4(1), vec3(0, -0.0095f, 0));
  test::Walker walker(avoider, open);
  const AvoidReport report = walker.to(closed);
  CHECK(report.bonesAfter.contacts > 0);
  CHECK_FALSE(avoider.inBones().empty());
  CHECK(report.leastLumen >= kLeastLumen - 1e-6f);
  for (const vec4& p : walker.points()) CHECK((glm::length(vec3(p)) < 0.2f && p.w > 0));
  walker.to(open);
  CHECK(walker.stay(360).movedMax < 1e-6f);
}

TEST_CASE("what was seen in earlier poses changes nothing of what is found in a bone now") {
  // Steps small and large: near the bone, away from it, in it, and back; a thin vessel, one thicker than the
  // field is wide, and one that lies deeper in the bone at rest than that.
  for (const vec2 radiusAndHeight : {vec2(0.002f, 0.014f), vec2(0.012f, 0.025f), vec2(0.012f, 0.012f)}) {
    const Setting setting = settingAt(radiusAndHeight.y);
    const NetworkTubes layout(setting.network);
    std::vector<vec4> thick(setting.network.points().begin(), setting.network.points().end());
    for (vec4& p : thick) p.w = radiusAndHeight.x;
    std::vector<Bezier> rest(layout.count()), now(rest), later(rest), latest(rest);
    layout.shape(thick, rest);
    Bones kept(setting.body, rest);
    std::size_t found = 0, stayed = 0;
    for (int step = 0; step < 60; ++step) {
      const float down = 0.011f * (1 - std::cos(0.21f * float(step))) + (step % 7 == 0 ? 0.004f : 0.0f);
      const std::vector<mat4> joints{glm::rotate(mat4(1), 0.02f * float(step % 11), vec3(0, 0, 1))};
      std::vector<vec4> points = thick;
      for (vec4& p : points) p.y -= down;
      layout.shape(points, now);
      Bones fresh(setting.body, rest);
      for (Bones* bones : {&kept, &fresh}) bones->pose(joints);
      const auto a = kept.contacts(now, now), b = fresh.contacts(now, now);
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
      const auto c = kept.contacts(later, now, Bones::Which::nearAtLast), d = fresh.contacts(later, now);
      REQUIRE(c.size() == d.size());
      for (std::size_t k = 0; k < c.size(); ++k) CHECK(c[k].f == d[k].f);
      // Half of it moves once more; the rest is told to have stayed.
      for (std::size_t p = points.size() / 2; p < points.size(); ++p) points[p].y -= 0.0005f;
      layout.shape(points, latest);
      std::vector<char> moved;
      for (std::size_t t = 0; t < latest.size(); ++t) moved.push_back(latest[t].b != later[t].b);
      const auto e = kept.contacts(latest, now, Bones::Which::nearAtLast, {}, moved),
                 f = fresh.contacts(latest, now);
      REQUIRE(e.size() == f.size());
      for (std::size_t k = 0; k < e.size(); ++k) {
        CHECK(e[k].tube == f[k].tube);
        CHECK(e[k].f == f[k].f);
        CHECK(e[k].normal == f[k].normal);
        CHECK(e[k].point == f[k].point);
        stayed += moved[e[k].tube] == 0;
      }
    }
    CHECK(stayed > 20);
    CHECK(found > 20);
  }
}
