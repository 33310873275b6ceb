#include "body/copied_joints.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <unordered_map>

#include "core/ids.h"
#include "core/name_words.h"
#include "math/aabb.h"

namespace vasa {
namespace {

// Of the skeleton's size, and of an axis' length: rounding, not where somebody else stands.
constexpr float kSamePlace = 1e-3f;

// Joints of a name, from which on it is no name: a hundred called Bone.001 and so on, or not at all.
constexpr std::uint32_t kMostAlike = 64;

bool restAlike(const mat4& a, const mat4& b, float size) {
  for (int axis = 0; axis < 3; ++axis)
    if (!(glm::distance(a[axis], b[axis]) <= kSamePlace * glm::length(a[axis]))) return false;
  return glm::distance(a[3], b[3]) <= kSamePlace * size;
}

// Of a name without its numbers, which exporters give to doubles (Hips.001) or to every joint (Hips_07).
std::string lettersOf(const std::string& name) {
  std::string letters;
  for (const std::string& word : nameWords(name))
    if (word.find_first_not_of("0123456789") != word.npos) letters += word + ' ';
  return letters;
}

// Of each joint the one that it is, itself where it is no copy. Joints of one skin are never one: unnamed
// ones, or Bone.001 and Bone.002, in one place.
std::vector<std::uint32_t> originals(const Skeleton& skeleton, std::span<const std::uint32_t> skins) {
  const auto& joints = skeleton.joints;
  Aabb box;
  for (const auto& joint : joints) box.add(vec3(joint.restWorld[3]));
  const float size = joints.empty() ? 0 : glm::length(box.extent());
  std::vector<std::uint32_t> same(joints.size()), root(joints.size()), parents(joints.size());
  std::iota(same.begin(), same.end(), 0u);
  root = same;
  std::vector<std::string> letters;
  std::unordered_map<std::string, std::uint32_t> counts;
  for (const auto& joint : joints) ++counts[letters.emplace_back(lettersOf(joint.name))];
  std::unordered_map<std::string, std::multimap<float, std::uint32_t>> named;  // by x
  for (std::uint32_t j = 0; j < joints.size(); ++j) {
    // Below what stands at the top each branch counts as a tree: a node above several skeletons.
    const JointId parent = joints[j].parent;
    parents[j] = parent.value;
    if (parent.valid() && joints[parent.value].parent.valid()) root[j] = root[parent.value];
    if (counts[letters[j]] > kMostAlike) continue;
    auto& others = named[letters[j]];
    const mat4& rest = joints[j].restWorld;
    const float reach = kSamePlace * size;
    const auto end = others.upper_bound(rest[3].x + reach);
    const auto found = std::find_if(others.lower_bound(rest[3].x - reach), end, [&](const auto& other) {
      const std::uint32_t k = other.second;
      return skins[j] != kNone && skins[k] != kNone && skins[j] != skins[k] && root[k] != root[j] &&
             restAlike(joints[k].restWorld, rest, size) && !hangsOn(parents, j, k);
    });
    if (found != end)
      same[j] = found->second;
    else
      others.emplace(rest[3].x, j);
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

std::vector<JointId> uniteCopiedJoints(Body& body, std::span<const std::uint32_t> skins) {
  const std::vector<std::uint32_t> same = originals(body.skeleton, skins);
  std::vector<bool> kept(same.size());
  for (std::uint32_t j = 0; j < same.size(); ++j) kept[j] = same[j] == j;
  for (auto& joint : body.skeleton.joints)
    if (joint.parent.valid()) joint.parent = {same[joint.parent.value]};
  for (Clip& clip : body.clips) moveTracks(clip, same);
  JointsKept left = keepJoints(body.skeleton, kept);
  for (std::uint32_t j = 0; j < same.size(); ++j) left.now[j] = left.now[same[j]];
  takeJoints(body, left);
  return std::move(left.now);
}

}  // namespace vasa
