#pragma once
#include "core/result.h"
#include "edit/draft.h"

namespace vasa {

/// From where to where a graft is to run.
struct GraftTask {
  Draft::Place from, to;
  float radius = 0;       ///< [m]
  std::vector<vec3> via;  ///< [m] places that it passes, in order
};

struct GraftCourse {
  std::vector<vec4> points;        ///< de Boor points [m]
  std::vector<VesselId> inTheWay;  ///< vessels that it runs into nevertheless
};

/// Leads a tube from the side of one vessel to that of another, around all vessels of the draft: a band from
/// place to place that is drawn taut, and pushed off every vessel that it comes nearer to than kGraftGap. It
/// leaves both at more than 50 degrees, so that it is clear of them after 1.2 times the two radii. Method: an
/// elastic band among obstacles (Quinlan and Khatib 1993): segments against segments, a fixed number of
/// rounds. What the band ends up at depends on what it begins as: a straight line, and where that is stuck or
/// kinks, arcs to eight sides, ever wider; of the narrowest that get through, the shortest. Where an end lies
/// in another vessel no arc is tried. Places in `via` are passed as straight as can be. O(rounds · segments ·
/// vessels near it), deterministic.
GraftCourse leadGraft(const Draft& draft, const GraftTask& task);

constexpr float kGraftGap = 5e-4f;  ///< [m] between the walls: what motion and rounding may take

}  // namespace vasa
