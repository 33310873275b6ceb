#include "body/copied_joints.h"

#include <algorithm>
#include <numeric>
#include <unordered_map>

#include "math/aabb.h"

namespace vasa {
namespace {

// Of the skeleton's size, and of an axis' length: rounding, not where somebody else stands.
constexpr float kSamePlace = 1e-3f;

bool restAlike(const mat4& a, const mat4& b, float size) {
  for (int axis = 0; axis < 3; ++axis)
    if (!(glm::distance(a[axis], b[axis]) <= kSamePlace * glm::length(a[axis]))) return false;
  return glm::distance(a[3], b[3]) <= kSamePlace * size;
}

// Of each joint the one that it is, itself where it is no copy.
std::vector<std::uint32_t> originals(const Skeleton& skeleton) {
  const auto& joints = skeleton.joints;
  Aabb box;
  for (const auto& joint : joints) box.add(vec3(joint.restWorld[3]));
  const float size = joints.empty() ? 0 : glm::length(box.extent());
  std::vector<std::uint32_t> same(joints.size()), root(joints.size());
  std::iota(same.begin(), same.end(), 0u);
  root = same;
  std::unordered_map<std::string, std::uint32_t> first;
  for (std::uint32_t j = 0; j < joints.size(); ++j) {
    if (const JointId parent = joints[j].parent; parent.valid()) root[j] = root[parent.value];
    const auto [known, isNew] = first.try_emplace(joints[j].name, j);
    const std::uint32_t other = known->second;
    if (!isNew && root[other] != root[j] && restAlike(joints[other].restWorld, joints[j].restWorld, size))
      same[j] = other;
  }
  return same;
}

void moveTracks(Clip& clip, const std::vector<std::uint32_t>& same) {
  std::vector<bool> driven(same.size(), false);
  for (const JointTracks& track : clip.tracks) driven[track.joint.value] = true;
  std::erase_if(clip.tracks, [&](JointTracks& track) {
    const std::uint32_t joint = track.joint.value, original = same[joint];
    if (original == joint) return false;
    if (driven[original]) return true;
    driven[original] = true;
    track.joint = {original};
    return false;
  });
  std::ranges::sort(clip.tracks, {}, [](const JointTracks& track) { return track.joint.value; });
}

}  // namespace

std::size_t uniteCopiedJoints(Body& body) {
  const std::vector<std::uint32_t> same = originals(body.skeleton);
  std::vector<bool> kept(same.size());
  for (std::uint32_t j = 0; j < same.size(); ++j) kept[j] = same[j] == j;
  const auto copies = std::size_t(std::ranges::count(kept, false));
  if (copies == 0) return 0;
  for (auto& joint : body.skeleton.joints)
    if (joint.parent.valid()) joint.parent = {same[joint.parent.value]};
  for (Clip& clip : body.clips) moveTracks(clip, same);
  auto [skeleton, now] = keepJoints(body.skeleton, kept);
  body.skeleton = std::move(skeleton);
  for (SkinnedMesh& mesh : body.meshes)
    for (SkinInfluence& influence : mesh.influences)
      for (std::uint16_t& joint : influence.joints) joint = std::uint16_t(now[same[joint]].value);
  for (Clip& clip : body.clips)
    for (JointTracks& track : clip.tracks) track.joint = now[track.joint.value];
  return copies;
}

}  // namespace vasa
