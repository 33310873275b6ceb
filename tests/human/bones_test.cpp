#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include "body/axial_bones.h"
#include "body/binding.h"
#include "body/deform.h"
#include "body/skinning.h"
#include "core/parallel.h"
#include "human/made_human.h"
#include "make_human/bones.h"
#include "make_human/motion_probe.h"
#include "make_human/solid.h"

using namespace vasa;
using namespace vasa::human;

namespace {

constexpr std::size_t kBoneVertexStep = 3;  // vertices looked at for leaving the skin

const std::vector<BoneForm>& forms() {
  static const Result<std::vector<BoneForm>> read =
      readBoneForms(kTables / "bones.csv", kTables / "bone_forms.csv", madeHuman().rig);
  if (!read.ok()) FAIL(read.error().message);
  return *read;
}

/// One bone of the left side or the middle.
SkinnedMesh boneNamed(std::string_view name) {
  for (const BoneForm& form : forms())
    if (form.name == name) {
      BoneForm left = form;
      left.paired = false;
      for (SkinnedMesh& mesh : makeBones({left}, madeHuman().rig))
        if (!mesh.mesh.triangles.empty()) return std::move(mesh);
    }
  FAIL("no bone " << name);
  return {};
}

/// The one joint that moves a bone.
std::uint16_t jointOf(const SkinnedMesh& bone) {
  const std::uint16_t joint = bone.influences[0].joints[0];
  CHECK(std::ranges::all_of(bone.influences, [&](const SkinInfluence& influence) {
    return influence.joints[0] == joint && influence.weights == vec4(1, 0, 0, 0);
  }));
  return joint;
}

/// Whether two places of a bone are the same but for rounding: within the body two micrometres.
bool nearlyThere(const mat4& a, const mat4& b) {
  float most = 0;
  for (int k = 0; k < 4; ++k)
    for (int i = 0; i < 4; ++i) most = std::max(most, std::abs(a[k][i] - b[k][i]));
  return most < 1e-6f;
}

/// A joint and how far its bones' surfaces may be apart [m]: two layers of cartilage. Hip, knee and ankle:
/// the thickest means of Shepherd and Seedhom 1999, Ann Rheum Dis 58:27; the others: textbook figures.
struct Meeting {
  std::string a, b;
  float most;
};

std::vector<Meeting> contacts() {
  std::vector<Meeting> all = {{"thigh bone", "hip bone", 0.0040f},
                              {"thigh bone", "shin bone", 0.0051f},
                              {"knee cap", "thigh bone", 0.0051f},
                              {"ankle bone", "shin bone", 0.0033f},
                              {"ankle bone", "heel bone", 0.0033f},
                              {"upper arm bone", "shoulder blade", 0.0040f},
                              {"ulna", "upper arm bone", 0.0030f},
                              {"radius", "upper arm bone", 0.0030f},
                              {"radius", "ulna", 0.0038f},
                              {"scaphoid", "radius", 0.0030f},
                              {"lunate", "radius", 0.0030f},
                              {"metacarpal 1", "trapezium", 0.0030f},
                              {"metacarpal 2", "trapezoid", 0.0030f},
                              {"metacarpal 3", "capitate", 0.0030f},
                              {"metacarpal 4", "hamate", 0.0030f},
                              {"metacarpal 5", "hamate", 0.0030f},
                              {"proximal phalanx 1", "metacarpal 1", 0.0030f},
                              {"distal phalanx 1", "proximal phalanx 1", 0.0030f},
                              {"collar bone", "manubrium", 0.0050f},
                              {"shoulder blade", "collar bone", 0.0050f},
                              {"C1 vertebra", "skull", 0.0040f},
                              {"lower jaw", "skull", 0.0050f}};
  for (int i = 2; i <= 5; ++i) {
    const std::string ray = std::to_string(i);
    all.push_back({"proximal phalanx " + ray, "metacarpal " + ray, 0.0030f});
    all.push_back({"middle phalanx " + ray, "proximal phalanx " + ray, 0.0030f});
    all.push_back({"distal phalanx " + ray, "middle phalanx " + ray, 0.0030f});
  }
  for (int i = 1; i <= 5; ++i) {
    const std::string ray = std::to_string(i);
    all.push_back({"proximal phalanx of toe " + ray, "metatarsal " + ray, 0.0030f});
  }
  // Discs that belong to another joint than the vertebra above: the spine bends there.
  all.push_back({"disc C4-C5", "C4 vertebra", 0.0030f});
  all.push_back({"disc C7-T1", "C7 vertebra", 0.0030f});
  all.push_back({"disc T6-T7", "T6 vertebra", 0.0030f});
  all.push_back({"disc T12-L1", "T12 vertebra", 0.0030f});
  all.push_back({"disc L2-L3", "L2 vertebra", 0.0030f});
  all.push_back({"disc L5-S1", "L5 vertebra", 0.0030f});
  return all;
}

/// How far a joint's bones may come out of the skin [m]: blended joints draw it in at a fully bent elbow;
/// the collar bone's inner end comes nearer under arms that are raised high; elsewhere half of a polygon's
/// sagitta.
float boneAllowedOut(std::string_view joint) {
  return joint.ends_with("ForeArm") ? 0.006f : joint.ends_with("Shoulder") ? 0.0023f : 0.002f;
}

const Body& separated() {
  static const Body body = [] {
    Body made = madeBody();
    separateAxialBones(made);
    return made;
  }();
  return body;
}

/// Every few frames of each clip, with vertebrae and ribs where they are.
struct ClipPose {
  const Clip& clip;
  std::size_t frame;
  std::vector<mat4> matrices;
};

const std::vector<ClipPose>& clipPoses() {
  static const std::vector<ClipPose> poses = [] {
    const Body& body = separated();
    std::vector<vec4> places;
    for (const AxialBone& bone : body.axialBones) places.emplace_back(bone.place, 0.001f);
    const auto binding = bindPoints(body, places, "axial bones");
    REQUIRE(binding.ok());
    Deformer deformer(*binding);
    std::vector<vec4> moved(places.size());
    std::vector<ClipPose> made;
    for (const Clip& clip : body.clips)
      for (std::size_t frame = 0; frame < clip.frameCount(); frame += kFrameStep) {
        const Pose pose = samplePose(body.skeleton, clip, float(frame) / clip.framesPerSecond);
        std::vector<mat4> matrices = skinMatrices(body, pose);
        deformer.run(places, pose, moved);
        deformer.axialBones(body, std::span(matrices).subspan(body.skeleton.joints.size()));
        made.push_back({clip, frame, std::move(matrices)});
      }
    REQUIRE(!made.empty());
    return made;
  }();
  return poses;
}

}  // namespace

TEST_CASE("24 vertebrae and 24 ribs have motions of their own") {
  const Body& body = separated();
  std::set<std::uint16_t> own;
  for (const SkinInfluence& influence : body.meshes[1].influences)
    if (influence.joints[0] >= body.skeleton.joints.size()) own.insert(influence.joints[0]);
  CHECK(own.size() == 48);
  CHECK(std::ranges::count_if(body.axialBones,
                              [](const AxialBone& bone) { return bone.vertebra != kNone; }) == 24);
}

TEST_CASE("no motion brings a bone out of the skin") {
  std::map<std::string, std::array<float, 2>> worst;  // of a clip and joint: [m] out, frame
  std::vector<vec3> skin, bones;
  for (const auto& [clip, frame, matrices] : clipPoses()) {
    skinPositions(separated().meshes[0], matrices, skin);
    const TriangleMesh surface{skin, separated().meshes[0].mesh.triangles};
    const Solid solid(surface);
    skinPositions(separated().meshes[1], matrices, bones);
    std::vector<float> out(bones.size() / kBoneVertexStep, 0);
    parallelFor(out.size(), 256, [&](std::size_t i) {
      const vec3 p = bones[i * kBoneVertexStep];
      if (solid.winding(p) > 0) return;
      if (const auto place = solid.at(p, 0.1f)) out[i] = place->distance;
    });
    for (std::size_t i = 0; i < out.size(); ++i) {
      if (out[i] <= 0) continue;
      const std::uint32_t joint =
          separated().carrier(separated().meshes[1].influences[i * kBoneVertexStep].joints[0]);
      auto& entry = worst[clip.name + ": " + madeBody().skeleton.joints[joint].name];
      if (out[i] > entry[0]) entry = {out[i], float(frame)};
    }
  }
  for (const auto& [place, entry] : worst)
    if (entry[0] > 0.001f) MESSAGE(place << " " << 1e3f * entry[0] << " mm out in frame " << entry[1]);
  for (const auto& found : worst) {
    CAPTURE(found.first);
    CHECK(found.second[0] <= boneAllowedOut(found.first));
  }
}

TEST_CASE("the surfaces of a joint are never farther apart than cartilage") {
  for (const Meeting& contact : contacts()) {
    CAPTURE(contact.a);
    CAPTURE(contact.b);
    const SkinnedMesh a = boneNamed(contact.a), b = boneNamed(contact.b);
    const Solid solid(b.mesh);
    const std::uint16_t jointOfA = jointOf(a), jointOfB = jointOf(b);
    float widest = 0, frameOfWidest = 0;
    std::string clipOfWidest;
    mat4 last(0);
    for (const auto& [clip, frame, matrices] : clipPoses()) {
      // Bones are rigid: where the one has the other, who stays at rest. Most clips move few joints.
      const mat4 place = glm::inverse(matrices[jointOfB]) * matrices[jointOfA];
      if (nearlyThere(place, last)) continue;
      last = place;
      float gap = 0.05f;
      for (const vec3 p : a.mesh.positions)
        if (const auto at = solid.at(vec3(place * vec4(p, 1)), gap))
          gap = std::min(gap, std::max(at->distance, 0.0f));
      if (gap > widest) widest = gap, frameOfWidest = float(frame), clipOfWidest = clip.name;
    }
    if (widest > 0.5f * contact.most)
      MESSAGE(contact.a << ", " << contact.b << ": " << 1e3f * widest << " mm in frame " << frameOfWidest
                        << " of " << clipOfWidest);
    CHECK(widest <= contact.most);
  }
}
