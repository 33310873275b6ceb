#pragma once
#include <span>
#include <vector>

#include "body/body.h"
#include "body/spine.h"

namespace vasa {

/// How far a place is from what each joint moves: the evidence for which part of the body it belongs to.
///
/// Where the body has meshes that move rigidly by parts (bones, heart) along half of its links' length or
/// more, these are the evidence, and joints without a bone of their own have none. Otherwise (a smooth skin
/// with rigid eyes, say) each joint's links stand for its bones; a tip's link is taken to go on in the
/// direction of the one before it. Joints above all that meshes follow (a root on the floor) have none.
class BoneField {
 public:
  static constexpr float kFar = 1e9f;  ///< distance to what does not exist

  BoneField(const Body& body, const SpineSet& spines);
  ~BoneField();
  BoneField(const BoneField&) = delete;

  /// Distance [m] to each joint's own bones, a mean over the nearest vertices so that it varies smoothly;
  /// beyond reach() it is the distance to their box. @param distances  one a joint
  void distances(vec3 p, std::span<float> distances) const;

  bool fromMeshes() const { return fromMeshes_; }
  float reach() const { return reach_; }

 private:
  struct Part;
  std::vector<Part> parts_;  // one a joint
  float reach_ = 0;
  bool fromMeshes_ = false;
};

/// What carries a vertex alone, as its influence names it; kNone where several do.
std::uint32_t soleCarrier(const SkinInfluence& influence);

/// A mesh whose vertices each follow one joint, nearly all of them.
bool movesByRigidParts(const SkinnedMesh& mesh);

}  // namespace vasa
