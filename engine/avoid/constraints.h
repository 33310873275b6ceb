#pragma once
#include <array>
#include <span>
#include <utility>
#include <vector>

#include "avoid/interference.h"
#include "avoid/motion_space.h"
#include "avoid/sides.h"

namespace vasa {

/// n · (C_i(s) - C_j(t)) >= distance for one pair of parameters of two tubes; or a fixed plane in place of C_j.
struct Constraint {
  TubePair tubes;        ///< j is kNoTube where something fixed takes its place
  float s = 0, t = 0;
  vec3 normal{0};        ///< unit, the side of j on which i belongs
  float clearance = 0;   ///< [m] more than the radii; less where there was less at rest
  float distance = 0;    ///< [m] radii and clearance
  float start = 0;       ///< n · (C_i(s) - C_j(t)), or the distance from the plane, before the correction
  float multiplier = 0;  ///< >= 0
  float limit = 0;       ///< of the multiplier
  float mostLimit = 0;   ///< ... and how far that may grow
  MotionSpace::Row row;
};
constexpr std::uint32_t kNoTube = 0xffffffffu;

/// The constraints of one frame. They only ever become more, and keep their multipliers.
class ConstraintPool {
 public:
  /// All must outlive this.
  ConstraintPool(const Network& network, const MotionSpace& space, const Interference& interference, const RestSides& sides);

  /// Adds what the places violate and is not in the pool yet: at each pair's nearest place and, along tubes that run
  /// side by side, at some more. Where to: partingDirection(). How far: the radii and a clearance, or what there was at
  /// rest between the same two points if that was less.
  /// @param changed  tubes on the wrong side of one another
  /// @param shape    the tubes in which the places were found
  /// @return how many were added
  std::size_t add(std::span<const Interference::Place> places, std::span<const Contact> changed,
                  std::span<const Bezier> shape, const PosedVessels& posed);

  void clear();
  /// Forgets the constraints.
  void restart();
  /// Forgets what was asked for between the vessels of these places, and parts them from now on until clear() the way
  /// they lie, whatever the rest pose says: together with all else that could not be had.
  void partAsTheyLie(std::span<const Interference::Place> places);

  /// Forgets what was asked for between the vessels of these tubes, on whichever side.
  void forget(std::span<const Contact> changed);

  /// To be called before add() in every round. Distances for the radii of the given shape; more force for those that
  /// have used all of theirs. Returns whether any got more.
  bool refresh(std::span<const Bezier> shape);

  std::span<Constraint> constraints() { return constraints_; }
  std::span<const Constraint> constraints() const { return constraints_; }
  const MotionSpace::Rows& rows() const { return rows_; }

 private:
  static constexpr std::size_t kPlaces = 5;
  struct Proposals {
    std::array<Constraint, kPlaces> constraints;
    std::size_t count = 0;
  };
  float clearanceFor(TubePair tubes, float s, float t, float radii) const;
  /// Of a pair of vessels: what the rest pose says of their side, at one place where they are near now.
  struct Evidence {
    std::uint32_t vesselI, vesselJ;
    float u, v;  ///< along them, in spans
    vec3 side;
  };
  void gather(std::span<const Interference::Place> places, std::span<const Contact> changed,
              std::span<const Bezier> shape, const PosedVessels& posed);
  vec3 evidenceAround(const Contact& contact) const;
  Evidence evidenceAt(const Contact& contact) const;
  void propose(const Contact& contact, bool changed, std::span<const Bezier> shape, const PosedVessels& posed,
               Proposals& found) const;
  bool known(const Constraint& wanted) const;
  const Constraint* nearest(TubePair tubes, float s, float t) const;
  vec3 posedPlace(std::uint32_t tube, float t, const PosedVessels& posed) const;
  void take(Constraint& constraint);
  std::size_t sortIn(std::size_t before);
  std::pair<std::uint32_t, std::uint32_t> vesselsOf(TubePair tubes) const;
  bool partedAsTheyLie(TubePair tubes) const;

  const Network* network_;
  const MotionSpace* space_;
  const Interference* interference_;
  const RestSides* sides_;
  std::vector<Constraint> constraints_;  // sorted by pair, then in the order they came
  MotionSpace::Rows rows_;
  unsigned rounds_ = 0;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> asTheyLie_;  // vessels, sorted
  std::vector<Proposals> proposals_;
  std::vector<Evidence> evidence_;  // of this round, sorted by vessels
  std::vector<MotionSpace::Term> terms_;
};

}  // namespace vasa
