#pragma once
#include <span>
#include <vector>

#include "math/types.h"

namespace vasa {

struct SampledSpline {
  std::vector<vec4> points;       ///< de Boor points on clamped uniform knots (curve/bspline.h)
  std::vector<float> parameters;  ///< u of each sample
};

/// A spline through every sample: C(parameters[i]) is sample i up to rounding, and every coefficient of the
/// radius is positive.
/// Method: one span between neighbouring samples, natural ends, one tridiagonal solve. Where a span would
/// swing out from its chord or the radius towards zero, samples are added halfway along the chord and all is
/// solved again, so that the curve there follows the polyline.
/// @param samples  (x, y, z, r) [m], at least 2, neighbours distinct, finite, r > 0
/// O(samples).
SampledSpline interpolateSamples(std::span<const vec4> samples);

/// A spline that comes within `centre` times its radius of every sample's centre and within `radius` times it
/// of its radius, through as few of the samples as it needs. Method: through those that a polyline needs for
/// half the tolerance, then through those missed as well, until none is. parameters[i] is where the curve is
/// nearest to sample i.
/// @param samples  as above
/// O(samples · rounds); few rounds.
SampledSpline followSamples(std::span<const vec4> samples, float centre, float radius);

}  // namespace vasa
