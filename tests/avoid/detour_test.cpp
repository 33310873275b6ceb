#include "avoid/detour.h"

#include <algorithm>

#include <doctest/doctest.h>

#include "avoid/solver.h"
#include "avoid/way.h"
#include "network/builder.h"
#include "support/meshes.h"
#include "support/networks.h"

using namespace vasa;

namespace {

// A wall 6 mm thick, of four boxes around a hole; away from everything at rest.
Body wallWithHole(vec2 middle, float halfWidth) {
  Body body;
  body.skeleton.joints.push_back({.name = "root"});
  const float x = 0.003f, far = 0.06f;
  const auto box = [&](vec2 low, vec2 high) { body.meshes.push_back(test::boxMesh("bones", {-x, low.x, low.y}, {x, high.x, high.y})); };
  const vec2 low = middle - halfWidth, high = middle + halfWidth;
  box({-far, -far}, {low.x, far});
  box({high.x, -far}, {far, far});
  box({low.x, -far}, {high.x, low.y});
  box({low.x, high.y}, {high.x, far});
  return body;
}

struct Setting {
  explicit Setting(const Body& body) : network(test::levelVessel(0.1f, 0.2f)), interference(network), bones(body, interference.restTubes()) {
    const mat4 joint = glm::translate(mat4(1), vec3(0, 0.2f, 0));
    bones.pose(std::span(&joint, 1));
    interference.find(network.points());
  }
  Detour detour(float factor = 1) const {
    return findDetour(network, interference, bones, {{0}, 8.2f, 8.8f}, network.points(), factor);
  }
  float roomAt(vec3 place) const {
    float room = 1;
    for (std::uint32_t part = 0; part < bones.partCount(); ++part) room = std::min(room, bones.distance(part, place));
    return room;
  }
  std::vector<vec4> after(const Detour& detour) const {
    std::vector<vec4> points(network.points().begin(), network.points().end());
    for (std::size_t k = 0; k < detour.motions.size(); ++k) points[detour.firstPoint + k] += vec4(detour.motions[k], 0);
    return points;
  }
  Network network;
  Interference interference;
  Bones bones;
};

}  // namespace

TEST_CASE("a detour leads through a hole in a wall, as wide as asked for, and nothing else moves") {
  const Setting setting(wallWithHole({0.007f, 0.001f}, 0.005f));
  const Detour detour = setting.detour();
  REQUIRE(!detour.motions.empty());
  const std::vector<vec4> points = setting.after(detour);
  for (float u = 0; u <= float(setting.network.sweepCount()); u += 0.02f) {
    const vec4 p = evaluate(points, u);
    CHECK(setting.roomAt(vec3(p)) > 0.95f * p.w);
    if (u < 4 || u > 13) CHECK(glm::distance(vec3(p), vec3(evaluate(setting.network.points(), u))) < 1e-6f);
  }
  const Detour again = setting.detour();
  CHECK(again.motions == detour.motions);
}

TEST_CASE("there is no detour where no hole is wide enough, and one for a thinner vessel") {
  const Setting setting(wallWithHole({0.006f, 0}, 0.0017f));
  CHECK(setting.detour().motions.empty());
  const Detour thin = setting.detour(0.5f);
  REQUIRE(!thin.motions.empty());
  const std::vector<vec4> points = setting.after(thin);
  for (float u = 0; u <= float(setting.network.sweepCount()); u += 0.02f) CHECK(setting.roomAt(vec3(evaluate(points, u))) > 0.9e-3f);
}

TEST_CASE("other vessels are in the way of a detour") {
  NetworkBuilder builder;
  std::vector<vec4> level, across;
  for (int k = 0; k < 20; ++k) {
    const float along = -0.1f + 0.2f * float(k) / 19;
    level.emplace_back(along, 0, 0, 0.002f);
    across.emplace_back(0, 0.001f, along, 0.003f);
  }
  builder.addVessel({"level", "", VesselKind::artery}, std::move(level));
  builder.addVessel({"across", "", VesselKind::vein}, std::move(across));
  const Result<Network> network = builder.build(1.7f);
  REQUIRE(network.ok());
  Body none;
  none.skeleton.joints.push_back({.name = "root"});
  Interference interference(*network);
  const Bones bones(none, interference.restTubes());
  StretchLine line;
  for (int k = 0; k < 64; ++k) line.places.push_back({-0.03f + 0.06f * float(k) / 63, 0.02f, 0}), line.tubes.push_back(3);
  interference.find(network->points());
  const Room room(bones, interference, line, 0.03f, 0.1f);
  CHECK(room.at({0, 0.02f, 0}, 0.1f, 3) == doctest::Approx(0.016).epsilon(0.01));
  CHECK(room.at({0, 0.001f, 0}, 0.1f, 3) < 0);
  CHECK(glm::dot(room.slope({0, 0.01f, 0}, 0.1f, 3), vec3(0, 1, 0)) > 0.99f);
}

TEST_CASE("places along a way follow it in order, from end to end") {
  std::vector<vec3> way, line;
  for (int k = 0; k < 40; ++k) {
    const float t = float(k) / 39;
    way.push_back({t * t, 0.3f * std::sin(kPi * t), 0});
    line.push_back({t, 0, 0});
  }
  const std::vector<float> places = placesAlong(way, line);
  CHECK(places.front() == 0);
  CHECK(places.back() == 39);
  CHECK(std::is_sorted(places.begin(), places.end()));
  for (std::size_t k = 0; k < line.size(); ++k) CHECK(std::abs(way[std::size_t(places[k])].x - line[k].x) < 0.1f);
}

TEST_CASE("a vessel that two bones push against one another goes around them") {
  // Two plates that close over the vessel from both sides, deeper than it could be pushed back.
  Body body;
  body.skeleton.joints.push_back({.name = "root"});
  body.skeleton.joints.push_back({.name = "other", .parent = 0});
  body.meshes.push_back(test::boxMesh("bones", {-0.01f, 0.010f, -0.008f}, {0.01f, 0.024f, 0.009f}));
  body.meshes.push_back(test::boxMesh("bones", {-0.01f, -0.024f, -0.008f}, {0.01f, -0.010f, 0.009f}));
  for (SkinInfluence& influence : body.meshes[1].influences) influence.joints[0] = 1;
  const Network network = test::levelVessel(0.1f, 0.0f);
  Avoider avoider(network, &body);
  std::vector<vec4> points(network.points().begin(), network.points().end());
  const std::vector<vec4> posed = points;
  const std::vector<quat> rotations(points.size(), quat(1, 0, 0, 0));
  const std::vector<mat4> joints{glm::translate(mat4(1), vec3(0, -0.012f, 0)), glm::translate(mat4(1), vec3(0, 0.012f, 0))};
  const AvoidReport report = avoider.run({posed, rotations, joints}, nullptr, points);
  CHECK(report.bones.contacts > 0);
  CHECK(report.bonesAfter.contacts == 0);
  CHECK(report.after.holds());
}
