#pragma once
#include "convert/source.h"
#include "convert/strand_fit.h"
#include "core/result.h"

namespace vasa {

struct Assembly {
  Network network;
  std::vector<std::uint32_t> elementOf;               ///< vessel -> element
  std::vector<std::vector<std::uint32_t>> vesselsOf;  ///< element -> its vessels, longest first
};

/// Fits a spline to every strand (in parallel) and builds the network. An element's longest vessel takes the
/// element's label, the others "label (2)", "label (3)" ...; all take its ontology id. Breaks circles of
/// hosts first (StrandGraph::breakCircles). Fails as NetworkBuilder::build does.
Result<Assembly> assembleNetwork(StrandGraph graph, std::span<const SourceElement> elements,
                                 const StrandFitOptions& fit, float bodyHeight);

/// The parameter at which a spline comes nearest to p.
float nearestParameter(std::span<const vec4> points, vec3 p);

}  // namespace vasa
