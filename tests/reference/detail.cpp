#include "reference/detail.h"

#include <algorithm>
#include <cmath>

#include "surface/detail.h"
#include "surface/reference.h"

// The bend: a cubic of n equal steps keeps within max|C''| / (8 n²) of its chords. On the outer side of a
// bend through the angle α the surface adds r α² / (8 n²). Operations in the order of
// shaders/lib/detail.glsl, so that both round alike.
namespace vasa {
namespace {

float heightOver(const vec4& plane, const vec4& ball) {
  return plane.x * ball.x + plane.y * ball.y + plane.z * ball.z + plane.w;
}

// Square of the angle between the first and the last leg of a control polygon, by its chord.
float turnOf(const Bezier& z) {
  const vec3 a(z.b[1] - z.b[0]), c(z.b[3] - z.b[2]);
  const float size2 = dotOf(a, a) * dotOf(c, c);
  if (size2 <= kTiny2 * kTiny2) return 0;
  return std::max(2.0f - 2.0f * (dotOf(a, c) / std::sqrt(size2)), 0.0f);
}

// Largest second difference of the control polygon, radius included: |C''| / 6 at an end.
float bulgeOf(const Bezier& z) {
  float largest = 0;
  for (int i = 0; i < 2; ++i) {
    const vec4 d = z.b[i] - 2.0f * z.b[i + 1] + z.b[i + 2];
    largest = std::max(largest, std::sqrt(dotOf(vec3(d), vec3(d))) + std::abs(d.w));
  }
  return largest;
}

}  // namespace

SweepExtent sweepExtent(std::span<const vec4, 4> points, const Bezier& bezier,
                        const shared::DetailView& view) {
  SweepExtent extent{.inView = true};
  for (const vec4& plane : view.planes) {
    bool outside = true;
    for (const vec4& ball : points) outside = outside && heightOver(plane, ball) < -ball.w;
    if (outside) return {};
  }
  float radius = 0, depth = 3e38f;
  for (const vec4& ball : points) {
    radius = std::max(radius, ball.w);
    depth = std::min(depth, heightOver(view.depth, ball) - view.reach * ball.w);
  }
  const float scale = view.focal / std::max(depth, view.nearest);
  extent.radiusPixels = radius * scale;
  extent.bendPixels = (0.75f * bulgeOf(bezier) + 0.125f * (radius * turnOf(bezier))) * scale;
  return extent;
}

std::uint32_t aroundFor(float radiusPixels, float tolerance) {
  const bool coarse = tolerance >= float(shared::kCoarse);
  if (!coarse && radiusPixels <= tolerance) return shared::kThinAround;
  const float thin = float(shared::kThinShare) * tolerance;
  std::uint32_t m = coarse ? shared::kMinAround : shared::kRoundAround;
  while (m < shared::kMaxAround &&
         radiusPixels * aroundErrors()[m] > (m < shared::kRoundAround ? thin : tolerance))
    ++m;
  return m;
}

std::uint32_t capRings(std::uint32_t around, const shared::DetailView& view) {
  return view.around == 0 && around < shared::kRoundAround ? 1 : shared::kCapRings;
}

std::uint32_t alongFor(float bendPixels, float tolerance) {
  const float share = float(shared::kAlongShare) * tolerance;
  std::uint32_t n = 1;
  while (n < shared::kMaxAlong && bendPixels > float(n * n) * share) ++n;
  return n;
}

NetworkDetail networkDetail(const PosedNetwork& network, const shared::DetailView& view) {
  const SweepTable& table = network.table;
  NetworkDetail detail;
  detail.along.resize(table.sweeps.size());
  std::vector<float> radius(table.vesselOfSweep.empty() ? 0 : table.vesselOfSweep.back() + 1);
  for (std::size_t i = 0; i < table.sweeps.size(); ++i) {
    const shared::SweepRecord& record = table.sweeps[i];
    const std::span<const vec4, 4> points(&network.points[record.point], 4);
    const SweepExtent extent = sweepExtent(points, bezierAt(network, record.point, record.spanClass), view);
    if (!extent.inView) continue;
    detail.along[i] = view.along ? view.along : alongFor(extent.bendPixels, view.tolerance);
    float& largest = radius[table.vesselOfSweep[i]];
    largest = std::max(largest, extent.radiusPixels);
  }
  for (const float r : radius)
    detail.around.push_back(view.around ? view.around : aroundFor(r, view.tolerance));
  return detail;
}

}  // namespace vasa
