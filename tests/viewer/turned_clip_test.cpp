#include "viewer/turned_clip.h"

#include <doctest/doctest.h>

#include "io/gltf.h"

using namespace vasa;
using namespace vasa::viewer;

namespace {

float apart(const Pose& a, const Pose& b) {
  float most = 0;
  for (std::size_t j = 0; j < a.world.size(); ++j)
    most = std::max(most, glm::distance(vec3(a.world[j][3]), vec3(b.world[j][3])));
  return most;
}

}  // namespace

TEST_CASE("a clip with joints turned has the poses of both, frame by frame; without a clip it is one pose") {
  const auto body = readBody(std::filesystem::path(VASA_BUILD_DATA_DIR) / "human.glb");
  REQUIRE(body);
  const Skeleton& skeleton = body->skeleton;
  const JointId elbow = skeleton.find("LeftForeArm");
  REQUIRE(elbow.valid());
  const std::vector<JointTurn> turns{{elbow, {1, 0.2f, 0}, jointMotion(skeleton, elbow, "").axes}};
  const Clip& walk = body->clips.front();
  const Clip made = turnedClip(skeleton, &walk, turns);
  REQUIRE(made.frameCount() == walk.frameCount());
  CHECK(made.name == walk.name);
  for (std::uint32_t frame = 0; frame < made.frameCount(); frame += 7) {
    const float time = walk.timeOfFrame(frame);
    const Pose wanted = turned(skeleton, samplePose(skeleton, walk, time), turns);
    CHECK(apart(samplePose(skeleton, made, time), wanted) < 1e-5f);
    CHECK(apart(samplePose(skeleton, walk, time), wanted) > 0.01f);
  }
  const Clip still = turnedClip(skeleton, nullptr, turns);
  CHECK(still.frameCount() == 1);
  CHECK(apart(samplePose(skeleton, still, 0), turned(skeleton, restPose(skeleton), turns)) < 1e-5f);
}
