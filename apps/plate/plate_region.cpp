#include "plate/plate_region.h"

#include <algorithm>
#include <optional>

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
  bool byBones = false;  ///< the picture holds the part's bones, not all of its skin
  /// Of one of a pair of limbs: the joints whose line stands upright; the same one twice: the world's up.
  std::optional<std::pair<BodyPart, BodyPart>> axis;
};

const std::vector<Region>& regions() {
  // clang-format off
  static const std::vector<Region> all{
      {.name = "front", .title = "Vessels of the body", .view = "Anterior view", .towards = {0, 0, 1}},
      {.name = "back", .title = "Vessels of the body", .view = "Posterior view", .towards = {0, 0, -1}},
      {.name = "head", .title = "Vessels of the head and neck", .view = "Right anterolateral view",
       .framed = {head, neck}, .beside = {shoulder, thorax, upperArm}, .towards = {-1, 0, 0.45f}},
      {.name = "thorax", .title = "Vessels of the thorax", .view = "Anterior view", .framed = {thorax, shoulder},
       .beside = {neck, head, abdomen, upperArm}, .towards = {0, 0, 1}, .byBones = true},
      {.name = "abdomen", .title = "Vessels of the abdomen and pelvis", .view = "Anterior view",
       .framed = {abdomen}, .beside = {thorax, upperLeg}, .towards = {0, 0, 1}},
      {.name = "arm", .title = "Vessels of the arm", .view = "anterior view",
       .framed = {upperArm, lowerArm, hand}, .beside = {shoulder, thorax}, .towards = {0, 0, 1},
       .axis = {{upperArm, hand}}},
      {.name = "hand", .title = "Vessels of the hand", .view = "palmar view", .framed = {hand},
       .beside = {lowerArm}, .towards = {0, 0, 1}, .axis = {{lowerArm, hand}}},
      {.name = "leg", .title = "Vessels of the leg", .view = "anterior view",
       .framed = {upperLeg, lowerLeg, foot}, .beside = {abdomen}, .towards = {0, 0, 1}, .axis = {{upperLeg, foot}}},
      {.name = "foot", .title = "Vessels of the foot", .view = "dorsal view", .framed = {foot},
       .beside = {lowerLeg}, .towards = {0, 0.8f, 0.6f}, .axis = {{foot, foot}}},
  };
  // clang-format on
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
  bool byBones() const { return region_.byBones; }
  /// The first joint of a part.
  std::optional<std::uint32_t> first(BodyPart part) const {
    for (std::uint32_t j = 0; j < parts_.size(); ++j)
      if (parts_[j].part == part && ofSide(j)) return j;
    return std::nullopt;
  }

 private:
  bool ofSide(std::uint32_t joint) const {
    return !region_.axis || parts_[joint].side == side_ || parts_[joint].side == 0;
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
    const auto joints = mainJoints(mesh);
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
      if (choice->framed(joint) && !choice->byBones())
        subject.framed.emplace_back(frame.points()[vessels[v].firstPoint + k]);
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
  if (region->axis) subject.subtitle = std::string(side < 0 ? "Right, " : "Left, ") + region->view;
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
  if (region->axis && region->axis->first != region->axis->second)
    if (const auto from = choice->first(region->axis->first), to = choice->first(region->axis->second);
        from && to)
      subject.up = vec3(frame.pose().world[*from][3]) - vec3(frame.pose().world[*to][3]);
  return subject;
}

}  // namespace vasa::plate
