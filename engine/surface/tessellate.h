#pragma once
#include <span>

#include "surface/section.h"
#include "surface/sweep_table.h"
#include "surface/sweep_template.h"

namespace vasa {

/// A network in one shape: what tessellation reads.
struct PosedNetwork {
  const SweepTable& table;
  std::span<const vec4> points;      ///< de Boor points, table.pointCount
  std::span<const quat> knotFrames;  ///< table.knotCount
};

/// The section of ring `ring` of n + 1 of a sweep. The last ring is the first ring of the span behind it,
/// bit for bit.
Section ringSection(const PosedNetwork& network, std::uint32_t sweep, std::uint32_t ring,
                    std::uint32_t along);

/// The section at a share t in [0, 1] of a sweep's part of its span.
Section sectionOn(const PosedNetwork& network, std::uint32_t sweep, float t);
Section sectionOn(const PosedNetwork& network, const shared::SweepRecord& sweep, float t);

/// The vertices of one sweep's template: the CPU reference of shaders/tessellate.comp.
/// @param vertices  shape.sweepVertices(), ring after ring
void tessellateSweep(const PosedNetwork& network, std::uint32_t sweep, const SweepShape& shape,
                     std::span<SurfacePoint> vertices);

/// The vertices of one cap's template: the CPU reference of shaders/cap.comp.
/// @param vertices  shape.capVertices()
void tessellateCap(const PosedNetwork& network, std::uint32_t cap, const SweepShape& shape,
                   std::span<SurfacePoint> vertices);

}  // namespace vasa
