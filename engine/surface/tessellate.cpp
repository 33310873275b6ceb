#include "surface/tessellate.h"

#include <cassert>

#include "surface/reference.h"

namespace vasa {
Section ringSection(const PosedNetwork& network, std::uint32_t sweep, std::uint32_t ring,
                    std::uint32_t along) {
  const shared::SweepRecord& record = network.table.sweeps[sweep];
  const vec3 chord(network.points[record.lastPoint] - network.points[record.firstPoint]);
  std::uint32_t step = 0, spanClass = record.spanClass;
  float t = record.from + (record.to - record.from) * (float(ring) / float(along));
  if (ring == along) t = record.to;
  if (t == 1 && record.nextClass != shared::kNoSpan) {
    step = 1;
    spanClass = record.nextClass;
    t = 0;
  }
  const quat* knots = &network.knotFrames[record.knot + step];
  return sectionAt(bezierAt(network, record.point + step, spanClass), chord, knots[0], knots[1], t);
}

Section sectionOn(const PosedNetwork& network, std::uint32_t sweep, float t) {
  return sectionOn(network, network.table.sweeps[sweep], t);
}

Section sectionOn(const PosedNetwork& network, const shared::SweepRecord& record, float t) {
  const vec3 chord(network.points[record.lastPoint] - network.points[record.firstPoint]);
  const quat* knots = &network.knotFrames[record.knot];
  const float at = t == 1 ? record.to : record.from + (record.to - record.from) * t;
  return sectionAt(bezierAt(network, record.point, record.spanClass), chord, knots[0], knots[1], at);
}

void tessellateSweep(const PosedNetwork& network, std::uint32_t sweep, const SweepShape& shape,
                     std::span<SurfacePoint> vertices) {
  assert(vertices.size() == shape.sweepVertices());
  const std::vector<vec2> directions = ringDirections(shape.around);
  for (std::uint32_t ring = 0; ring <= shape.along; ++ring) {
    const Section section = ringSection(network, sweep, ring, shape.along);
    for (std::uint32_t k = 0; k < shape.around; ++k)
      vertices[ring * shape.around + k] = surfacePoint(section, directions[k]);
  }
}

void tessellateCap(const PosedNetwork& network, std::uint32_t cap, const SweepShape& shape,
                   std::span<SurfacePoint> vertices) {
  assert(vertices.size() == shape.capVertices());
  const auto [sweep, last] = network.table.caps[cap];
  const std::vector<vec2> directions = ringDirections(shape.around), angles = capAngles();
  const Section section = ringSection(network, sweep, last ? shape.along : 0, shape.along);
  const float outward = last ? 1.0f : -1.0f;
  for (std::uint32_t j = 0; j < shared::kCapRings; ++j)
    for (std::uint32_t k = 0; k < shape.around; ++k)
      vertices[j * shape.around + k] =
          capPoint(section, directions[capDirection(k, shape.around, last)], angles[j], outward);
  vertices.back() = capPoint(section, directions[0], angles.back(), outward);
}

}  // namespace vasa
