#include "viewer/pose_tool.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <memory>

#include "io/gltf.h"
#include "viewer/human_data.h"
#include "viewer/pose_text.h"
#include "viewer/scene_keeper.h"

using namespace vasa;
using namespace vasa::viewer;

namespace {

const Camera kCamera{.position = {0, 1, 4}, .target = {0, 1, 0}};
constexpr Rect kSquare{0, 0, 800, 800};

// The human at rest, with nothing but what posing asks for.
struct Posing {
  Document document;
  PosedBody body;
  ViewState state;
  PoseTool tool;

  Posing() {
    auto read = readBody(test::kData / "human.glb");
    auto ranges = readJointRanges(test::kData / "realism" / "ranges.csv");
    REQUIRE(read);
    REQUIRE(ranges);
    document.scene.body = std::move(*read);
    document.mannequin = std::make_shared<const Mannequin>(document.scene.body.skeleton, *ranges);
    body.pose = restPose(document.scene.body.skeleton);
  }
  const Skeleton& skeleton() const { return document.scene.body.skeleton; }
  vec2 handle(std::string_view name) const {
    for (const JointHandle& each : jointHandles(*document.mannequin, body.pose, kCamera, kSquare, 1))
      if (document.mannequin->grips()[each.grip].name == name) return each.place;
    FAIL("no such handle");
    return {};
  }
  void feed(const InputEvent& event, bool single = false) {
    tool.feed(event, single, document, body, kCamera, kSquare, state);
  }
  void move(vec2 to) {
    feed(PointerMoved{to});
    body.order.turns = state.turns;
    body.pose = turned(skeleton(), restPose(skeleton()), state.turns);
  }
  void press(vec2 at, bool single = false) {
    tool.hover(at);
    feed(ButtonChanged{Button::left, true}, single);
  }
  void release() { feed(ButtonChanged{Button::left, false}); }
  vec3 place(const char* joint) const { return vec3(body.pose.world[skeleton().find(joint).value][3]); }
  float turnOf(const char* joint) const {
    for (const JointTurn& turn : state.turns)
      if (turn.joint == skeleton().find(joint)) return glm::length(turn.angles);
    return 0;
  }
};

}  // namespace

TEST_CASE("handles are at least 14 pixels wide and lie apart, and a press near one takes hold of it") {
  const Posing posing;
  const auto handles = jointHandles(*posing.document.mannequin, posing.body.pose, kCamera, kSquare, 1);
  CHECK(2 * kHandleRadius >= 14);
  CHECK(handles.size() > 15);
  for (const JointHandle& a : handles)
    for (const JointHandle& b : handles)
      if (&a != &b) CHECK(glm::distance(a.place, b.place) >= 11);
  // From the side the nearer wrist lies over the other.
  for (const float side : {1.0f, -1.0f}) {
    const Camera beside{.position = {side * 4, 1, 0}, .target = {0, 1, 0}};
    bool near = false, far = false;
    for (const JointHandle& handle :
         jointHandles(*posing.document.mannequin, posing.body.pose, beside, kSquare, 1)) {
      const std::string& name = posing.document.mannequin->grips()[handle.grip].name;
      near = near || name == (side > 0 ? "left wrist" : "right wrist");
      far = far || name == (side > 0 ? "right wrist" : "left wrist");
    }
    CHECK(near);
    CHECK_FALSE(far);
  }
  const vec2 wrist = posing.handle("left wrist");
  CHECK(handleAt(handles, wrist + vec2(0, 7), 1)->place == wrist);
  CHECK_FALSE(handleAt({}, {0, 0}, 1));
}

TEST_CASE("the wrist is pulled where the pointer goes and the arm goes along, straight forearm and all") {
  Posing posing;
  const vec2 wrist = posing.handle("left wrist");
  posing.press(wrist);
  for (int i = 1; i <= 20; ++i) {
    const vec2 to = wrist + vec2(30, -150) * (float(i) / 20);
    posing.move(to);
    CHECK(glm::distance(posing.handle("left wrist"), to) < 0.5f);
  }
  posing.release();
  CHECK_FALSE(posing.tool.held());
  CHECK(posing.turnOf("LeftArm") > 0.3f);
  CHECK(posing.turnOf("LeftForeArmRoll") == 0);
  CHECK(posing.turnOf("RightArm") == 0);
  const auto angles =
      std::ranges::find(posing.state.turns, posing.skeleton().find("LeftForeArm"), &JointTurn::joint)->angles;
  CHECK(angles.y == doctest::Approx(0).epsilon(1e-4));
  CHECK(angles.x >= 0);
  CHECK(angles.x <= glm::radians(145.01f));
}

TEST_CASE("what is pulled beyond its reach is stretched towards the pointer, and a pull back undoes it") {
  Posing posing;
  const vec2 ankle = posing.handle("right ankle");
  const vec3 before = posing.place("RightFoot");
  posing.press(ankle);
  posing.move(ankle + vec2(-500, -100));
  CHECK(posing.place("RightFoot").x < before.x - 0.3f);
  posing.move(ankle);
  CHECK(glm::distance(posing.place("RightFoot"), before) < 2e-3f);
}

TEST_CASE("with Ctrl one joint turns alone; with both sides the other limb does the same") {
  Posing posing;
  posing.press(posing.handle("left wrist"), true);
  posing.move(posing.handle("left wrist") + vec2(-60, -60));
  posing.release();
  CHECK(posing.turnOf("LeftArm") == 0);
  CHECK(posing.turnOf("LeftForeArm") > 0.01f);
  Posing both;
  both.state.bothSides = true;
  const vec2 elbow = both.handle("left elbow");
  both.press(elbow);
  both.move(elbow + vec2(60, -40));
  CHECK(both.turnOf("LeftArm") > 0.1f);
  CHECK(glm::distance(both.place("LeftForeArm"), vec3(-1, 1, 1) * both.place("RightForeArm")) < 2e-3f);
}

TEST_CASE("a copied pose is pasted as it was, out of a scene, too; what is no pose is refused") {
  Posing posing;
  const vec2 wrist = posing.handle("left wrist");
  posing.press(wrist);
  posing.move(wrist + vec2(80, -200));
  const std::string text = poseText(poseOf(posing.skeleton(), posing.state.turns));
  const auto again = poseOfText(text);
  REQUIRE_MESSAGE(again, (again ? "" : again.error().message));
  CHECK(poseText(*again) == text);
  CHECK(turnsOf(posing.skeleton(), *again).size() == poseOf(posing.skeleton(), posing.state.turns).size());
  CHECK(poseOfText("{ \"body\": \"a.glb\", \"pose\": { \"Head\": [1, 2, 3] } }")->front().degrees ==
        vec3(1, 2, 3));
  CHECK_FALSE(poseOfText("femoral artery"));
  CHECK(poseOfText("{}").error().message.find("holds no pose") != std::string::npos);
}

TEST_CASE(
    "a pelvis that is pulled down sinks over bending knees, with the feet where they were, and comes back") {
  Posing human;
  const vec3 pelvis = human.place("Hips"), head = human.place("Head");
  const char* const kPlanted[] = {"LeftFoot", "RightFoot", "LeftToeBase", "RightToeBase"};
  std::vector<vec3> planted;
  for (const char* joint : kPlanted) planted.push_back(human.place(joint));
  const vec2 at = human.handle("pelvis");
  human.press(at);
  for (int step = 1; step <= 10; ++step) human.move(at + vec2(0, 10 * float(step)));
  const vec3 sunk = human.place("Hips") - pelvis;
  CHECK(sunk.y < -0.2f);
  CHECK(std::abs(sunk.x) < 1e-4f);
  CHECK(std::abs(sunk.z) < 1e-4f);
  CHECK(human.place("Head").y - head.y == doctest::Approx(sunk.y));
  for (std::size_t k = 0; k < std::size(kPlanted); ++k) {
    CAPTURE(kPlanted[k]);
    CHECK(glm::distance(human.place(kPlanted[k]), planted[k]) < 2e-3f);
  }
  for (const char* knee : {"LeftLeg", "RightLeg"}) {
    CHECK(human.turnOf(knee) > 0.7f);
    CHECK(human.place(knee).z > human.place("Hips").z + 0.1f);  // forwards
  }
  human.move(at);
  CHECK(glm::distance(human.place("Hips"), pelvis) < 1e-4f);
  for (std::size_t k = 0; k < std::size(kPlanted); ++k)
    CHECK(glm::distance(human.place(kPlanted[k]), planted[k]) < 2e-3f);
  human.release();
}

TEST_CASE(
    "a pelvis stops where a foot would go through the floor, and takes the feet off it when it is lifted") {
  Posing human;
  const float floor = human.place("LeftFoot").y;
  const vec2 at = human.handle("pelvis");
  human.press(at);
  for (int step = 1; step <= 30; ++step) {
    human.move(at + vec2(0, 8 * float(step)));
    CHECK(human.place("LeftFoot").y > floor - 2e-3f);
    CHECK(human.place("RightFoot").y > floor - 2e-3f);
  }
  const float lowest = human.place("Hips").y;
  for (int step = 29; step >= -10; --step) human.move(at + vec2(0, 8 * float(step)));
  CHECK(human.place("LeftFoot").y > floor + 0.1f);
  CHECK(human.place("Hips").y > lowest + 0.5f);
  CHECK(human.turnOf("Hips") == 0);
}

TEST_CASE("where the body is moved to goes through a scene's text and the clipboard, and to the other side") {
  Posing human;
  const vec2 at = human.handle("pelvis");
  human.press(at);
  human.move(at + vec2(20, 30));
  const auto pose = poseOf(human.skeleton(), human.state.turns);
  const auto again = poseOfText(poseText(pose));
  REQUIRE(again);
  SceneFile scene;
  scene.pose = pose;
  const auto reread = parseScene(sceneText(scene, "."), ".", "scene.json");
  REQUIRE(reread);
  for (const auto& read : {*again, reread->pose}) {
    const Pose posed = turned(human.skeleton(), restPose(human.skeleton()), turnsOf(human.skeleton(), read));
    const JointId hips = human.skeleton().find("Hips");
    CHECK(glm::distance(vec3(posed.world[hips.value][3]), human.place("Hips")) < 1e-4f);
  }
  const auto mirrored = mirroredTurns(*human.document.mannequin, human.state.turns);
  const auto moved = [&](const std::vector<JointTurn>& turns) {
    return std::ranges::find(turns, human.skeleton().find("Hips"), &JointTurn::joint)->moved;
  };
  CHECK(moved(human.state.turns).x > 0.05f);
  CHECK(moved(mirrored) == vec3(-1, 1, 1) * moved(human.state.turns));
}

TEST_CASE("where a hip is pulled aside over bent knees the feet stay where they are, and flat") {
  Posing human;
  for (const std::string side : {"Left", "Right"}) {
    for (const auto& [name, bend] : {std::pair{"UpLeg", 0.5f}, std::pair{"Leg", -1.0f}}) {
      const JointId joint = human.skeleton().find(side + name);
      REQUIRE(joint.valid());
      const JointMotion& motion = human.document.mannequin->motion(joint);
      turnOfJoint(human.state, joint, motion).angles.x = bend;
    }
  }
  human.move({0, 0});
  const vec3 left = human.place("LeftFoot"), right = human.place("RightFoot"), head = human.place("Head");
  const vec3 toes = human.place("LeftToeBase");
  const auto anglesOf = [&](const char* joint) {
    return turnOfJoint(human.state, human.skeleton().find(joint), {}).angles;
  };
  const vec3 thigh = anglesOf("LeftUpLeg");
  const vec2 at = human.handle("left hip");
  human.press(at);
  for (int step = 1; step <= 4; ++step) human.move(at + vec2(0, -float(step)));
  CHECK(glm::distance(human.place("Head"), head) > 0.02f);
  CHECK(glm::distance(human.place("LeftFoot"), left) < 5e-3f);
  CHECK(glm::distance(human.place("RightFoot"), right) < 5e-3f);
  CHECK(glm::distance(human.place("LeftToeBase"), toes) < 1e-2f);
  CHECK(glm::distance(anglesOf("LeftUpLeg"), thigh) > 0.01f);
}
