#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "math/types.h"

namespace vasa {

/// The place of de Boor point j along the parameter, where it moves the curve most: the mean of its three
/// knots.
double greville(std::uint32_t j, std::uint32_t spans);

/// How near a spline has to come to each sample. A sample's tolerance is `share` of its radius, kept within
/// [least, most].
struct FitTolerance {
  float share = 0.15f;
  float least = 5e-4f;  ///< [m]
  float most = 1e-3f;   ///< [m]
  float at(float radius) const { return glm::clamp(share * radius, least, most); }
};

struct FitOptions {
  FitTolerance position;  ///< distance from a sample's centre to the curve
  FitTolerance radius;    ///< difference of radii at the nearest point of the curve
  std::uint32_t maxSpans = 4096;
};

struct Fit {
  std::vector<vec4> points;  ///< de Boor points on clamped uniform knots (curve/bspline.h)
  float error = 0;           ///< worst sample, in tolerances: at most 1 where the fit succeeded
};

/// The spline with the fewest spans that meets every sample within its tolerance. Passes exactly through the
/// first and the last sample; radii stay positive.
/// Method: least squares weighted by the tolerances, parameters moved to the nearest points and solved again
/// (Hoschek 1988); where that misses the tolerance, spans are made shorter where it misses most and longer
/// elsewhere (de Boor 1973); the number of spans is doubled until it fits, then bisected. Where even a span
/// per sample misses the tolerance (samples that turn back), the best found.
/// @param samples  (x, y, z, r) [m] in order, at least 2, finite, r > 0; repeated centres are passed over.
///                 The first and last differ from their neighbours, or all are one place: then a straight
///                 spline of length zero comes back
/// O(samples · log spans).
Fit fitSplineMeasured(std::span<const vec4> samples, const FitOptions& options);
std::vector<vec4> fitSpline(std::span<const vec4> samples, const FitOptions& options);

}  // namespace vasa
