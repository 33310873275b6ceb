#pragma once
#include <span>
#include <vector>

#include "avoid/interference.h"
#include "avoid/motion_space.h"

namespace vasa {

/// n · (C_i(s) - C_j(t)) >= distance for one pair of parameters of two tubes.
struct Constraint {
  TubePair tubes;
  float s = 0, t = 0;
  vec3 normal{0};        ///< unit, the side of j on which i belongs
  float distance = 0;    ///< [m]
  float start = 0;       ///< n · (C_i(s) - C_j(t)) before the correction
  float multiplier = 0;  ///< >= 0
  MotionSpace::Row row;
};

/// Before the correction: where everything was, at rest and in the pose.
struct PosedNetwork {
  std::span<const vec4> points;     ///< as Network::points(), in the pose
  std::span<const quat> rotations;  ///< how each point's surroundings turned since rest (Deformer::rotations)
};

/// The constraints of one frame. They only ever become more, and keep their multipliers.
class ConstraintPool {
 public:
  /// All must outlive this.
  ConstraintPool(const Network& network, const MotionSpace& space, const Interference& interference);

  void clear();
  /// Adds what the places violate and is not in the pool yet: at each pair's nearest place and, along tubes that run
  /// side by side, at some more. Where to: the side on which i lay of j at rest, turned with the bones, where the two
  /// were near each other then; else the side where it is. How far: the radii and a clearance, or what there was at
  /// rest between the same two points if that was less.
  /// @param shape  the tubes in which the places were found
  /// @return how many were added
  std::size_t add(std::span<const Interference::Place> places, std::span<const Bezier> shape, const PosedNetwork& posed);

  /// Distances for the radii of the given shape.
  void refresh(std::span<const Bezier> shape);

  std::span<Constraint> constraints() { return constraints_; }
  std::span<const Constraint> constraints() const { return constraints_; }

 private:
  struct Side {
    vec3 normal;
    float distance;
    float present;  // n · (C_i - C_j) now
  };
  float distanceFor(TubePair tubes, float s, float t, std::span<const Bezier> shape) const;
  Side sideOf(const Interference::Place& place, float s, float t, std::span<const Bezier> shape,
              const PosedNetwork& posed) const;
  void propose(const Interference::Place& place, std::span<const Bezier> shape, const PosedNetwork& posed,
               std::vector<Constraint>& found) const;
  bool known(const Constraint& wanted, float apart) const;
  quat rotationAt(std::uint32_t tube, float t, const PosedNetwork& posed) const;
  vec3 posedPlace(std::uint32_t tube, float t, const PosedNetwork& posed) const;

  const Network* network_;
  const MotionSpace* space_;
  const Interference* interference_;
  std::vector<Constraint> constraints_;  // sorted by pair, then in the order they came
};

}  // namespace vasa
