#include "convert/assemble.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "convert/span_limit.h"
#include "core/ids.h"
#include "core/parallel.h"
#include "network/builder.h"

namespace vasa {
namespace {

// Strands in the order of the network: by element, the longest first.
std::vector<std::uint32_t> strandOrder(const StrandGraph& graph) {
  std::vector<std::uint32_t> order;
  std::vector<float> lengths(graph.strands.size());
  for (std::uint32_t s = 0; s < graph.strands.size(); ++s) {
    if (graph.strands[s].dropped()) continue;
    order.push_back(s);
    lengths[s] = lengthOf(graph.strands[s].sections);
  }
  std::ranges::stable_sort(order, [&](std::uint32_t a, std::uint32_t b) {
    const std::uint32_t ea = graph.strands[a].element, eb = graph.strands[b].element;
    return ea != eb ? ea < eb : lengths[a] > lengths[b];
  });
  return order;
}

// The most spans that a strand of each element may take. None is told to take fewer where all together ask
// for no more than their triangles tell; else an element that does pays for it alone.
std::vector<std::uint32_t> spanLimits(const StrandGraph& graph, std::span<const std::uint32_t> order,
                                      std::span<const SourceElement> elements, const StrandFitOptions& fit) {
  std::vector<std::vector<std::uint32_t>> wanted(elements.size());
  std::size_t triangles = 0, asked = 0;
  for (const SourceElement& source : elements) triangles += source.element.mesh.triangles.size();
  for (const std::uint32_t s : order) {
    wanted[graph.strands[s].element].push_back(spansWanted(graph.strands[s].sections, fit));
    asked += wanted[graph.strands[s].element].back();
  }
  std::vector<std::uint32_t> limits(elements.size(), fit.mostSpans);
  if (asked <= spansToldBy(triangles)) return limits;
  for (std::size_t e = 0; e < limits.size(); ++e)
    limits[e] = std::min(fit.mostSpans,
                         spanLimit(std::move(wanted[e]),
                                   spansToldBy(elements[e].element.mesh.triangles.size(), elements.size())));
  return limits;
}

std::string numbered(const std::string& label, std::size_t ordinal) {
  return ordinal ? label + " (" + std::to_string(ordinal + 1) + ")" : label;
}

}  // namespace

float nearestParameter(std::span<const vec4> points, vec3 p) {
  const std::uint32_t spans = spanCount(points);
  constexpr std::uint32_t kProbes = 8;
  float best = 0, least = std::numeric_limits<float>::infinity();
  const auto distance = [&](float u) { return glm::distance(p, vec3(evaluate(points, u))); };
  for (std::uint32_t i = 0; i <= spans * kProbes; ++i) {
    const float u = float(i) / kProbes, d = distance(u);
    if (d < least) least = d, best = u;
  }
  float low = std::max(0.0f, best - 1.0f / kProbes), high = std::min(float(spans), best + 1.0f / kProbes);
  constexpr float kGolden = 0.618034f;
  for (int step = 0; step < 24; ++step) {
    const float a = high - kGolden * (high - low), b = low + kGolden * (high - low);
    if (distance(a) < distance(b))
      high = b;
    else
      low = a;
  }
  const float refined = 0.5f * (low + high);
  return distance(refined) < least ? refined : best;
}

Result<Assembly> assembleNetwork(StrandGraph graph, std::span<const SourceElement> elements,
                                 const StrandFitOptions& fit, float bodyHeight) {
  graph.breakCircles();
  const std::vector<std::uint32_t> order = strandOrder(graph);
  std::vector<std::vector<vec4>> splines(order.size());
  const std::vector<std::uint32_t> limits = spanLimits(graph, order, elements, fit);
  parallelFor(order.size(), 1, [&](std::size_t i) {
    const Strand& strand = graph.strands[order[i]];
    StrandFitOptions own = fit;
    own.mostSpans = limits[strand.element];
    splines[i] = fitStrand(strand.sections, own);
  });

  Assembly assembly;
  assembly.vesselsOf.resize(elements.size());
  std::vector<std::uint32_t> vesselOf(graph.strands.size(), kNone);
  NetworkBuilder builder;
  for (std::size_t i = 0; i < order.size(); ++i) {
    const std::uint32_t element = graph.strands[order[i]].element;
    auto& vessels = assembly.vesselsOf[element];
    const SourceElement& source = elements[element];
    const VesselId vessel =
        builder.addVessel({numbered(source.label, vessels.size()), source.element.ontologyId, source.kind},
                          std::move(splines[i]));
    vessels.push_back(vessel.value);
    vesselOf[order[i]] = vessel.value;
    assembly.elementOf.push_back(element);
  }
  for (const Joint& joint : graph.joints) {
    if (joint.ends.empty()) continue;
    std::vector<VesselEnd> ends;
    for (const StrandEnd& end : joint.ends) ends.push_back({{vesselOf[end.strand]}, end.last});
    if (!joint.host) {
      builder.joinEnds(std::move(ends));
      continue;
    }
    const VesselId host{vesselOf[*joint.host]};
    const float parameter = nearestParameter(builder.pointsOf(host), joint.place);
    for (const VesselEnd& end : ends) builder.joinToSide(end, {host, parameter});
  }
  auto network = builder.build(bodyHeight);
  if (!network) return network.error();
  assembly.network = std::move(*network);
  return assembly;
}

}  // namespace vasa
