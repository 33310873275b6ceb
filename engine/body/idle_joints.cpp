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

  explicit Vertices(const Body& body) {
    for (const SkinnedMesh& mesh : body.meshes)
      for (std::size_t v = 0; v < mesh.influences.size(); ++v)
        cloud.points.push_back(mesh.mesh.positions[v]), influences.push_back(&mesh.influences[v]);
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

  Use(const Vertices& vertices, const Skeleton& skeleton) : own(skeleton.joints.size()) {
    for (const SkinInfluence* influence : vertices.influences)
      for (int k = 0; k < 4; ++k)
        if (influence->weights[k] > 0) own[influence->joints[std::size_t(k)]] = true;
    behind = own;
    for (std::size_t j = own.size(); j-- > 0;)
      if (const JointId parent = skeleton.joints[j].parent; parent.valid() && behind[j])
        behind[parent.value] = true;
  }
};

std::vector<bool> idleJoints(const Body& body, const std::vector<bool>& keep) {
  const auto& joints = body.skeleton.joints;
  const Vertices vertices(body);
  std::vector<bool> idle(joints.size(), false);
  if (vertices.cloud.points.empty()) return idle;
  const Use use(vertices, body.skeleton);
  PointTree tree(3, vertices.cloud);
  tree.buildIndex();
  Aabb box;
  for (const auto& joint : joints) box.add(vec3(joint.restWorld[3]));
  const float samePlace = kSamePlace * glm::length(box.extent());
  const auto tellsReach = [&](std::size_t j) {
    JointId above = joints[j].parent;
    while (above.valid() && !use.own[above.value]) above = joints[above.value].parent;
    const vec3 place(joints[j].restWorld[3]);
    if (!above.valid() || glm::distance(place, vec3(joints[above.value].restWorld[3])) <= samePlace)
      return false;
    std::uint32_t nearest = 0;
    float squared = 0;
    return tree.knnSearch(&place.x, 1, &nearest, &squared) == 1 &&
           follows(*vertices.influences[nearest], above.value);
  };
  for (std::size_t j = 0; j < joints.size(); ++j) idle[j] = !use.behind[j] && !tellsReach(j);
  // What stays keeps all that it hangs on.
  for (std::size_t j = joints.size(); j-- > 0;) {
    if (keep[j]) idle[j] = false;
    if (const JointId parent = joints[j].parent; parent.valid() && !idle[j]) idle[parent.value] = false;
  }
  return idle;
}

}  // namespace

std::vector<std::string> leaveOutIdleJoints(Body& body, const std::vector<bool>& keep) {
  const std::vector<bool> idle = idleJoints(body, keep);
  std::vector<std::string> names;
  std::vector<JointId> now(idle.size());  // invalid where it goes
  Skeleton left;
  left.rootTransform = body.skeleton.rootTransform;
  for (std::size_t j = 0; j < idle.size(); ++j) {
    const Skeleton::Joint& joint = body.skeleton.joints[j];
    if (idle[j]) {
      names.push_back(joint.name);
      continue;
    }
    now[j] = {std::uint32_t(left.joints.size())};
    left.joints.push_back(joint);
    if (joint.parent.valid()) left.joints.back().parent = now[joint.parent.value];
  }
  if (names.empty()) return names;
  // A skin of a part of a person, or one that is bound to nothing that ever moves, says nothing of which
  // joints count.
  const auto movesWhatStays = [&](const Clip& clip) {
    return std::ranges::any_of(clip.tracks, [&](const JointTracks& t) { return !idle[t.joint.value]; });
  };
  const auto parts = [](const Skeleton& skeleton) { return humanoidKeys(rigOf(skeleton).parts.of); };
  if ((!body.clips.empty() && std::ranges::none_of(body.clips, movesWhatStays)) ||
      parts(left) < parts(body.skeleton))
    return {};
  body.skeleton = std::move(left);
  for (SkinnedMesh& mesh : body.meshes)
    for (SkinInfluence& influence : mesh.influences)
      for (int k = 0; k < 4; ++k) {
        std::uint16_t& joint = influence.joints[std::size_t(k)];
        joint = influence.weights[k] > 0 ? std::uint16_t(now[joint].value) : std::uint16_t(0);
      }
  for (Clip& clip : body.clips) {
    std::erase_if(clip.tracks, [&](const JointTracks& track) { return idle[track.joint.value]; });
    for (JointTracks& track : clip.tracks) track.joint = now[track.joint.value];
  }
  return names;
}

}  // namespace vasa
