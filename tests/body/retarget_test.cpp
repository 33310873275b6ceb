#include "body/retarget.h"

#include <doctest/doctest.h>

#include "io/bvh.h"
#include "io/gltf.h"
#include "support/shared_data.h"

using namespace vasa;
using namespace vasa::test;

namespace {

// A body of our own: legs apart a little, arms that hang, standing on y = 0.
Body standing(const std::vector<std::string>& names) {
  const std::vector<std::pair<int, vec3>> places{
      {-1, {0, 1, 0}},       {0, {0, 1.4f, 0}},    {1, {0.2f, 1.4f, 0}}, {2, {0.2f, 1.1f, 0}},
      {3, {0.2f, 0.85f, 0}}, {0, {0.1f, 0.9f, 0}}, {5, {0.1f, 0.5f, 0}}, {6, {0.1f, 0.1f, 0}}};
  Body body;
  body.name = "doll";
  for (std::size_t i = 0; i < names.size(); ++i) {
    Skeleton::Joint joint;
    joint.name = names[i];
    if (places[i].first >= 0) joint.parent = {std::uint32_t(places[i].first)};
    joint.rest.translation =
        places[i].second - (places[i].first >= 0 ? places[std::size_t(places[i].first)].second : vec3(0));
    joint.restWorld = glm::translate(mat4(1), places[i].second);
    body.skeleton.joints.push_back(joint);
  }
  return body;
}

// The same joints as CMU names them, twice as large, arms stretched out at rest; one frame.
Motion stretched() {
  Motion motion;
  motion.name = "m.bvh";
  const std::vector<std::tuple<const char*, int, vec3>> joints{
      {"Hips", -1, {0, 0, 0}},          {"Spine1", 0, {0, 0.8f, 0}},   {"LeftArm", 1, {0.4f, 0, 0}},
      {"LeftForeArm", 2, {0.6f, 0, 0}}, {"LeftHand", 3, {0.5f, 0, 0}}, {"LeftUpLeg", 0, {0.2f, -0.2f, 0}},
      {"LeftLeg", 5, {0, -0.8f, 0}},    {"LeftFoot", 6, {0, -0.8f, 0}}};
  for (const auto& [name, parent, offset] : joints) {
    Motion::Joint joint;
    joint.name = name;
    if (parent >= 0) joint.parent = {std::uint32_t(parent)};
    joint.offset = offset;
    motion.joints.push_back(joint);
    motion.rotations.push_back(quat(1, 0, 0, 0));
    motion.translations.push_back(offset);
  }
  motion.joints[0].moves = true;
  motion.translations[0] = {3, 5, 7};
  motion.frameCount = 1;
  return motion;
}

const std::vector<std::string> kCmuNames{"Hips",     "Spine1",    "LeftArm", "LeftForeArm",
                                         "LeftHand", "LeftUpLeg", "LeftLeg", "LeftFoot"};

vec3 place(const Body& body, const Clip& clip, const char* joint) {
  return vec3(samplePose(body.skeleton, clip, 0).world[body.skeleton.find(joint).value][3]);
}

}  // namespace

TEST_CASE("names tell the parts of a body in each family") {
  const auto of = [](std::vector<std::string> names) { return humanoidNames(names); };
  const auto mixamo =
      of({"mixamorig:Hips", "mixamorig:Spine", "mixamorig:Spine1", "mixamorig:Spine2", "mixamorig:LeftArm",
          "mixamorig:LeftForeArm", "mixamorig:LeftHand", "mixamorig:LeftUpLeg", "mixamorig:LeftLeg"});
  CHECK(mixamo.family == "mixamo");
  CHECK(mixamo.of[1] == "spine");
  CHECK(mixamo.of[4] == "leftUpperArm");
  const auto game = of({"pelvis", "spine_01", "spine_02", "thigh_l", "calf_l", "foot_l", "upperarm_r",
                        "lowerarm_r", "hand_r"});
  CHECK(game.family == "makehuman game");
  CHECK(game.of[6] == "rightUpperArm");
  const auto rig = of({"root", "spine05", "upperleg01.L", "lowerleg01.L", "foot.L", "upperarm01.R",
                       "lowerarm01.R", "wrist.R", "head"});
  CHECK(rig.family == "makehuman");
  CHECK(rig.of[7] == "rightHand");
  const auto vrm =
      of({"hips", "spine", "chest", "neck", "head", "leftUpperArm", "leftLowerArm", "leftHand", "rightFoot"});
  CHECK(vrm.family == "vrm");
  CHECK(vrm.of[8] == "rightFoot");
  CHECK(of({"J_Bip_C_Hips", "J_Bip_C_Spine", "J_Bip_C_Head", "J_Bip_L_UpperArm", "J_Bip_L_LowerArm",
            "J_Bip_L_Hand", "J_Bip_R_Foot", "J_Bip_C_Neck"})
            .family == "vroid");
  CHECK(of({"a", "b"}).family.empty());
}

TEST_CASE(
    "arms that hang at rest are stretched out where the motion's are, and the feet stand on their floor") {
  const Body body = standing(kCmuNames);
  const auto clip = retarget(stretched(), body);
  if (!clip.ok()) FAIL(clip.error().message);
  CHECK(clip->frameCount() == 1);
  CHECK(glm::distance(place(body, *clip, "LeftForeArm"), place(body, *clip, "LeftArm") + vec3(0.3f, 0, 0)) <
        1e-5f);
  CHECK(glm::distance(place(body, *clip, "LeftHand"), place(body, *clip, "LeftForeArm") + vec3(0.25f, 0, 0)) <
        1e-5f);
  CHECK(glm::distance(place(body, *clip, "LeftFoot"), vec3(0.1f, 0.1f, 0)) < 1e-5f);
}

TEST_CASE("a turn of the motion's joint in space is the body's, however the rests differ") {
  const Body body = standing(kCmuNames);
  Motion motion = stretched();
  motion.rotations[2] = glm::angleAxis(kPi / 2, vec3(0, 0, 1));  // the arm goes up
  const auto clip = retarget(motion, body);
  REQUIRE(clip.ok());
  CHECK(glm::distance(place(body, *clip, "LeftHand"), place(body, *clip, "LeftArm") + vec3(0, 0.55f, 0)) <
        1e-5f);
}

TEST_CASE("a motion with Biovision's names moves a body with CMU's: its Shoulder is the upper arm") {
  const Body body = standing(kCmuNames);
  Motion motion = stretched();
  const char* names[] = {"Hips",      "Chest",   "LeftShoulder", "LeftElbow",
                         "LeftWrist", "LeftHip", "LeftKnee",     "LeftAnkle"};
  for (std::size_t i = 0; i < motion.joints.size(); ++i) motion.joints[i].name = names[i];
  motion.rotations[2] = glm::angleAxis(kPi / 2, vec3(0, 0, 1));
  const auto clip = retarget(motion, body);
  if (!clip.ok()) FAIL(clip.error().message);
  CHECK(glm::distance(place(body, *clip, "LeftHand"), place(body, *clip, "LeftArm") + vec3(0, 0.55f, 0)) <
        1e-5f);
}

TEST_CASE("joints without a common name are paired by a map; what is missing is told") {
  std::vector<std::string> names;
  JointMap map;
  for (const std::string& name : kCmuNames) names.push_back("x" + name), map[name] = names.back();
  const Body body = standing(names);
  const auto alone = retarget(stretched(), body);
  REQUIRE(!alone.ok());
  CHECK(alone.error().message.find("0 joints in common") != std::string::npos);
  CHECK(alone.error().message.find("--joint-map") != std::string::npos);
  const auto clip = retarget(stretched(), body, map);
  REQUIRE(clip.ok());
  map["Tail"] = "xHips";
  CHECK(retarget(stretched(), body, map).error().message.find("m.bvh has no joint 'Tail'") !=
        std::string::npos);
  map.erase("Tail");
  map["Hips"] = "nobody";
  CHECK(retarget(stretched(), body, map).error().message.find("doll has no joint 'nobody'") !=
        std::string::npos);
}

TEST_CASE("a map that exchanges arm and hand is followed, and told to be the wrong way round") {
  std::vector<std::string> names;
  JointMap map;
  for (const std::string& name : kCmuNames) names.push_back("x" + name), map[name] = names.back();
  const Body body = standing(names);
  const auto right = retargeted(stretched(), body, map);
  REQUIRE(right.ok());
  CHECK(right->turnedRound.empty());
  std::swap(map["LeftArm"], map["LeftHand"]);
  const auto wrong = retargeted(stretched(), body, map);
  if (!wrong.ok()) FAIL(wrong.error().message);
  CHECK(wrong->sureness < kLeastSureness);
  CHECK(describeMatch(*wrong).find("the wrong way round: 'xLeftArm' above 'xLeft") != std::string::npos);
}

TEST_CASE("CMU's walk on other bodies: joints within 3.5 cm of a careful transfer of the same motion") {
  VASA_REQUIRE_SHARED_DATA(data);
  const auto motion = readBvh(data / "mocap/cmu_walk_02_01.bvh");
  REQUIRE(motion.ok());
  for (const char* file :
       {"bp3d/bp3d_body.glb", "rigs/makehuman_male_cmu31.glb", "rigs/makehuman_female_cmu31.glb"}) {
    const auto body = readBody(data / file);
    REQUIRE(body.ok());
    const auto clip = retarget(*motion, *body);
    REQUIRE(clip.ok());
    const auto& clips = body->clips;
    const auto reference =
        std::find_if(clips.begin(), clips.end(), [](const Clip& c) { return c.name == "walk_02_01"; });
    REQUIRE(reference != clips.end());
    CHECK(clip->frameCount() == reference->frameCount());
    float worst = 0, lowest = 1e9f;
    for (std::uint32_t frame = 0; frame < clip->frameCount(); ++frame) {
      const Pose pose = samplePose(body->skeleton, *clip, clip->timeOfFrame(frame));
      const Pose wanted = samplePose(body->skeleton, *reference, reference->timeOfFrame(frame));
      for (const char* name :
           {"Head", "LeftArm", "LeftForeArm", "LeftHand", "RightHand", "LeftLeg", "LeftFoot", "RightFoot"}) {
        const std::uint32_t j = body->skeleton.find(name).value, hips = body->skeleton.find("Hips").value;
        const vec3 own = vec3(pose.world[j][3]) - vec3(pose.world[hips][3]),
                   theirs = vec3(wanted.world[j][3]) - vec3(wanted.world[hips][3]);
        worst = std::max(worst, glm::distance(own, theirs));
      }
      for (const char* name : {"LeftToeBase", "RightToeBase"}) {
        const auto& joint = body->skeleton.joints[body->skeleton.find(name).value];
        lowest = std::min(lowest, pose.world[body->skeleton.find(name).value][3].y - joint.restWorld[3].y);
      }
    }
    MESSAGE(std::string(file) << ": at most " << 100 * worst << " cm from it; lowest toe " << 100 * lowest
                              << " cm from its height at rest");
    CHECK(worst < 0.035f);
    CHECK(std::abs(lowest) < 0.01f);
  }
  const auto game = readBody(data / "rigs/makehuman_male_game53.glb");
  REQUIRE(game.ok());
  CHECK(retarget(*motion, *game).ok());
}
