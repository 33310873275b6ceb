#pragma once
#include <vector>

#include "network/network.h"

namespace vasa {

/// Whether the tube folds over itself on the inside of a bend, r κ >= 1 (looked at in nine places). Most
/// tubes are told straight enough by their control polygon alone.
bool kinks(const Bezier& tube);

/// r κ at the sharpest of nine places: from 1 on the inside of the bend folds.
float sharpestBend(const Bezier& tube);

/// Spans that kink. O(spans).
std::uint32_t kinkCount(const Network& network, std::span<const vec4> points);

/// Straightens vessels where a pose has bent them to a kink that they do not have at rest: the points there
/// are drawn to the middle of their neighbours, in a few passes. Ends that hang on nodes stay. What can not
/// be mended so is left.
class KinkRelaxer {
 public:
  /// Must outlive this.
  explicit KinkRelaxer(const Network& network);
  /// @param points  a posed network's points; radii stay. @return spans that kinked and do not at rest,
  /// before. O(spans)
  std::uint32_t run(std::span<vec4> points) const;

 private:
  const Network* network_;
  std::vector<float> atRest_;  // r κ, one a span
};

}  // namespace vasa
