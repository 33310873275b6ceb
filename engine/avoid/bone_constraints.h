#pragma once
#include <span>
#include <vector>

#include "avoid/bones.h"
#include "avoid/constraints.h"

namespace vasa {

/// What holds vessels out of bones in one frame. A bone is not convex, so each place is held by one plane a bone, that of
/// the way out from where the place is now; only the multiplier goes on from round to round. In the last rounds a plane
/// that pushes as hard as it may gives in, round by round: where both cannot be had, vessels come before bones.
class BoneConstraints {
 public:
  /// All must outlive this.
  BoneConstraints(const Network& network, const MotionSpace& space, const NetworkTubes& layout);

  void clear();
  /// From now on until clear() bones do not hold this vessel.
  void letThrough(VesselId vessel) { letThrough_[vessel.value] = 1; }
  /// Forgets the constraints.
  void restart();
  /// Forgets the planes that push against the ways out of these places, within some spans of them along their vessels,
  /// and begins with the first rounds again. From now on until clear() a place's plane replaces those that it
  /// contradicts, and what is nearly out is not given up for the way it has come. O(constraints · places).
  void turnTo(std::span<const BoneContact> places);

  /// To be called in every round: holds the places that enter a bone now. Changes constraints' normals, so what the
  /// multipliers move must be summed up anew.
  /// @param places       as Bones::contacts() tells them
  /// @param shape        the tubes in which they were found
  /// @param posedTubes   before the correction
  /// @return how many ask for more than was done for them
  std::size_t update(std::span<const BoneContact> places, std::span<const Bezier> shape,
                     std::span<const Bezier> posedTubes);

  std::span<Constraint> constraints() { return constraints_; }
  const MotionSpace::Rows& rows() const { return rows_; }

 private:
  struct Key {
    std::uint32_t tube, part;
    float s;
    auto operator<=>(const Key&) const = default;
  };
  bool makeRow(Constraint& constraint);
  void keep(std::size_t own);
  std::size_t sameWay(std::size_t first, std::size_t last, vec3 normal) const;
  void renew(Constraint& constraint, const Constraint& before) const;

  const Network* network_;
  const MotionSpace* space_;
  const NetworkTubes* layout_;
  std::vector<Constraint> constraints_, next_;
  std::vector<Key> keys_, nextKeys_;  // of the constraints, sorted
  MotionSpace::Rows rows_;
  std::vector<MotionSpace::Term> terms_;
  std::vector<char> letThrough_;  // one a vessel
  std::vector<float> lackAtFirst_;  // [m] one a vessel: the most that was asked for where the pose had put it
  unsigned rounds_ = 0;
  bool turning_ = false;
};

}  // namespace vasa
