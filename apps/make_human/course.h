#pragma once
#include <vector>

#include "collide/network_tubes.h"
#include "make_human/surroundings.h"

namespace vasa::human {

/// The way of a vessel, or of several that continue one another, while it is laid out: a polyline so fine
/// that it stands for the curve, with a radius at each point [m].
struct Course {
  /// Where an end hangs: a place on another course, by (fractional) number of its points.
  struct Anchor {
    int course = -1;  ///< -1: the end is free
    float at = 0;
  };
  std::vector<vec3> points;
  std::vector<float> radii;
  std::vector<float> belowSkin;  ///< [m] how deep the wall must lie, a value a point
  Anchor start, end;
};

vec3 placeOn(const Course& course, float at);

struct SettleOptions {
  float betweenVessels = 0.8e-3f;  ///< [m] clearance of walls
  float fromBone = 0.7e-3f, fromHeart = 0.3e-3f;
  /// Near a fork courses need not be farther apart than this many times the way between them along the
  /// vessels (branches that open by 60 degrees are): what no course could keep to would drift aside for ever.
  /// Sweeps may overlap there while that way is shorter than kReach sums of radii.
  float opening = 1 / NetworkTubes::kReach;
  int rounds = 8, stepsPerRound = 30;
};

/// Moves courses apart from one another, out of bones and heart and below the skin, as little and as smoothly
/// as that allows; anchored ends go along with the course they hang on. Method: projections onto the
/// constraints (Jakobsen 2001) in the space of smooth displacements, cubic B-splines along the courses.
/// Vessels that begin in the heart and are wider than a coronary artery may lie in it near their origin.
/// Deterministic.
void settle(std::vector<Course>& courses, const Surroundings& around, const SettleOptions& options = {});

}  // namespace vasa::human
