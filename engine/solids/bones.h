#pragma once
#include <memory>
#include <span>

#include "body/body.h"
#include "collide/contact.h"
#include "curve/bezier.h"

namespace vasa {

/// A place of a tube in a bone or the heart, or through the skin, deeper than at rest.
struct BoneContact {
  std::uint32_t tube = 0, part = 0;
  float s = 0;        ///< on the tube: one of a few parameters, the same in every pose
  float f = 0;        ///< [m] signed distance of the centre line from the surface, less the radius there
  float allowed = 0;  ///< [m] <= 0: the least f of this tube and this part at rest, where that is negative
  vec3 point{0};  ///< as far from the centre line along the normal as that should be: n · (C(s) - point) >= r
  vec3 normal{0};                          ///< unit, the way out there
  vec3 nearestPoint{0}, nearestNormal{0};  ///< the same by the nearest surface, whichever side that is
  /// Deeper than at rest by more than rounding.
  bool enters() const { return allowed - f > (allowed < 0 ? kRestTolerance : 0); }
};

/// The solid parts of a body, which vessels must not enter: its meshes other than the skin, cut by the joint
/// or axial bone that carries them. A part is rigid, so its distance field is made once, and tubes are looked
/// at from the joint; the field's accuracy (collide/distance_field.h) is that of every answer. A triangle
/// belongs to the joint with the largest weight at its first corner.
///
/// A thin tube whose axis lies in a part at rest, as those of vessels that run through a bone in the data, is
/// not held out of that part. (Thin: a radius of 3.6 mm at most, so that one ball is looked at in each
/// place.)
///
/// The way out of a part is that of its nearest surface; from within or beyond, it is where the straight way
/// to where the tube was in the pose before, as the part sees it, leaves the part, so that a vessel is not
/// pushed through a bone. Where that way leads into another part and the nearest surface's does not, the
/// nearest surface's is taken.
class Bones {
 public:
  /// What is looked at in its life is kept for later runs (core/kept.h).
  /// @param restTubes  of the network; those that lie in a part at rest may stay as deep as they are there
  Bones(const Body& body, std::span<const Bezier> restTubes);
  ~Bones();
  Bones(Bones&&) noexcept;

  /// The parts go to a pose. @param jointMatrices  a joint's world · inverseBind, then the axial bones'
  void pose(std::span<const mat4> jointMatrices);
  /// The present pose is from now on the one before.
  void keepPose();

  /// Places where tubes enter a part; sorted by tube, part and parameter. Tubes are
  /// looked at in four to seven places. Parallel.
  /// @param last   the tubes in the pose before
  /// @param which  all tubes, or only those that were within a field's band when all were looked at last, and
  /// those that
  ///               were moved far since: what a round of corrections can bring into a bone, much faster
  enum class Which { all, nearAtLast };
  /// @param anew   a tube each: 1 where the way out is to the side of a part on which it was at rest; or none
  /// @param moved  a tube each: 0 where it is what it was at the last call, so that nearAtLast has no need to
  ///               look again, if pose, `last` and `anew` are those of then; or none
  std::span<const BoneContact> contacts(std::span<const Bezier> tubes, std::span<const Bezier> last,
                                        Which which = Which::all, std::span<const char> anew = {},
                                        std::span<const char> moved = {});

  std::uint32_t partCount() const;
  JointId jointOf(std::uint32_t part) const;  ///< that carries a part
  std::size_t restContactCount() const;       ///< tubes and parts that overlap at rest
  std::size_t bytes() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace vasa
