#pragma once
#include <limits>

#include "convert/strand.h"
#include "curve/fit.h"

namespace vasa {

struct StrandFitOptions {
  FitTolerance position{0, 3e-4f, 3e-4f};
  FitTolerance radius{0.1f, 2e-4f, 3e-4f};
  /// No more than a span for so many mean radii of length: a strand that needs more tells its mesh's noise.
  float radiiPerSpan = 3.0f;
  /// The source paper's way (Park et al. 2013, section 1): a spline through the centre and radius of every
  /// section that was found, a span between two, and no tolerance asked for.
  bool interpolate = false;
  /// However long a strand is, if it is fitted. Where it wants more, sections between are left out.
  std::uint32_t mostSpans = std::numeric_limits<std::uint32_t>::max();
};

/// The most spans that a strand takes if none tells it to take fewer.
std::uint32_t spansWanted(const Sections& sections, const StrandFitOptions& options = {});

/// A strand's spline: the fewest spans that meet the tolerance, else the best that the budget of spans
/// allows. With `interpolate`, the spline through all of them
/// (curve/interpolate.h).
std::vector<vec4> fitStrand(const Sections& sections, const StrandFitOptions& options = {});

}  // namespace vasa
