#include "body/trunk_spread.h"

#include <algorithm>

#include "math/direction.h"

namespace vasa {
namespace {

constexpr float kMostLean = 0.6f;  // a body whose trunk bends high up alone is not folded there

// A trunk as bones: the joint that turns each, and where it begins; the hips' first.
struct Bones {
  std::vector<std::uint32_t> joints;
  std::vector<float> begins;

  explicit Bones(const Trunk& trunk) : joints{trunk.hips}, begins{0} {
    joints.insert(joints.end(), trunk.joints.begin(), trunk.joints.end());
    begins.insert(begins.end(), trunk.shares.begin(), trunk.shares.end());
  }
  float end(std::size_t i) const { return i + 1 < begins.size() ? begins[i + 1] : 1.0f; }
  float middle(std::size_t i) const { return 0.5f * (begins[i] + end(i)); }
};

TrunkShare shareAt(const Bones& bones, std::uint32_t joint, float place) {
  std::size_t high = 0;
  while (high + 1 < bones.joints.size() && bones.middle(high) < place) ++high;
  const std::size_t low = high > 0 ? high - 1 : 0;
  const float from = bones.middle(low), to = bones.middle(high);
  const float share = to > from ? std::clamp((place - from) / (to - from), 0.0f, 1.0f) : 1.0f;
  return {joint, bones.joints[low], bones.joints[high], share};
}

}  // namespace

TrunkSpread spreadTrunk(const Trunk& motion, const Trunk& body, std::span<const std::uint32_t> joints,
                        std::span<const vec3> places) {
  const Bones theirs(motion), own(body);
  TrunkSpread spread;
  for (std::size_t k = 0; k < own.joints.size(); ++k) {
    const std::uint32_t joint = own.joints[k];
    const bool takes = std::ranges::find(joints, joint) != joints.end();
    if (takes) spread.shares.push_back(shareAt(theirs, joint, own.middle(k)));
    const vec3 end = k + 1 < own.joints.size() ? places[own.joints[k + 1]] : body.end(places);
    for (std::size_t i = 0; i < theirs.joints.size(); ++i) {
      const float both = std::min(own.end(k), theirs.end(i)) - std::max(own.begins[k], theirs.begins[i]);
      if (both > 0)
        spread.pieces.push_back(
            {joint, theirs.joints[i], (end - places[joint]) * (both / (own.end(k) - own.begins[k])), takes});
    }
  }
  return spread;
}

void turnTrunk(const TrunkSpread& spread, std::span<const quat> motion, std::span<const quat> alignment,
               std::span<quat> turns) {
  for (const TrunkShare& own : spread.shares)
    turns[own.joint] =
        glm::normalize(glm::slerp(motion[own.low], motion[own.high], own.share) * alignment[own.joint]);
  vec3 now(0), wanted(0);
  for (const TrunkSpread::Piece& piece : spread.pieces) {
    (piece.takes ? now : wanted) += (piece.takes ? 1.0f : -1.0f) * (turns[piece.joint] * piece.way);
    wanted += motion[piece.source] * (alignment[piece.joint] * piece.way);
  }
  quat lean = turnBetween(now, wanted);
  if (const float angle = glm::angle(lean); angle > kMostLean)
    lean = glm::slerp(quat(1, 0, 0, 0), lean, kMostLean / angle);
  for (const TrunkShare& own : spread.shares) turns[own.joint] = glm::normalize(lean * turns[own.joint]);
}

}  // namespace vasa
