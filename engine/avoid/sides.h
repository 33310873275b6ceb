#pragma once
#include <optional>
#include <span>
#include <vector>

#include "avoid/interference.h"

namespace vasa {

/// The unit vector along a tube at a parameter, zero where there is none.
vec3 directionAt(const Bezier& tube, float t);

/// What of c is at right angles to two tubes that run along u and v (unit); to their mean alone where they
/// run about the same way.
vec3 sideways(vec3 c, vec3 u, vec3 v);

/// Whether two tubes that run along u and v (unit) cross, at 40 degrees or more. Such tubes cannot roll
/// around one another: they change sides only by passing through.
bool crossOver(vec3 u, vec3 v);

/// Remembers on which side of one another vessels lie at rest, and tells where that is in a pose.
class RestSides {
 public:
  /// All must outlive this.
  RestSides(const Network& network, Interference& interference);

  /// On which side of tube j at t tube i at s lay at rest: the way from C_j(t) to C_i(s) then, turned with
  /// what is around them, less what lies along the two tubes as they run now. Its length, at most 1, is how
  /// sure that is: it falls to 0 where the two were far from one another, or on one another's centre line, or
  /// their surroundings have turned apart.
  /// @param shape  the tubes now
  vec3 carried(const Contact& at, std::span<const Bezier> shape, std::span<const quat> rotations) const;

  /// Where two vessels that were near one another at rest are nearest now, on another side.
  struct Turned {
    Contact at;       ///< its f is how far their centre lines are on the side at rest [m], negative
    vec3 side;        ///< towards that at rest; its length, at most 1, is how sure that is
    bool aheadOfEnd;  ///< of one of them, and not beside it: there they can go around one another
  };

  /// Pairs that have changed sides, whether they overlap or have passed through: those in which two vessels
  /// are nearest now (which may lie some tubes on), sorted. What is farther from the other than what is near
  /// at rest is on no side of it, nor is what lies ahead of a vessel's end, nor what is nearest where the two
  /// are joined.
  void findChanged(std::span<const Bezier> shape, std::span<const quat> rotations,
                   std::vector<Turned>& changed) {
    find(shape, rotations, Which::changed, changed);
  }

  /// Pairs that have turned by more than a right angle from how they lay at rest, ahead of ends, too.
  void findTurned(std::span<const Bezier> shape, std::span<const quat> rotations,
                  std::vector<Turned>& turned) {
    find(shape, rotations, Which::turned, turned);
  }

  /// Cosine of the angle between the side at rest and that now, from which on it counts as changed: 120
  /// degrees.
  static constexpr float kChanged = -0.5f;
  static constexpr float kLeastSure = 0.5f;  ///< how sure the side at rest must be for any of these

 private:
  enum class Which { turned, changed };
  void find(std::span<const Bezier> shape, std::span<const quat> rotations, Which which,
            std::vector<Turned>& turned);
  vec3 sideOf(const Contact& rest, const Contact& now, std::span<const Bezier> shape,
              std::span<const quat> rotations) const;
  std::optional<Contact> nearestAlong(const Contact& rest, std::span<const Bezier> shape) const;
  bool endsAt(std::uint32_t tube, float at) const;
  bool hasFreeEnd(std::uint32_t tube) const;
  bool beyondEnd(std::uint32_t tube, float at, vec3 way, std::span<const Bezier> shape) const;
  bool aheadOfEnd(const Contact& at, vec3 gap, std::span<const Bezier> shape) const;
  quat rotationAt(std::uint32_t tube, float t, std::span<const quat> rotations) const;

  const Network* network_;
  const Interference* interference_;
  std::vector<Contact> nearAtRest_;
  std::vector<std::optional<Turned>> found_;  // a pair near at rest each
  std::vector<Turned> sortRoom_;
};

}  // namespace vasa
