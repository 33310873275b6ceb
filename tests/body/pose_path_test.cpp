#include "body/pose_path.h"

#include <doctest/doctest.h>

#include "body/chain.h"

using namespace vasa;

namespace {

const Body& arm() {
  static const Body body =
      test::chainBody({{0, 1, 0}, {0.1f, 1.2f, 0}, {0.4f, 1.2f, 0.05f}, {0.6f, 1.1f, 0}});
  return body;
}

quat about(vec3 axis, float degrees) { return glm::angleAxis(glm::radians(degrees), glm::normalize(axis)); }

/// The arm with each joint turned and scaled beyond its rest pose.
Pose scaled(const std::vector<std::pair<quat, vec3>>& joints) {
  std::vector<JointTransform> local;
  for (std::size_t j = 0; j < joints.size(); ++j) {
    const JointTransform& rest = arm().skeleton.joints[j].rest;
    local.push_back({rest.translation, rest.rotation * joints[j].first, joints[j].second});
  }
  return poseFromLocal(arm().skeleton, local);
}

bool near(const Pose& a, const Pose& b, float tolerance = 2e-5f) {
  for (std::size_t j = 0; j < a.world.size(); ++j)
    for (int k = 0; k < 4; ++k)
      if (!(glm::distance(a.world[j][k], b.world[j][k]) < tolerance)) return false;
  return true;
}

float limbLength(const Pose& pose, std::size_t joint) {
  return glm::distance(vec3(pose.world[joint][3]), vec3(pose.world[joint - 1][3]));
}

float turnOf(const Pose& from, const Pose& to) { return PosePath(arm().skeleton, from, to).largestTurn(); }

}  // namespace

TEST_CASE("a way begins and ends at the very poses that were given") {
  const Pose from = test::turned(arm(), {{1, about({1, 2, 3}, 50)}, {2, about({0, 1, 0}, -70)}});
  Pose to = test::turned(arm(), {{0, about({0, 0, 1}, 20)}, {3, about({1, 0, 0}, 110)}});
  to.world[2][0].y += 0.3f;  // shear, which no joint's transform has
  PosePath path(arm().skeleton, from, to);
  for (const float share : {0.0f, -0.5f}) CHECK(path.at(share).world == from.world);
  for (const float share : {1.0f, 1.5f}) CHECK(path.at(share).world == to.world);
}

TEST_CASE("limbs keep their length on the way, and joints turn evenly") {
  const Pose from = restPose(arm().skeleton);
  const Pose to = test::turned(
      arm(), {{0, about({1, 0, 1}, 60)}, {1, about({1, 2, 3}, 150)}, {2, about({0, 1, 0}, -170)}});
  PosePath path(arm().skeleton, from, to);
  for (const float share : {0.01f, 0.25f, 0.5f, 0.75f, 0.99f}) {
    CAPTURE(share);
    const Pose pose = path.at(share);
    for (std::size_t joint = 1; joint < 4; ++joint)
      CHECK(limbLength(pose, joint) == doctest::Approx(limbLength(from, joint)).epsilon(1e-5));
    const Pose expected = test::turned(arm(), {{0, about({1, 0, 1}, 60 * share)},
                                               {1, about({1, 2, 3}, 150 * share)},
                                               {2, about({0, 1, 0}, -170 * share)}});
    CHECK(near(pose, expected, 1e-5f));
  }
}

TEST_CASE("joints turn along the shorter arc") {
  const Pose from = restPose(arm().skeleton), to = test::turned(arm(), {{1, about({0, 0, 1}, 200)}});
  PosePath path(arm().skeleton, from, to);
  CHECK(near(path.at(0.25f), test::turned(arm(), {{1, about({0, 0, 1}, -40)}}), 1e-5f));
  CHECK(path.largestTurn() == doctest::Approx(glm::radians(160.0)).epsilon(1e-4));
}

TEST_CASE("the largest turn is a joint's about its parent, and that of a root does not count") {
  const Pose rest = restPose(arm().skeleton);
  CHECK(turnOf(rest, rest) < 1e-3f);
  CHECK(turnOf(rest, test::turned(arm(), {{0, about({1, 1, 0}, 80)}})) < 1e-3f);
  const Pose bent =
      test::turned(arm(), {{0, about({1, 1, 0}, 80)}, {1, about({0, 0, 1}, 30)}, {2, about({0, 0, 1}, 40)}});
  CHECK(turnOf(rest, bent) == doctest::Approx(glm::radians(40.0)).epsilon(1e-4));
  CHECK(turnOf(bent, rest) == doctest::Approx(glm::radians(40.0)).epsilon(1e-4));
}

TEST_CASE("joints that are scaled or mirrored stay so on the way") {
  const quat none(1, 0, 0, 0);
  for (const vec3 scale :
       {vec3(2, 2, 2), vec3(1.2f, 0.7f, 2), vec3(-1, 1, 1), vec3(1, -1, 1), vec3(1, 1, -1), vec3(-1)}) {
    CAPTURE(scale.x);
    CAPTURE(scale.y);
    CAPTURE(scale.z);
    const auto posed = [&](float share) {
      return scaled({{about({1, 0, 1}, 60 * share), vec3(1)},
                     {about({1, 2, 3}, 100 * share), scale},
                     {about({0, 1, 0}, -120 * share), vec3(1)},
                     {none, scale}});
    };
    const Pose from = posed(0), to = posed(1);
    CHECK(near(PosePath(arm().skeleton, to, to).at(0.5f), to));
    PosePath path(arm().skeleton, from, to);
    for (const float share : {0.3f, 0.5f, 0.9f}) CHECK(near(path.at(share), posed(share)));
    CHECK(path.largestTurn() == doctest::Approx(glm::radians(120.0)).epsilon(1e-4));
    // Half of the way and then the rest of it is the way.
    PosePath rest(arm().skeleton, path.at(0.5f), to);
    CHECK(near(rest.at(0.5f), path.at(0.75f)));
  }
}

TEST_CASE("what moves about its parent does so in a straight line, and scales change evenly") {
  const auto posed = [](vec3 place, float scale) {
    std::vector<JointTransform> local;
    for (const Skeleton::Joint& joint : arm().skeleton.joints) local.push_back(joint.rest);
    local[2].translation = place;
    local[2].scale = vec3(scale);
    return poseFromLocal(arm().skeleton, local);
  };
  PosePath path(arm().skeleton, posed({0.3f, 0, 0}, 1), posed({0.1f, 0.2f, -0.1f}, 3));
  CHECK(near(path.at(0.25f), posed({0.25f, 0.05f, -0.025f}, 1.5f), 1e-6f));
  CHECK(path.largestTurn() < 1e-3f);
}
