#pragma once
#include <vector>

#include "body/body.h"
#include "core/result.h"

namespace vasa::plate {

enum class BodyPart : std::uint8_t {
  other,
  head,
  neck,
  thorax,
  abdomen,
  shoulder,
  upperArm,
  lowerArm,
  hand,
  upperLeg,
  lowerLeg,
  foot
};

/// A part and its side: -1 right, 0 in the middle, 1 left.
struct SidedPart {
  BodyPart part = BodyPart::other;
  int side = 0;
  bool operator==(const SidedPart&) const = default;
};

/// The part of the body that each joint moves, by the joints' names (body/humanoid.h); a joint that is not
/// known goes with its parent. Fails with badInput where the joints are not recognised as a person's.
Result<std::vector<SidedPart>> partsOfJoints(const Body& body);

/// Of each of a mesh's vertices the joint that moves it most.
std::vector<std::uint16_t> mainJoints(const SkinnedMesh& mesh);

}  // namespace vasa::plate
