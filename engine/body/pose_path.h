#pragma once
#include "body/skeleton.h"

namespace vasa {

/// The way from one pose to another: every joint turns about its parent along the shorter arc while it moves
/// in a straight line, so limbs keep their length in between.
class PosePath {
 public:
  PosePath() = default;
  /// @param skeleton  must outlive this
  PosePath(const Skeleton& skeleton, const Pose& from, const Pose& to) { set(skeleton, from, to); }
  /// Another way in the same memory.
  void set(const Skeleton& skeleton, const Pose& from, const Pose& to);

  /// @param share  0: from, 1: to, both as they were given
  /// @return as long as nothing else is asked
  const Pose& at(float share);
  /// How far the joint turns that turns farthest about its parent [rad]. That of a root, which moves
  /// everything alike, does not count.
  float largestTurn() const;

 private:
  const Skeleton* skeleton_ = nullptr;
  Pose from_, to_, between_;
  std::vector<JointTransform> start_, end_, local_;  // relative to the parents; local_: of between_
};

}  // namespace vasa
