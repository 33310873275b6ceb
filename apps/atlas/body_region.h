#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "body/skeleton.h"

namespace vasa::atlas {

enum class BodyPart : std::uint8_t {
  head,
  neck,
  chest,
  abdomen,
  pelvis,
  shoulder,
  upperArm,
  forearm,
  hand,
  thigh,
  leg,
  foot,
  elsewhere
};

/// A part of the body and its side: -1 right, 0 in the middle, 1 left.
struct BodyRegion {
  BodyPart part = BodyPart::elsewhere;
  int side = 0;
  bool operator==(const BodyRegion&) const = default;
};

/// All there are, from head to foot, the left side's before the right side's.
std::span<const BodyRegion> bodyRegions();
/// Its place among bodyRegions().
std::size_t rankOf(BodyRegion region);
/// "Left forearm"
std::string nameOf(BodyRegion region);

/// Where in the body joints and what hangs on them are, by what each joint is (partsOf(), body/retarget.h).
/// A joint of which nothing is known goes with its parent.
class RegionFinder {
 public:
  explicit RegionFinder(const Skeleton& skeleton);

  /// Whether the joints that make a person move are known (humanoidKeys()).
  bool knowsPerson() const { return person_; }
  BodyRegion of(JointId joint) const { return regions_[joint.value]; }
  /// Of a place at rest that goes with a joint: a collar bone's joint moves the root of the neck, too, and
  /// the lower ribs' what lies under the diaphragm.
  BodyRegion of(JointId joint, vec3 place) const;

 private:
  std::vector<BodyRegion> regions_;
  JointId lowChest_;
  bool person_ = false;
  float collar_ = 0, aside_ = 0, diaphragm_ = 0;
};

}  // namespace vasa::atlas
