#include "solids/skin_wall.h"

#include <doctest/doctest.h>

#include "support/meshes.h"
#include "support/networks.h"
#include "support/walk.h"

using namespace vasa;

namespace {

// A closed box as tall as a body for a skin, half on each of two joints as no bone is, and a vessel below its
// lid along x.
Body boxedBody() {
  Body body;
  body.skeleton.joints.push_back({.name = "root"});
  body.skeleton.joints.push_back({.name = "next", .parent = {0}});
  body.meshes.push_back(test::boxMesh("skin", {-0.05f, -1.65f, -0.05f}, vec3(0.05f)));
  for (SkinInfluence& influence : body.meshes[0].influences) influence = {{0, 1, 0, 0}, {0.5f, 0.5f, 0, 0}};
  return body;
}

// From rest to a bow.
test::Solved bent(const Network& network, bool wall, float raised) {
  const Body body = boxedBody();
  Avoider avoider(network, &body, {.skinWall = wall});
  const test::Posed rest = test::atRest(network, 2);
  test::Posed bow = rest;  // so that the ends stay below
  for (vec4& p : bow.points) p.y += raised * std::max(0.0f, 1 - std::abs(p.x) / 0.03f);
  return test::solve(avoider, rest, bow);
}

float highest(std::span<const vec4> points) {
  float top = -1;
  for (float u = 0; u <= float(points.size() - 3); u += 0.05f) top = std::max(top, evaluate(points, u).y);
  return top;
}

}  // namespace

TEST_CASE("a vessel that a pose pushes through the skin is held below it, if that is asked for") {
  const Network network = test::levelVessel(0.045f, 0.046f);
  const test::Solved without = bent(network, false, 0.008f);
  CHECK(without.before.skinContacts == 0);
  CHECK(highest(without.points) > 0.051f);
  const test::Solved held = bent(network, true, 0.008f);
  CHECK(held.before.skinContacts > 0);
  CHECK(held.report.skinContactsAfter == 0);
  CHECK(highest(held.points) < 0.0485f);
}

TEST_CASE("a vessel that was through the skin at rest may stay as far out as it was") {
  const Network network = test::levelVessel(0.045f, 0.051f);
  const test::Solved solved = bent(network, true, 0);
  CHECK(solved.before.skinContacts == 0);
  CHECK(solved.report.skinContactsAfter == 0);
  CHECK(std::abs(highest(solved.points) - 0.051f) < 1e-6f);
}
