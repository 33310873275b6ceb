#include <doctest/doctest.h>

#include <algorithm>

#include "body/limb_clearance.h"
#include "scene_human.h"

using namespace vasa;

namespace {

// The walk with its left arm nearer to the body.
Clip closeWalk() {
  Clip clip = clipNamed("walk");
  clip.name = "close";
  const JointId arm = human().body.skeleton.find("LeftArm");
  const auto tracks = std::ranges::find(clip.tracks, arm, &JointTracks::joint);
  REQUIRE(tracks != clip.tracks.end());
  REQUIRE(tracks->rotation.interpolation != Interpolation::cubic);
  const Pose pose = restPose(human().body.skeleton);
  const JointId above = human().body.skeleton.joints[arm.value].parent;
  const quat parent = glm::normalize(glm::quat_cast(mat3(pose.world[above.value])));
  const quat inwards = glm::angleAxis(glm::radians(-14.0f), vec3(0, 0, 1));  // +X is left
  for (quat& turn : tracks->rotation.values) turn = glm::conjugate(parent) * inwards * parent * turn;
  return clip;
}

}  // namespace

TEST_CASE("the built-in human's clips keep arms, legs and body apart") {
  std::vector<Clip> clips = human().body.clips;
  const auto told = keepLimbsClear(human().body, clips);
  CHECK(told.size() == 3 * clips.size());
  for (const ClearedLimb& limb : told) {
    CAPTURE(limb.clip);
    CHECK(limb.frames == 0);
  }
}

TEST_CASE("a scene's clip is cleared, unless it asks for the motion as recorded") {
  Scene scene = human();
  scene.body.clips.push_back(closeWalk());
  std::vector<Clip> given = scene.body.clips;
  const auto through = [&](const Clip& clip) {
    Clip copy = clip;
    std::uint32_t frames = 0;
    for (const ClearedLimb& arm : keepLimbsClear(scene.body, {&copy, 1})) frames += arm.frames;
    return frames;
  };
  REQUIRE(through(given.back()) > 5);
  SceneFile file;
  file.clip = "close";
  file.asRecorded = true;
  auto clip = sceneClip(scene, file);
  REQUIRE(clip.ok());
  CHECK(through(**clip) == through(given.back()));
  file.asRecorded = false;
  clip = sceneClip(scene, file);
  REQUIRE(clip.ok());
  CHECK(*clip == &scene.body.clips.back());
  CHECK(through(**clip) == 0);
  file.clip.clear();
  clip = sceneClip(scene, file);
  REQUIRE(clip.ok());
  CHECK(*clip == nullptr);
}
