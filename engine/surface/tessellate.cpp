#include "surface/tessellate.h"

#include <cassert>

#include "core/parallel.h"

namespace vasa {
namespace {

// A sweep's curve from the class matrix, in the order of operations that the shader keeps.
Bezier bezierAt(const PosedNetwork& network, std::uint32_t point, std::uint32_t spanClass) {
  const mat4& m = spanClassMatrices()[spanClass];
  const vec4* d = &network.points[point];
  const auto row = [&](int i) { return m[0][i] * d[0] + m[1][i] * d[1] + m[2][i] * d[2] + m[3][i] * d[3]; };
  return {{row(0), row(1), row(2), row(3)}};
}

// Where a vessel's parts go in the one mesh.
struct Place {
  std::uint32_t vertex = 0, triangle = 0;
};

struct VesselRange {
  std::uint32_t firstSweep, sweeps, firstCap, caps;
};

std::vector<VesselRange> vesselRanges(const Network& network, const SweepTable& table) {
  std::vector<VesselRange> ranges;
  std::uint32_t sweep = 0, cap = 0;
  for (const Vessel& vessel : network.vessels()) {
    VesselRange range{sweep, vessel.spanCount(), cap, 0};
    sweep += range.sweeps;
    while (cap < table.caps.size() && table.caps[cap].sweep < sweep) ++cap;
    range.caps = cap - range.firstCap;
    ranges.push_back(range);
  }
  return ranges;
}

class MeshWriter {
 public:
  MeshWriter(const PosedNetwork& network, const SweepShape& shape, Surface& surface)
      : network_(network), shape_(shape), surface_(surface) {}

  void write(const VesselRange& range, Place place) const {
    const std::uint32_t rings = range.sweeps * shape_.along + 1, tube = place.vertex;
    writeTube(range, tube);
    copyTriangles(sweepTriangles({shape_.around, rings - 1}), place.vertex, place.triangle);
    place.vertex += rings * shape_.around;
    place.triangle += 2 * (rings - 1) * shape_.around;
    for (std::uint32_t i = 0; i < range.caps; ++i) {
      writeCap(range, range.firstCap + i, place, tube);
      place.vertex += capOwnVertices();
      place.triangle += shape_.capTriangles();
    }
  }
  // A cap's rim is the tube's ring; only the rest is its own.
  std::uint32_t capOwnVertices() const { return shape_.capVertices() - shape_.around; }

 private:
  void put(std::uint32_t vertex, const SurfacePoint& point) const {
    surface_.positions[vertex] = point.position;
    surface_.normals[vertex] = point.normal;
  }

  void writeTube(const VesselRange& range, std::uint32_t vertex) const {
    std::vector<SurfacePoint> points(shape_.sweepVertices());
    for (std::uint32_t i = 0; i < range.sweeps; ++i) {
      tessellateSweep(network_, range.firstSweep + i, shape_, points);
      const bool last = i + 1 == range.sweeps;
      const std::size_t count = points.size() - (last ? 0 : shape_.around);
      for (std::size_t k = 0; k < count; ++k) put(vertex++, points[k]);
    }
  }

  void writeCap(const VesselRange& range, std::uint32_t cap, const Place& place, std::uint32_t tube) const {
    std::vector<SurfacePoint> points(shape_.capVertices());
    tessellateCap(network_, cap, shape_, points);
    for (std::size_t k = shape_.around; k < points.size(); ++k)
      put(place.vertex + std::uint32_t(k) - shape_.around, points[k]);
    const bool last = network_.table.caps[cap].last;
    const std::uint32_t rim = tube + (last ? range.sweeps * shape_.along * shape_.around : 0);
    const auto target = [&](std::uint32_t index) {
      if (index >= shape_.around) return place.vertex + index - shape_.around;
      return rim + capDirection(index, shape_.around, last);
    };
    std::uint32_t triangle = place.triangle;
    for (const uvec3& t : capTriangles(shape_))
      surface_.triangles[triangle++] = {target(t.x), target(t.y), target(t.z)};
  }

  void copyTriangles(const std::vector<uvec3>& triangles, std::uint32_t vertex, std::uint32_t at) const {
    for (const uvec3& t : triangles) surface_.triangles[at++] = t + vertex;
  }

  const PosedNetwork& network_;
  SweepShape shape_;
  Surface& surface_;
};

}  // namespace

Section ringSection(const PosedNetwork& network, std::uint32_t sweep, std::uint32_t ring, std::uint32_t along) {
  const shared::SweepRecord& record = network.table.sweeps[sweep];
  const vec3 chord(network.points[record.lastPoint] - network.points[record.firstPoint]);
  std::uint32_t step = 0, spanClass = record.spanClass;
  float t = float(ring) / float(along);
  if (ring == along && record.nextClass != shared::kNoSpan) {
    step = 1;
    spanClass = record.nextClass;
    t = 0;
  }
  const quat* knots = &network.knotFrames[record.knot + step];
  return sectionAt(bezierAt(network, record.point + step, spanClass), chord, knots[0], knots[1], t);
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

Surface tessellate(const Network& network, std::span<const vec4> points, std::span<const quat> knotFrames,
                   const SweepShape& shape) {
  assert(shape.valid());
  const SweepTable table = makeSweepTable(network);
  const std::vector<VesselRange> ranges = vesselRanges(network, table);
  const PosedNetwork posed{table, points, knotFrames};
  Surface surface;
  const MeshWriter writer(posed, shape, surface);
  std::vector<Place> places;
  Place place;
  for (const VesselRange& range : ranges) {
    const std::uint32_t rings = range.sweeps * shape.along + 1;
    places.push_back(place);
    surface.firstTriangle.push_back(place.triangle);
    place.vertex += rings * shape.around + range.caps * writer.capOwnVertices();
    place.triangle += 2 * (rings - 1) * shape.around + range.caps * shape.capTriangles();
  }
  surface.firstTriangle.push_back(place.triangle);
  surface.positions.resize(place.vertex);
  surface.normals.resize(place.vertex);
  surface.triangles.resize(place.triangle);
  parallelFor(ranges.size(), 4, [&](std::size_t i) { writer.write(ranges[i], places[i]); });
  return surface;
}

}  // namespace vasa
