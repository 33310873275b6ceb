#include "plate/plate_region.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <optional>

#include "atlas/body_region.h"
#include "body/mesh_role.h"
#include "body/rig.h"
#include "body/skinning.h"
#include "plate/braincase.h"

namespace vasa::plate {
namespace {

using atlas::BodyPart, atlas::BodyRegion;
using enum BodyPart;

struct Region {
  std::string_view name;
  const char *title, *view;
  std::vector<BodyPart> framed;  ///< what the picture holds; none: everything
  std::vector<BodyPart> beside;  ///< drawn, too, as far as the picture reaches
  vec3 towards, up{0, 1, 0};
  bool byBones = false;    ///< the picture holds the part's bones, not all of its skin
  bool braincase = false;  ///< only what the part's bones enclose, without them
  /// Of one of a pair of limbs: the joints whose line stands upright; the same one twice: the world's up.
  std::optional<std::pair<BodyPart, BodyPart>> axis;
};

const std::vector<Region>& regions() {
  // clang-format off
  static const std::vector<Region> all{
      {.name = "front", .title = "Vessels of the body", .view = "Anterior view", .towards = {0, 0, 1}},
      {.name = "back", .title = "Vessels of the body", .view = "Posterior view", .towards = {0, 0, -1}},
      {.name = "head", .title = "Vessels of the head and neck", .view = "Right anterolateral view",
       .framed = {head, neck}, .beside = {shoulder, chest, upperArm}, .towards = {-1, 0, 0.45f}},
      {.name = "brain", .title = "Vessels of the brain", .view = "Inferior view", .framed = {head},
       .towards = {0, -1, 0}, .up = {0, 0, 1}, .braincase = true},
      {.name = "thorax", .title = "Vessels of the thorax", .view = "Anterior view", .framed = {chest, shoulder},
       .beside = {neck, head, abdomen, pelvis, upperArm}, .towards = {0, 0, 1}, .byBones = true},
      {.name = "abdomen", .title = "Vessels of the abdomen and pelvis", .view = "Anterior view",
       .framed = {abdomen, pelvis}, .beside = {chest, thigh}, .towards = {0, 0, 1}},
      {.name = "arm", .title = "Vessels of the arm", .view = "anterior view",
       .framed = {upperArm, forearm, hand}, .beside = {shoulder, chest}, .towards = {0, 0, 1},
       .axis = {{upperArm, hand}}},
      {.name = "hand", .title = "Vessels of the hand", .view = "palmar view", .framed = {hand},
       .beside = {forearm}, .towards = {0, 0, 1}, .axis = {{forearm, hand}}},
      {.name = "leg", .title = "Vessels of the leg", .view = "anterior view",
       .framed = {thigh, leg, foot}, .beside = {abdomen, pelvis}, .towards = {0, 0, 1}, .axis = {{thigh, foot}}},
      {.name = "foot", .title = "Vessels of the foot", .view = "dorsal view", .framed = {foot},
       .beside = {leg}, .towards = {0, 0.8f, 0.6f}, .axis = {{foot, foot}}},
  };
  // clang-format on
  return all;
}

constexpr float kFacing = 0.52f;    // [rad] that a front may be beside +Z and be taken for it: 30 degrees
constexpr float kOwnShare = 0.25f;  // of a vessel's points in a region that has it on its page

bool among(const std::vector<BodyPart>& parts, BodyPart part) {
  return std::ranges::find(parts, part) != parts.end();
}

class Choice {
 public:
  Choice(const Region& region, int side, const Skeleton& skeleton)
      : region_(region), side_(side), finder_(skeleton) {
    for (std::uint32_t j = 0; j < skeleton.joints.size(); ++j) parts_.push_back(finder_.of(JointId{j}));
  }

  bool framed(std::uint32_t joint) const { return framed(parts_[joint]); }
  bool drawn(std::uint32_t joint) const {
    return framed(joint) || (ofSide(parts_[joint]) && among(region_.beside, parts_[joint].part));
  }
  /// Whether the page is of a place at rest that goes with a joint: the thorax ends at the diaphragm, though
  /// what lies under it goes with the ribs.
  bool isOf(std::uint32_t joint, vec3 place) const { return framed(finder_.of(JointId{joint}, place)); }
  bool byBones() const { return region_.byBones; }
  /// The first joint of a part.
  std::optional<std::uint32_t> first(BodyPart part) const {
    for (std::uint32_t j = 0; j < parts_.size(); ++j)
      if (parts_[j].part == part && ofSide(parts_[j])) return j;
    return std::nullopt;
  }

 private:
  bool framed(BodyRegion part) const { return ofSide(part) && among(region_.framed, part.part); }
  bool ofSide(BodyRegion part) const { return !region_.axis || part.side == side_ || part.side == 0; }

  const Region& region_;
  int side_;
  atlas::RegionFinder finder_;
  std::vector<BodyRegion> parts_;
};

// What the bones of a part enclose: of its other meshes those that lie there by half, and the vessels that
// come there, cut off below it all. The picture holds what lies within.
Result<void> takeEnclosed(PlateSubject& subject, const Scene& scene, const FrameMaker& frame,
                          const Choice& choice) {
  std::vector<vec3> bones;
  std::vector<uvec3> triangles;
  const auto take = [&](const SkinnedMesh& mesh) {
    const auto joints = mainJoints(scene.body, mesh);
    const std::uint32_t first = std::uint32_t(bones.size());
    bones.insert(bones.end(), mesh.mesh.positions.begin(), mesh.mesh.positions.end());
    for (const uvec3& t : mesh.mesh.triangles)
      if (choice.framed(joints[t.x])) triangles.push_back(t + first);
  };
  for (const SkinnedMesh& mesh : scene.body.meshes)
    if (roleNamed(mesh.name) == MeshRole::bones) take(mesh);
  if (triangles.empty())
    return badInput(scene.body.name +
                    ": it has no bones of the head, so what lies in its skull is not known; "
                    "choose head");

  const std::vector<mat4> matrices(frame.jointMatrices().begin(), frame.jointMatrices().end());
  const Braincase braincase(bones, triangles);
  const auto holds = [&](vec3 place) { return braincase.holds(place); };
  for (const SkinnedMesh& mesh : scene.body.meshes) {
    const MeshRole role = roleNamed(mesh.name);
    if (role == MeshRole::bones || role == MeshRole::skin) continue;
    if (2 * std::size_t(std::ranges::count_if(mesh.mesh.positions, holds)) < mesh.mesh.positions.size())
      continue;
    std::vector<vec3> positions;
    skinPositions(mesh, matrices, positions);
    subject.framed.insert(subject.framed.end(), positions.begin(), positions.end());
    subject.meshes.push_back(mesh);
  }

  for (const Vessel& vessel : scene.network.vessels()) {
    std::uint32_t inside = 0;
    for (std::uint32_t k = vessel.firstPoint; k < vessel.firstPoint + vessel.pointCount; ++k)
      if (holds(vec3(scene.network.points()[k]))) ++inside, subject.framed.emplace_back(frame.points()[k]);
    subject.vessels.push_back(inside > 0);
  }
  subject.own = subject.vessels;
  Aabb box;
  for (const vec3& place : subject.framed) box.add(place);
  if (!subject.framed.empty()) subject.cut = vec4(0, 1, 0, -box.low.y);
  return {};
}

// A mesh's triangles of which no corner belongs to what is not drawn.
SkinnedMesh drawnPart(const SkinnedMesh& mesh, std::span<const std::uint16_t> joints, const Choice& choice) {
  SkinnedMesh part = mesh;
  std::erase_if(part.mesh.triangles, [&](const uvec3& t) {
    return !choice.drawn(joints[t.x]) || !choice.drawn(joints[t.y]) || !choice.drawn(joints[t.z]);
  });
  return part;
}

// What tells how far a part reaches: its skin, or its bones; other meshes where there is no such.
std::vector<const SkinnedMesh*> framingMeshes(const Body& body, bool byBones) {
  std::vector<const SkinnedMesh*> meant, all;
  for (const SkinnedMesh& mesh : body.meshes) {
    all.push_back(&mesh);
    if (roleNamed(mesh.name) == (byBones ? MeshRole::bones : MeshRole::skin)) meant.push_back(&mesh);
  }
  return meant.empty() ? all : meant;
}

void takeMeshes(PlateSubject& subject, const Scene& scene, const FrameMaker& frame, const Choice* choice) {
  const auto framing = framingMeshes(scene.body, choice && choice->byBones());
  const std::vector<mat4> matrices(frame.jointMatrices().begin(), frame.jointMatrices().end());
  for (const SkinnedMesh& mesh : scene.body.meshes) {
    const auto joints = mainJoints(scene.body, mesh);
    SkinnedMesh part = choice ? drawnPart(mesh, joints, *choice) : mesh;
    if (part.mesh.triangles.empty()) continue;
    if (std::ranges::find(framing, &mesh) != framing.end()) {
      std::vector<vec3> positions;
      skinPositions(mesh, matrices, positions);
      for (std::size_t i = 0; i < positions.size(); ++i)
        if (!choice || choice->framed(joints[i])) subject.framed.push_back(positions[i]);
    }
    subject.meshes.push_back(std::move(part));
  }
}

void takeVessels(PlateSubject& subject, const Scene& scene, const FrameMaker& frame, const Choice* choice) {
  const auto vessels = scene.network.vessels();
  subject.vessels.assign(vessels.size(), 1);
  subject.own = subject.vessels;
  if (!choice) {
    // Nothing may lie around the vessels: they are held with their walls.
    for (const vec4& point : frame.points())
      for (int axis = 0; axis < 3; ++axis)
        for (const float side : {-1.0f, 1.0f}) {
          vec3 wall(point);
          wall[axis] += side * point.w;
          subject.framed.push_back(wall);
        }
    return;
  }
  const auto stations = mainStations(scene.binding);
  for (std::size_t v = 0; v < vessels.size(); ++v) {
    std::uint32_t drawn = 0, own = 0;
    for (std::uint32_t k = 0; k < vessels[v].pointCount; ++k) {
      const std::uint32_t point = vessels[v].firstPoint + k, joint = stations[point].joint.value;
      drawn += choice->drawn(joint);
      own += choice->isOf(joint, vec3(scene.network.points()[point]));
      if (choice->framed(joint) && !choice->byBones()) subject.framed.emplace_back(frame.points()[point]);
    }
    subject.vessels[v] = drawn > 0;
    subject.own[v] = float(own) >= kOwnShare * float(vessels[v].pointCount);
  }
}

}  // namespace

mat3 facing(const Skeleton& skeleton) {
  const auto trunk = trunkOf(rigOf(skeleton), {"UpperLeg", "UpperArm"});
  if (!trunk) return mat3(1);
  const vec3 front = (*trunk)[2];
  const float angle = std::atan2(front.x, front.z);
  if (std::hypot(front.x, front.z) < 0.5f || std::abs(angle) < kFacing) return mat3(1);
  return mat3(glm::rotate(mat4(1), angle, vec3(0, 1, 0)));
}

std::vector<std::uint16_t> mainJoints(const Body& body, const SkinnedMesh& mesh) {
  std::vector<std::uint16_t> joints;
  joints.reserve(mesh.influences.size());
  for (const SkinInfluence& influence : mesh.influences)
    joints.push_back(std::uint16_t(body.carrier(influence.joints[influence.heaviest()])));
  return joints;
}

Result<void> checkPlateName(std::string_view name) {
  std::string names;
  for (const Region& region : regions()) {
    if (region.name == name) return {};
    if (!names.empty()) names += ", ";
    names += region.name;
  }
  return Error{Fault::usage, "there is no plate '" + std::string(name) + "'; choose " + names};
}

Result<PlateSubject> plateSubject(const Scene& scene, const FrameMaker& frame, std::string_view name,
                                  int side) {
  if (auto known = checkPlateName(name); !known) return known.error();
  const auto region = std::ranges::find(regions(), name, &Region::name);
  const mat3 turn = facing(scene.body.skeleton);
  PlateSubject subject{.title = region->title,
                       .subtitle = region->view,
                       .towards = turn * region->towards,
                       .up = turn * region->up,
                       .turn = turn};
  if (region->axis) subject.subtitle = std::string(side < 0 ? "Right, " : "Left, ") + region->view;
  std::optional<Choice> choice;
  if (!region->framed.empty()) {
    if (!atlas::RegionFinder(scene.body.skeleton).knowsPerson())
      return badInput(scene.body.name +
                      ": its joints are not all recognised as a person's, so its regions are not known; "
                      "choose front or back");
    choice.emplace(*region, side, scene.body.skeleton);
  }
  if (region->braincase) {
    if (auto taken = takeEnclosed(subject, scene, frame, *choice); !taken) return taken.error();
  } else {
    takeMeshes(subject, scene, frame, choice ? &*choice : nullptr);
    takeVessels(subject, scene, frame, choice ? &*choice : nullptr);
  }
  if (subject.framed.empty())
    return badInput(scene.body.name + ": nothing of it belongs to the plate '" + std::string(name) + "'");
  if (region->axis && region->axis->first != region->axis->second)
    if (const auto from = choice->first(region->axis->first), to = choice->first(region->axis->second);
        from && to) {
      subject.axial = true;
      subject.up = vec3(frame.pose().world[*from][3]) - vec3(frame.pose().world[*to][3]);
    }
  return subject;
}

}  // namespace vasa::plate
