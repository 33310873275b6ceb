#pragma once
#include "body/skeleton.h"

namespace vasa {

/// The way from one pose to another: every joint turns about its parent along the shorter arc while it moves
/// in a straight line, so limbs keep their length in between.
class PosePath {
 public:
  /// @param skeleton  must outlive this
  PosePath(const Skeleton& skeleton, const Pose& from, const Pose& to);

  /// @param share  0: from, 1: to, both as they were given
  Pose at(float share) const;
  /// How far the joint turns that turns farthest about its parent [rad]. That of a root, which moves
  /// everything alike, does not count.
  float largestTurn() const;

 private:
  const Skeleton* skeleton_;
  Pose from_, to_;
  std::vector<JointTransform> start_, end_;  // relative to the parents
};

}  // namespace vasa
