#include "viewer/undo_name.h"

#include <doctest/doctest.h>

#include "io/gltf.h"
#include "viewer/pose_tool.h"

using namespace vasa;
using namespace vasa::viewer;

TEST_CASE("what is undone has the name of what was done") {
  const auto body = readBody(std::filesystem::path(VASA_BUILD_DATA_DIR) / "human.glb");
  REQUIRE_MESSAGE(body, (body ? "" : body.error().message));
  const Mannequin mannequin(body->skeleton, {});
  const auto turn = [&](ViewState& state, const char* part) {
    const JointId joint = mannequin.find(part);
    REQUIRE(joint.valid());
    turnOfJoint(state, joint, mannequin.motion(joint)).angles += vec3(0.2f, 0, 0);
  };
  const ViewState before;
  ViewState after;
  turn(after, "leftLowerArm");
  CHECK(undoName(before, after, mannequin) == "turn of left elbow");
  turn(after, "leftUpperArm");
  CHECK(undoName(before, after, mannequin) == "move of left wrist");
  CHECK(undoName(after, before, mannequin) == "reset of the pose");
  turn(after, "rightLowerLeg");
  CHECK(undoName(before, after, mannequin) == "pose");
  after.journal = {"stenosis \"left femoral artery\" 0.5 10 70"};
  CHECK(undoName(before, after, mannequin) == "stenosis of left femoral artery");
  CHECK(undoName(after, before, mannequin) == "taking back an edit");
  ViewState other;
  other.orbit.orbit({0.3f, 0});
  CHECK(undoName(before, other, mannequin) == "view");
  other.look.drawSkin = !other.look.drawSkin;
  CHECK(undoName(before, other, mannequin) == "look");
}
