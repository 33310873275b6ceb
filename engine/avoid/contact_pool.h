#pragma once
#include <array>
#include <span>
#include <vector>

#include "avoid/correction.h"
#include "avoid/interference.h"
#include "avoid/motion_space.h"
#include "avoid/side_places.h"
#include "avoid/sides.h"
#include "solids/bones.h"

namespace vasa {

/// [m] Tubes are watched from here on, not only once they overlap, and held as far from bones.
constexpr float kContactMargin = 1e-4f;
/// Cosine of the angle between two ways out of a bone that are about the same: 45 degrees.
constexpr float kSameWayOut = 0.7f;

/// The last admissible shape, seen from the present pose: what decides on which side of one another vessels
/// lie.
struct LastShape {
  std::span<const Bezier> tubes;    ///< as they were accepted
  std::span<const quat> turns;      ///< how each tube's surroundings turned since then
  std::span<const quat> rotations;  ///< how each point's surroundings turned since rest
  std::span<const char> anew;       ///< a tube each: 1 where the shape at rest decides instead
};

/// Whether two tubes lie about as they lay in the last shape, at a place of both.
bool keepsSide(const Contact& at, std::span<const Bezier> shape, const LastShape& last);

/// n · (C_i(s) - C_j(t)) >= distance for one pair of parameters of two tubes; or a fixed point of a bone in
/// place of C_j.
struct Constraint {
  std::uint32_t i = 0;      ///< tube
  std::uint32_t other = 0;  ///< the other tube, or kBone and the bone's part
  float s = 0, t = 0;
  vec3 normal{0};        ///< unit, from the other to i
  vec3 point{0};         ///< of the bone
  float clearance = 0;   ///< [m] more than the radii; less where there was less at rest
  float distance = 0;    ///< [m] radii and clearance
  float start = 0;       ///< n · (C_i(s) - C_j(t)) where all variables are 0
  float multiplier = 0;  ///< >= 0
  float limit = 0;       ///< of the multiplier
  MotionSpace::Row row;
  bool isBone() const { return other >= kBone; }
  static constexpr std::uint32_t kBone = 0x80000000u;
};

/// What holds vessels apart and out of bones in one step. Constraints only ever become more, and keep their
/// multipliers.
class ContactPool {
 public:
  /// All must outlive this.
  ContactPool(const MotionSpace& space, const Interference& interference, const RestSides& sides);

  void clear();
  /// Adds what the places violate and is not in the pool yet, at each pair's sidePlaces(). @param shape  in
  /// which they were found @param z  its variables
  /// @param moved  a tube each: places of pairs of 0 and 0 were given to an add() since the last clear(); or
  ///               none, and all are new
  void add(std::span<const Interference::Place> places, std::span<const BoneContact> bones,
           std::span<const Bezier> shape, const LastShape& last, std::span<const char> moved,
           std::span<vec3> z);

  /// Turns vessels back that roll around one another, or around one another's ends.
  /// @param turned  RestSides::findTurned  @param most  [m] by which they are turned back in this step:
  /// nothing is in anything's way yet, so there is time
  void addSides(std::span<const RestSides::Turned> turned, std::span<const Bezier> shape, float most,
                std::span<const vec3> z);

  /// To be called before add() in every round: distances for the radii of the given shape.
  void refresh(std::span<const Bezier> shape, std::span<const vec3> z);

  /// Dual coordinate ascent (Hildreth 1957): sweeps over all constraints until none moves its place by a
  /// few micrometres; a lack of less is left.
  /// @param still  [m] variables that it would change by no more stay what they are, to the bit
  void ascend(unsigned sweeps, float still, std::span<vec3> z);

  std::size_t size() const { return constraints_.size(); }

 private:
  // Constraints that were found on a thread of their own, with their rows, until they are taken in.
  struct Proposals {
    std::array<Constraint, kSidePlaces> constraints;
    std::size_t count = 0;
    MotionSpace::Rows rows;
  };
  float clearanceFor(const Constraint& at, float radii) const;
  static bool wouldRoll(const RestSides::Turned& turned, std::span<const Bezier> shape, float most,
                        Constraint& constraint);
  void propose(const Contact& contact, std::span<const Bezier> shape, const LastShape& last,
               Proposals& found);
  void propose(const BoneContact& place, std::span<const Bezier> shape, Proposals& found) const;
  Constraint* known(const Constraint& wanted, float cosine);
  template <class Vector>
  void push(const Constraint& constraint, Vector force, std::span<Vector> z) const;
  void giveRow(Constraint& constraint, MotionSpace::Rows& rows) const;
  void take(const Constraint& constraint, const MotionSpace::Rows& rows, std::span<const Bezier> shape,
            std::span<const vec3> z);
  void begin(Constraint& constraint, std::span<const Bezier> shape, std::span<const vec3> z) const;
  template <class Vector>
  Vector motionOf(const Constraint& constraint, std::span<const Vector> z) const;
  void sortIn(std::size_t before);
  float ascend(Constraint& constraint);

  const MotionSpace* space_;
  const Interference* interference_;
  const RestSides* sides_;
  std::vector<Constraint> constraints_;  // sorted by i and other, then in the order they came
  std::vector<Constraint> sortRoom_;
  std::size_t sorted_ = 0;             // of them; the others are of this round
  MotionSpace::Rows rows_, sideRows_;  // sideRows_: of the latest addSides()
  std::vector<Proposals> proposals_;
  std::vector<vec4> z_;  // while they ascend: four numbers are added at a time
};

}  // namespace vasa
