#include "body/spine.h"

#include <doctest/doctest.h>

#include <limits>

#include "body/chain.h"

namespace {

using namespace vasa;
using namespace vasa::test;

const quat kQuarterAboutX = glm::angleAxis(kPi / 2, vec3(1, 0, 0));

}  // namespace

TEST_CASE("spines follow the straightest child and start at forks") {
  Body body = chainBody({{0, 0, 0}, {0, 1, 0}, {0, 2, 0}});
  Skeleton::Joint side;
  side.name = "side";
  side.parent = {1};
  side.restWorld = glm::translate(mat4(1), vec3(0.5f, 1.1f, 0));
  body.skeleton.joints.push_back(side);

  const Result<SpineSet> spines = deriveSpines(body.skeleton, body.name);
  REQUIRE(spines);
  REQUIRE(spines->limbs.size() == 2);
  CHECK(spines->limbs[0] == std::vector<JointId>{{0}, {1}, {2}});
  CHECK(spines->limbs[1] == std::vector<JointId>{{1}, {3}});
  CHECK(spines->joints[0].link == doctest::Approx(1));
  CHECK(spines->joints[0].axis.y == doctest::Approx(1));
  CHECK_FALSE(spines->joints[2].next.valid());
}

TEST_CASE("a joint close behind another does not lend it its direction") {
  const Body body = chainBody({{0, 0, 0}, {0.05f, 0, 0}, {0.05f, -1, 0}});
  const Result<SpineSet> spines = deriveSpines(body.skeleton, body.name);
  REQUIRE(spines);
  CHECK(spines->joints[0].axis.y < -0.99f);
  CHECK_FALSE(spines->joints[0].spreadsTwist);
}

TEST_CASE("bodies that have no usable joints are refused") {
  Body body = chainBody({});
  const Result<SpineSet> none = deriveSpines(body.skeleton, "mesh.glb");
  REQUIRE_FALSE(none);
  CHECK(none.error().fault == Fault::badInput);
  CHECK(none.error().message.find("mesh.glb: the body has no joints") == 0);

  body = chainBody({{0, 0, 0}, {0, 1, 0}});
  body.skeleton.joints[1].restWorld[0] = vec4(0);
  const Result<SpineSet> flat = deriveSpines(body.skeleton, body.name);
  REQUIRE_FALSE(flat);
  CHECK(flat.error().message.find("joint 'joint1'") != std::string::npos);
  body.skeleton.joints[1].restWorld[0].x = std::numeric_limits<float>::quiet_NaN();
  CHECK_FALSE(deriveSpines(body.skeleton, body.name));
}

TEST_CASE("a station turns by its share of the bend about the joint") {
  const Body body = chainBody({{0, 0, 0}, {0, 1, 0}, {0, 2, 0}});
  const Result<SpineSet> spines = deriveSpines(body.skeleton, body.name);
  REQUIRE(spines);
  SpinePose pose(*spines);
  pose.run(*spines, turned(body, {{1, kQuarterAboutX}}));
  const vec3 p(0.1f, 1.2f, 0.3f);
  for (const float share : {0.0f, 0.25f, 0.5f, 1.0f}) {
    const quat turn = glm::angleAxis(share * kPi / 2, vec3(1, 0, 0));
    const vec3 expected = vec3(0, 1, 0) + turn * (p - vec3(0, 1, 0));
    CHECK(glm::distance(pose.place({{1}, share}, p), expected) < 1e-6f);
  }
  CHECK(glm::length(bendOf(*spines, turned(body, {{1, kQuarterAboutX}}), {1})) == doctest::Approx(kPi / 2));
}

TEST_CASE("a station beyond the bend adds its share of the twist") {
  const Body body = chainBody({{0, 0, 0}, {0, 1, 0}, {0, 2, 0}});
  const Result<SpineSet> spines = deriveSpines(body.skeleton, body.name);
  REQUIRE(spines);
  const quat twist = glm::angleAxis(1.2f, vec3(0, 1, 0));
  const Pose bentAndTwisted = turned(body, {{1, kQuarterAboutX * twist}});
  SpinePose pose(*spines);
  pose.run(*spines, bentAndTwisted);
  const vec3 p(0.1f, 1.5f, 0.3f), centre(0, 1, 0);
  const quat half = kQuarterAboutX * glm::angleAxis(0.6f, vec3(0, 1, 0));
  CHECK(glm::distance(pose.place({{1}, 1.5f}, p), centre + half * (p - centre)) < 1e-6f);
  CHECK(glm::distance(pose.place({{1}, 2}, p), pose.placeAfter({1}, p)) < 1e-6f);
  CHECK(glm::length(bendOf(*spines, bentAndTwisted, {1})) == doctest::Approx(kPi / 2).epsilon(1e-4));
}
