#pragma once
#include <memory>
#include <span>

#include "body/body.h"
#include "body/spine.h"

namespace vasa {

/// The mesh that envelops the body: the one that is named skin (body/skin_recognition.h), else the largest
/// one that does not move by rigid parts, where there is more than one joint; null if there is none.
const SkinnedMesh* skinOf(const Body& body);

/// How the skin around a place moves: evidence for which part of the body the flesh there belongs to. Bones
/// alone do not tell that between two of them; whoever rigged the skin did.
class SkinField {
 public:
  explicit SkinField(const Body& body);
  ~SkinField();
  SkinField(const SkinField&) = delete;

  /// Means over the nearest vertices that face away from p, so that the skin of an arm says nothing about the
  /// chest beside it.
  /// @param shares  one a joint: the share of the skin's weights that the joint and those behind it have
  /// @return distance [m] to that skin; BoneField::kFar where there is none, and then shares are 0
  float shares(const SpineSet& spines, vec3 p, std::span<float> shares) const;

  /// Whether any skin follows the joint itself.
  bool follows(JointId joint) const;

 private:
  struct Vertices;
  std::unique_ptr<Vertices> vertices_;
};

}  // namespace vasa
