#include "plate/plate_region.h"

#include <doctest/doctest.h>

#include "atlas/human_scene.h"

using namespace vasa;
using namespace vasa::plate;

TEST_CASE("a vertex belongs to the joint with the largest weight") {
  SkinnedMesh mesh;
  mesh.influences = {{.joints = {3, 5, 7, 9}, .weights = {0.2f, 0.1f, 0.6f, 0.1f}},
                     {.joints = {4}, .weights = {1, 0, 0, 0}}};
  Body body;
  body.skeleton.joints.resize(10);
  CHECK(mainJoints(body, mesh) == std::vector<std::uint16_t>{7, 4});
}

TEST_CASE("a plate that there is not is told with those that there are") {
  CHECK(checkPlateName("hand").ok());
  const auto wrong = checkPlateName("elbow");
  REQUIRE_FALSE(wrong.ok());
  CHECK(wrong.error().fault == Fault::usage);
  CHECK(wrong.error().message.find("foot") != std::string::npos);
}

TEST_CASE("a page looks at a body's own front, whichever way it stands in its file") {
  const Skeleton& human = test::humanScene().body.skeleton;
  CHECK(facing(human) == mat3(1));
  for (const float degrees : {20.0f, 90.0f, 180.0f, -90.0f}) {
    const mat4 turn = glm::rotate(mat4(1), glm::radians(degrees), vec3(0, 1, 0));
    Skeleton turned = human;
    for (Skeleton::Joint& joint : turned.joints) joint.restWorld = turn * joint.restWorld;
    const vec3 front = facing(turned) * vec3(0, 0, 1), own = degrees == 20 ? vec3(0, 0, 1) : vec3(turn[2]);
    CHECK_MESSAGE(glm::distance(front, own) < 0.1f, degrees);
  }
  Skeleton unknown = human;
  for (Skeleton::Joint& joint : unknown.joints) joint.name = "bone", joint.restWorld = mat4(1);
  CHECK(facing(unknown) == mat3(1));
}

TEST_CASE("a page of vessels alone holds their walls") {
  Scene scene = test::humanScene();
  scene.body.meshes.clear();
  FrameMaker frame(scene, {.avoid = false});
  frame.make(nullptr, 0);
  const auto subject = plateSubject(scene, frame, "front", -1);
  REQUIRE_MESSAGE(subject.ok(), subject.error().message);
  Aabb held, walls;
  for (const vec3& place : subject->framed) held.add(place);
  for (const vec4& point : frame.points()) {
    walls.add(vec3(point) - point.w);
    walls.add(vec3(point) + point.w);
  }
  CHECK(glm::distance(held.low, walls.low) < 1e-6f);
  CHECK(glm::distance(held.high, walls.high) < 1e-6f);
}
