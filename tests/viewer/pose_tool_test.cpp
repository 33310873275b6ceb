#include "viewer/pose_tool.h"

#include <doctest/doctest.h>

using namespace vasa;
using namespace vasa::viewer;

namespace {

// Joints in a row, the last two in one place.
Skeleton row() {
  Skeleton skeleton;
  const float places[] = {-0.5f, 0, 0.5f, 0.501f};
  for (std::uint32_t j = 0; j < 4; ++j) {
    Skeleton::Joint joint;
    if (j > 0) joint.parent = JointId{j - 1};
    joint.restWorld[3] = vec4(places[j], 0, 0, 1);
    joint.rest.translation = {places[j] - (j > 0 ? places[j - 1] : 0), 0, 0};
    skeleton.joints.push_back(joint);
  }
  return skeleton;
}

const Camera kCamera{.position = {0, 0, 4}, .target = {0, 0, 0}};
constexpr Rect kPicture{0, 0, 400, 300};

}  // namespace

TEST_CASE("of joints on one another one has a handle, and a press near it takes hold of it") {
  const Skeleton skeleton = row();
  const auto handles = jointHandles(skeleton, restPose(skeleton), kCamera, kPicture, 1);
  REQUIRE(handles.size() == 2);  // the root has none
  CHECK(handles[0].joint == JointId{1});
  CHECK(handles[1].joint == JointId{2});
  CHECK(glm::distance(handles[0].place, vec2(200, 150)) < 0.01f);
  CHECK(handleAt(handles, {206, 150}, 1)->joint == JointId{1});
  CHECK_FALSE(handleAt(handles, {212, 150}, 1));
  CHECK(handleAt(handles, {212, 150}, 2)->joint == JointId{1});
  CHECK_FALSE(handleAt({}, {0, 0}, 1));
}
