#include "plate/plate_region.h"

#include <algorithm>
#include <array>

#include "body/mesh_role.h"
#include "body/skinning.h"

namespace vasa::plate {
namespace {

using enum BodyPart;

struct Region {
  std::string_view name;
  const char *title, *view;
  std::vector<BodyPart> framed;  ///< what the picture holds; none: everything
  std::vector<BodyPart> beside;  ///< drawn, too, as far as the picture reaches
  vec3 towards;
  bool sided;         ///< one of a pair of limbs
  BodyPart from, to;  ///< ends of the axis that stands upright, where it is sided
};

const std::vector<Region>& regions() {
  static const std::vector<Region> all{
      {"front", "Vessels of the body", "Anterior view", {}, {}, {0, 0, 1}, false, other, other},
      {"back", "Vessels of the body", "Posterior view", {}, {}, {0, 0, -1}, false, other, other},
      {"head",
       "Vessels of the head and neck",
       "Right lateral view",
       {head, neck},
       {shoulder, thorax, upperArm},
       {-1, 0, 0.45f},
       false,
       other,
       other},
      {"thorax",
       "Vessels of the thorax",
       "Anterior view",
       {thorax, shoulder},
       {neck, head, abdomen, upperArm},
       {0, 0, 1},
       false,
       other,
       other},
      {"abdomen",
       "Vessels of the abdomen and pelvis",
       "Anterior view",
       {abdomen},
       {thorax, upperLeg},
       {0, 0, 1},
       false,
       other,
       other},
      {"arm",
       "Vessels of the arm",
       "anterior view",
       {upperArm, lowerArm, hand},
       {shoulder},
       {0, 0, 1},
       true,
       upperArm,
       hand},
      {"hand", "Vessels of the hand", "palmar view", {hand}, {lowerArm}, {0, 0, 1}, true, lowerArm, hand},
      {"leg",
       "Vessels of the leg",
       "anterior view",
       {upperLeg, lowerLeg, foot},
       {},
       {0, 0, 1},
       true,
       upperLeg,
       foot},
      {"foot", "Vessels of the foot", "dorsal view", {foot}, {lowerLeg}, {0, 0.8f, 0.6f}, true, other, other},
  };
  return all;
}

constexpr float kOwnShare = 0.25f;  // of a vessel's points in a region that has it on its page

bool among(const std::vector<BodyPart>& parts, BodyPart part) {
  return std::ranges::find(parts, part) != parts.end();
}

class Choice {
 public:
  Choice(const Region& region, int side, std::vector<SidedPart> parts)
      : region_(region), side_(side), parts_(std::move(parts)) {}

  bool framed(std::uint32_t joint) const {
    return ofSide(joint) && among(region_.framed, parts_[joint].part);
  }
  bool drawn(std::uint32_t joint) const {
    return framed(joint) || (ofSide(joint) && among(region_.beside, parts_[joint].part));
  }
  /// The first joint of a part.
  std::optional<std::uint32_t> first(BodyPart part) const {
    for (std::uint32_t j = 0; j < parts_.size(); ++j)
      if (parts_[j].part == part && ofSide(j)) return j;
    return std::nullopt;
  }

 private:
  bool ofSide(std::uint32_t joint) const {
    return !region_.sided || parts_[joint].side == side_ || parts_[joint].side == 0;
  }
  const Region& region_;
  int side_;
  std::vector<SidedPart> parts_;
};

// A mesh's triangles of which no corner belongs to what is not drawn.
SkinnedMesh drawnPart(const SkinnedMesh& mesh, std::span<const std::uint16_t> joints, const Choice& choice) {
  SkinnedMesh part = mesh;
  std::erase_if(part.mesh.triangles, [&](const uvec3& t) {
    return !choice.drawn(joints[t.x]) || !choice.drawn(joints[t.y]) || !choice.drawn(joints[t.z]);
  });
  return part;
}

// Skin tells how far a part reaches; a body without one is framed by its bones.
bool frames(const SkinnedMesh& mesh, bool hasSkin) {
  return !hasSkin || roleNamed(mesh.name) == MeshRole::skin;
}

void takeMeshes(PlateSubject& subject, const Scene& scene, const FrameMaker& frame, const Choice* choice) {
  const bool hasSkin = std::ranges::any_of(
      scene.body.meshes, [](const SkinnedMesh& mesh) { return roleNamed(mesh.name) == MeshRole::skin; });
  const std::vector<mat4> matrices(frame.jointMatrices().begin(), frame.jointMatrices().end());
  for (const SkinnedMesh& mesh : scene.body.meshes) {
    const auto joints = mainJoints(mesh);
    SkinnedMesh part = choice ? drawnPart(mesh, joints, *choice) : mesh;
    if (part.mesh.triangles.empty()) continue;
    if (frames(mesh, hasSkin)) {
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
    for (const vec4& point : frame.points()) subject.framed.emplace_back(point);
    return;
  }
  const auto stations = mainStations(scene.binding);
  for (std::size_t v = 0; v < vessels.size(); ++v) {
    std::uint32_t drawn = 0, framed = 0;
    for (std::uint32_t k = 0; k < vessels[v].pointCount; ++k) {
      const std::uint32_t joint = stations[vessels[v].firstPoint + k].joint.value;
      drawn += choice->drawn(joint);
      framed += choice->framed(joint);
      if (choice->framed(joint)) subject.framed.emplace_back(frame.points()[vessels[v].firstPoint + k]);
    }
    subject.vessels[v] = drawn > 0;
    subject.own[v] = float(framed) >= kOwnShare * float(vessels[v].pointCount);
  }
}

}  // namespace

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
  PlateSubject subject{.title = region->title, .subtitle = region->view, .towards = region->towards};
  if (region->sided) subject.subtitle = std::string(side < 0 ? "Right, " : "Left, ") + region->view;
  std::optional<Choice> choice;
  if (!region->framed.empty()) {
    auto parts = partsOfJoints(scene.body);
    if (!parts) return parts.error();
    choice.emplace(*region, side, std::move(*parts));
  }
  takeMeshes(subject, scene, frame, choice ? &*choice : nullptr);
  takeVessels(subject, scene, frame, choice ? &*choice : nullptr);
  if (subject.framed.empty())
    return badInput(scene.body.name + ": nothing of it belongs to the plate '" + std::string(name) + "'");
  if (choice && region->from != other)
    if (const auto from = choice->first(region->from), to = choice->first(region->to); from && to)
      subject.up = vec3(frame.pose().world[*from][3]) - vec3(frame.pose().world[*to][3]);
  return subject;
}

}  // namespace vasa::plate
