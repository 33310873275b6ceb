#include "avoid/skin_wall.h"

#include <doctest/doctest.h>

#include "avoid/solver.h"
#include "support/meshes.h"
#include "support/networks.h"

using namespace vasa;

namespace {

// A closed box as tall as a body for a skin, half on each of two joints as no bone is, and a vessel below its lid along x.
Body boxedBody() {
  Body body;
  body.skeleton.joints.push_back({.name = "root"});
  body.skeleton.joints.push_back({.name = "next", .parent = {0}});
  body.meshes.push_back(test::boxMesh("skin", {-0.05f, -1.65f, -0.05f}, vec3(0.05f)));
  for (SkinInfluence& influence : body.meshes[0].influences) influence = {{0, 1, 0, 0}, {0.5f, 0.5f, 0, 0}};
  return body;
}

AvoidReport solve(const Network& network, bool wall, float raised, std::vector<vec4>& points) {
  const Body body = boxedBody();
  Avoider avoider(network, &body, {.skinWall = wall});
  std::vector<vec4> posed(network.points().begin(), network.points().end());
  for (vec4& p : posed) p.y += raised * std::max(0.0f, 1 - std::abs(p.x) / 0.03f);  // a bow, so that the ends stay below
  points = posed;
  const std::vector<quat> rotations(posed.size(), quat(1, 0, 0, 0));
  const std::vector<mat4> joints(2, mat4(1));
  return avoider.run({posed, rotations, joints}, nullptr, points);
}

float highest(std::span<const vec4> points) {
  float top = -1;
  for (float u = 0; u <= float(points.size() - 3); u += 0.05f) top = std::max(top, evaluate(points, u).y);
  return top;
}

}  // namespace

TEST_CASE("a vessel that a pose pushes through the skin is held below it, if that is asked for") {
  const Network network = test::levelVessel(0.045f, 0.046f);
  std::vector<vec4> points;
  const AvoidReport without = solve(network, false, 0.008f, points);
  CHECK(without.skinContacts == 0);
  CHECK(highest(points) > 0.051f);
  const AvoidReport held = solve(network, true, 0.008f, points);
  CHECK(held.skinContacts > 0);
  CHECK(held.skinContactsAfter == 0);
  CHECK(highest(points) < 0.0485f);
}

TEST_CASE("a vessel that was through the skin at rest may stay as far out as it was") {
  const Network network = test::levelVessel(0.045f, 0.051f);
  std::vector<vec4> points;
  CHECK(solve(network, true, 0, points).skinContacts == 0);
  CHECK(highest(points) == doctest::Approx(0.051f));
}
