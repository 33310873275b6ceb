#include "body/joint_angles.h"

#include <doctest/doctest.h>

#include "body/chain.h"

using namespace vasa;

namespace {

// An upright body that faces +z, by the names of CMU's files: hips, legs, trunk, neck of two joints, arms.
Body upright(float turned = 0) {
  struct Row {
    const char* name;
    int parent;
    vec3 place;
  };
  const Row rows[]{{"Hips", -1, {0, 1, 0}},
                   {"LeftUpLeg", 0, {0.1f, 0.95f, 0}},
                   {"LeftLeg", 1, {0.1f, 0.5f, 0}},
                   {"LeftFoot", 2, {0.1f, 0.1f, 0}},
                   {"RightUpLeg", 0, {-0.1f, 0.95f, 0}},
                   {"RightLeg", 4, {-0.1f, 0.5f, 0}},
                   {"RightFoot", 5, {-0.1f, 0.1f, 0}},
                   {"LowerBack", 0, {0, 1.1f, 0}},
                   {"Spine", 7, {0, 1.25f, 0}},
                   {"Spine1", 8, {0, 1.35f, 0}},
                   {"Neck", 9, {0, 1.5f, 0}},
                   {"Neck1", 10, {0, 1.55f, 0}},
                   {"Head", 11, {0, 1.6f, 0}},
                   {"LeftArm", 9, {0.2f, 1.45f, 0}},
                   {"LeftForeArm", 13, {0.2f, 1.15f, 0}},
                   {"LeftHand", 14, {0.2f, 0.9f, 0}}};
  Body body;
  const mat4 turn = glm::mat4_cast(glm::angleAxis(turned, vec3(0, 1, 0)));
  for (const Row& row : rows) {
    Skeleton::Joint joint;
    joint.name = row.name;
    joint.restWorld = turn * glm::translate(mat4(1), row.place);
    const mat4 local =
        row.parent < 0
            ? joint.restWorld
            : glm::inverse(body.skeleton.joints[std::size_t(row.parent)].restWorld) * joint.restWorld;
    if (row.parent >= 0) joint.parent = {std::uint32_t(row.parent)};
    joint.rest.translation = vec3(local[3]);
    joint.rest.rotation = glm::quat_cast(local);
    joint.inverseBind = glm::inverse(joint.restWorld);
    body.skeleton.joints.push_back(joint);
  }
  return body;
}

vec3 placeOf(const Body& body, const Pose& pose, const char* joint) {
  return vec3(pose.world[body.skeleton.find(joint).value][3]);
}

bool isAt(vec3 a, vec3 b) { return glm::distance(a, b) < 1e-4f; }

}  // namespace

TEST_CASE("joints bend the way anatomists say, whichever way the body faces") {
  const float right = glm::radians(90.0f);
  for (const float facing : {0.0f, 1.0f, -2.5f}) {
    const Body body = upright(facing);
    const quat turn = glm::angleAxis(facing, vec3(0, 1, 0));
    const auto posed = [&](JointAngles angles) {
      auto pose = poseByAngles(body.skeleton, std::array{angles});
      REQUIRE(pose.ok());
      return *pose;
    };
    CHECK(isAt(placeOf(body, posed({"leftUpperLeg", right}), "LeftLeg"), turn * vec3(0.1f, 0.95f, 0.45f)));
    CHECK(isAt(placeOf(body, posed({"leftLowerLeg", right}), "LeftFoot"), turn * vec3(0.1f, 0.5f, -0.4f)));
    CHECK(isAt(placeOf(body, posed({"leftLowerArm", right}), "LeftHand"), turn * vec3(0.2f, 1.15f, 0.25f)));
    CHECK(isAt(placeOf(body, posed({"leftUpperLeg", 0, right}), "LeftLeg"), turn * vec3(0.55f, 0.95f, 0)));
    CHECK(isAt(placeOf(body, posed({"rightUpperLeg", 0, right}), "RightLeg"), turn * vec3(-0.55f, 0.95f, 0)));
  }
}

TEST_CASE("twist is inwards on both sides, and a neck's is shared by its joints") {
  const Body body = upright();
  const float right = glm::radians(90.0f);
  // With the knee bent backwards, a thigh that turns inwards takes the foot outwards.
  for (const bool left : {true, false}) {
    const std::string side = left ? "left" : "right";
    auto pose = poseByAngles(body.skeleton, std::array{JointAngles{side + "UpperLeg", 0, 0, right},
                                                       JointAngles{side + "LowerLeg", right}});
    REQUIRE(pose.ok());
    CHECK(isAt(placeOf(body, *pose, left ? "LeftFoot" : "RightFoot"), vec3(left ? 0.5f : -0.5f, 0.5f, 0)));
  }
  auto pose = poseByAngles(body.skeleton, std::array{JointAngles{"neck", 0, 0, right}});
  REQUIRE(pose.ok());
  const auto turnOf = [&](const char* joint) {
    return glm::angle(glm::quat_cast(pose->world[body.skeleton.find(joint).value]));
  };
  CHECK(turnOf("Neck") == doctest::Approx(right / 2));
  CHECK(turnOf("Neck1") == doctest::Approx(right));
  CHECK(turnOf("Head") == doctest::Approx(right));
  auto half = poseByAngles(body.skeleton, std::array{JointAngles{"neck", 0, 0, right}}, 0.5f);
  REQUIRE(half.ok());
  CHECK(glm::angle(glm::quat_cast(half->world[body.skeleton.find("Head").value])) ==
        doctest::Approx(right / 2));
}

TEST_CASE("a part that is not there is named") {
  const auto none = poseByAngles(upright().skeleton, std::array{JointAngles{"leftToes", 1}});
  REQUIRE_FALSE(none.ok());
  CHECK(none.error().fault == Fault::badInput);
  CHECK(none.error().message.find("'leftToes'") != std::string::npos);
}
