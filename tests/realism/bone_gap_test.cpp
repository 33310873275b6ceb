#include "realism/bone_gap.h"

#include "realism/two_legs.h"

using namespace vasa;

TEST_CASE(
    "the gap to a bone is taken at a level below the line between the bones, wherever the joint's axis is") {
  Body body = test::twoLegs().body;
  // A shin bone's back as a sheet in the plane z = 3 cm, beginning 2 cm below the axis of the left knee.
  SkinnedMesh bone;
  bone.name = "bones";
  bone.mesh.positions = {{0.1f, 0.83f, 0.03f}, {-0.2f, 0.5f, 0.03f}, {0.4f, 0.5f, 0.03f}};
  bone.mesh.triangles = {{0, 1, 2}};
  bone.normals.assign(3, vec3(0, 0, -1));
  SkinInfluence shin;
  shin.joints[0] = 2, shin.weights[0] = 1;
  bone.influences.assign(3, shin);
  body.meshes = {bone};

  // A vessel of 2 mm radius that comes nearer to the sheet by 1 mm a centimetre from above.
  std::vector<vec4> points;
  for (int i = 0; i < 30; ++i) {
    const float y = 0.9f - 0.01f * float(i);
    points.emplace_back(0.1f, y, 0.03f - 0.1f * (y - 0.5f), 0.002f);
  }
  NetworkBuilder builder;
  builder.addVessel({"a", "", VesselKind::artery}, points);
  const auto network = builder.build(1.75f);
  REQUIRE(network.ok());
  const auto path = PathFinder(*network).find("a", "a@end");
  REQUIRE(path.ok());

  const JointId knee{2};
  Pose pose = restPose(body.skeleton);
  const auto gapAt = [&](std::optional<float> level) {
    return boneGap(PosedBones(body, pose), knee, level, *network, *path, network->points());
  };
  CHECK(gapAt(0.0f) == doctest::Approx(0.033f - 0.002f).epsilon(0.01));
  CHECK(gapAt(-0.02f) == doctest::Approx(0.031f - 0.002f).epsilon(0.01));
  CHECK(gapAt({}) < 0.0175f);  // at the lower end

  // The level goes with the shin, and the vessel stays where it was.
  pose.world[2] = glm::translate(mat4(1), vec3(0, 0.02f, 0)) * pose.world[2];
  CHECK(gapAt(-0.02f) == doctest::Approx(0.033f - 0.002f).epsilon(0.01));
}
