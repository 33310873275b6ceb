#pragma once
#include <span>
#include <vector>

#include "convert/assemble.h"

// How well a network tells the meshes it was made from.
namespace vasa {

/// Distances with the area each stands for.
struct WeightedErrors {
  std::vector<float> distances;  ///< [m]
  float areaEach = 0;            ///< [m²]
};

struct ErrorStatistics {
  float mean = 0, p95 = 0, max = 0;  ///< [m], weighted by area
  bool measured = false;
};
ErrorStatistics statisticsOf(std::span<const WeightedErrors> parts);

struct SurfaceErrorOptions {
  float sampleArea = 1e-6f;  ///< [m²] of mesh a sample stands for, at most; small elements are sampled finer
  std::uint32_t samplesMin = 200, samplesMax = 20000;
  float coverLeast = 0.001f, coverRadii = 0.2f;  ///< covered: within the larger of these of a sweep's wall
};

struct ElementError {
  WeightedErrors forward;   ///< mesh -> walls of the sweeps
  WeightedErrors backward;  ///< walls of the sweeps -> mesh
  double area = 0;          ///< [m²] of the mesh
  double coverage = 0;      ///< share of that area
};

/// Errors of every element, in parallel. An element's mesh is measured against the walls of its own vessels
/// and of those they are joined to; its vessels' walls against its own mesh and the meshes of those. Parts of
/// a wall inside another tube of the network are no surface of the whole and are left out. An element without
/// vessels of its own is measured against those of standIn[element]. Walls are taken across straight pieces
/// of axis, kPiecesPerSpan a span, and ends as half balls.
std::vector<ElementError> measureSurfaceErrors(const Assembly& assembly,
                                               std::span<const SourceElement> elements,
                                               std::span<const std::vector<std::uint32_t>> standIn,
                                               const SurfaceErrorOptions& options = {});

}  // namespace vasa
