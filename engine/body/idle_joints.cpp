#include "body/idle_joints.h"

#include <algorithm>

#include "body/humanoid.h"
#include "body/point_tree.h"
#include "body/rig.h"
#include "math/aabb.h"

namespace vasa {
namespace {

constexpr float kSamePlace = 1e-4f;  // of the skeleton's size

// All vertices of a body, and what each follows.
struct Vertices {
  PointCloud cloud;
  std::vector<const SkinInfluence*> influences;
  PointTree tree{3, cloud};

  explicit Vertices(const Body& body) {
    for (const SkinnedMesh& mesh : body.meshes)
      for (std::size_t v = 0; v < mesh.influences.size(); ++v)
        cloud.points.push_back(mesh.mesh.positions[v]), influences.push_back(&mesh.influences[v]);
    tree.buildIndex();
  }
  Vertices(const Vertices&) = delete;  // the tree looks at the cloud
  const SkinInfluence& nearest(vec3 place) const {
    std::uint32_t found = 0;
    float squared = 0;
    tree.knnSearch(&place.x, 1, &found, &squared);
    return *influences[found];
  }
};

bool follows(const SkinInfluence& influence, std::uint32_t joint) {
  for (int k = 0; k < 4; ++k)
    if (influence.weights[k] > 0 && influence.joints[std::size_t(k)] == joint) return true;
  return false;
}

// Whether a joint has vertices of its own, and whether anything at or behind it has.
struct Use {
  std::vector<bool> own, behind;

  explicit Use(const Body& body) : own(body.skeleton.joints.size()) {
    for (const SkinnedMesh& mesh : body.meshes)
      for (const SkinInfluence& influence : mesh.influences)
        for (int k = 0; k < 4; ++k)
          if (influence.weights[k] > 0) own[influence.joints[std::size_t(k)]] = true;
    behind = own;
    for (std::size_t j = own.size(); j-- > 0;)
      if (const JointId parent = body.skeleton.joints[j].parent; parent.valid() && behind[j])
        behind[parent.value] = true;
  }
};

// What stays, with all that it hangs on.
std::vector<bool> keptJoints(const Body& body, const std::vector<bool>& keep) {
  const auto& joints = body.skeleton.joints;
  const Use use(body);
  const auto moves = std::ranges::count(use.behind, true);
  if (moves == 0 || moves == std::ptrdiff_t(joints.size())) return std::vector<bool>(joints.size(), true);
  const Vertices vertices(body);
  Aabb box;
  for (const auto& joint : joints) box.add(vec3(joint.restWorld[3]));
  const float samePlace = kSamePlace * glm::length(box.extent());
  const auto tellsReach = [&](std::size_t j) {
    JointId above = joints[j].parent;
    while (above.valid() && !use.own[above.value]) above = joints[above.value].parent;
    const vec3 place(joints[j].restWorld[3]);
    return above.valid() && glm::distance(place, vec3(joints[above.value].restWorld[3])) > samePlace &&
           follows(vertices.nearest(place), above.value);
  };
  std::vector<bool> kept(joints.size());
  for (std::size_t j = joints.size(); j-- > 0;) {
    kept[j] = kept[j] || keep[j] || use.behind[j] || tellsReach(j);
    if (const JointId parent = joints[j].parent; parent.valid() && kept[j]) kept[parent.value] = true;
  }
  return kept;
}

}  // namespace

std::vector<std::string> leaveOutIdleJoints(Body& body, const std::vector<bool>& keep) {
  const std::vector<bool> kept = keptJoints(body, keep);
  std::vector<std::string> names;
  for (std::size_t j = 0; j < kept.size(); ++j)
    if (!kept[j]) names.push_back(body.skeleton.joints[j].name);
  if (names.empty()) return names;
  JointsKept left = keepJoints(body.skeleton, kept);
  // A skin of a part of a person, or one that is bound to nothing that ever moves, says nothing of which
  // joints count.
  const auto movesWhatStays = [&](const Clip& clip) {
    return std::ranges::any_of(clip.tracks, [&](const JointTracks& t) { return kept[t.joint.value]; });
  };
  const auto parts = [](const Skeleton& skeleton) { return humanoidKeys(rigOf(skeleton).parts.of); };
  if ((!body.clips.empty() && std::ranges::none_of(body.clips, movesWhatStays)) ||
      parts(left.skeleton) < parts(body.skeleton))
    return {};
  takeJoints(body, std::move(left));
  return names;
}

}  // namespace vasa
