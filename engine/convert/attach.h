#pragma once
#include "convert/source.h"
#include "convert/strand.h"

// Joins separate elements: end to side where an end lies on or near another vessel's tube, end to end where
// two ends face one another. Arteries join arteries and veins join veins only.
namespace vasa {

struct AttachOptions {
  /// Across open space an end reaches, sideways or backwards, this many of its own radii ...
  float nearRadii = 0.75f;
  /// ... and straight ahead this many, never less or more than these lengths [m].
  float aheadRadii = 4.0f, aheadMin = 0.0015f, aheadMax = 0.008f;
  float nearMin = 0.0006f, nearMax = 0.004f;
  /// Ends that face one another along one line join across this many radii of the larger one, within these.
  float facingRadii = 6.0f, facingMin = 0.003f, facingMax = 0.015f;
  /// Known continuations (the names share a telling word and the side) join across long gaps where no mesh
  /// exists: at most so many radii of the larger end, and this share of the body's height.
  float bridgeRadii = 25.0f, bridgeBodyHeights = 0.045f;
  bool bridges = true;
};

/// A join across space that no mesh fills.
struct Gap {
  std::uint32_t fromElement, toElement;
  float length;  ///< [m] from the end to the other end, or to the other's wall
  bool bridge;   ///< allowed by name, beyond the ordinary limits
};

struct AttachReport {
  std::uint32_t endToEnd = 0, endToSide = 0;
  std::vector<Gap> gaps;  ///< joins whose gap is more than kToldGap
};
constexpr float kToldGap = 0.001f;  ///< [m]

/// Joins free ends, best first: cost is the gap over what is allowed in its direction. An end joins once; the
/// same two strands do not join twice within half the shorter one's length. Sections of an end that lie
/// inside the host's lumen are cut off before the end is led to the host's centre line. Unknown kinds join
/// across no gap, but by name. An end whose surface shares a rim with another element's joins that first.
/// @param bodyHeight  [m]
AttachReport attachEnds(StrandGraph& graph, std::span<const SourceElement> elements, float bodyHeight,
                        const AttachOptions& options = {});

}  // namespace vasa
