#include "network/centrelines.h"

#include <algorithm>

#include "core/parallel.h"
#include "curve/interpolate.h"

namespace vasa {
namespace {

constexpr float kCentreShare = 0.05f, kRadiusShare = 0.005f;  // of a sample's radius

// A body is taller than wide and deep; what lies across is judged like what stands.
float heightOf(const Centrelines& centrelines) {
  Aabb box;
  for (const auto& line : centrelines.lines)
    for (const vec4& s : line.samples) box.add(vec3(s), s.w);
  return box.size();
}

}  // namespace

std::size_t Centrelines::sampleCount() const {
  std::size_t count = 0;
  for (const Line& line : lines) count += line.samples.size();
  return count;
}

void Centrelines::append(Centrelines&& other) {
  const auto base = std::uint32_t(lines.size());
  for (Joint& joint : other.joints) {
    if (joint.host) joint.host->line += base;
    for (End& end : joint.ends) end.line += base;
    joints.push_back(std::move(joint));
  }
  for (Line& line : other.lines) lines.push_back(std::move(line));
}

Result<CentrelineNetwork> networkOfCentrelines(const Centrelines& centrelines, float bodyHeight) {
  if (centrelines.lines.empty()) return badInput("there is no centre line of two samples or more");
  std::vector<SampledSpline> sweeps(centrelines.lines.size());
  parallelFor(sweeps.size(), 4, [&](std::size_t i) {
    sweeps[i] = followSamples(centrelines.lines[i].samples, kCentreShare, kRadiusShare);
  });
  NetworkBuilder builder;
  for (std::size_t i = 0; i < sweeps.size(); ++i) {
    const auto& line = centrelines.lines[i];
    builder.addVessel({line.name, line.ontologyId, line.kind}, std::move(sweeps[i].points));
  }
  for (const auto& joint : centrelines.joints) {
    std::optional<Host> host;
    if (joint.host) host = Host{{joint.host->line}, sweeps[joint.host->line].parameters[joint.host->sample]};
    std::vector<VesselEnd> ends;
    for (const auto& end : joint.ends) ends.push_back({{end.line}, end.last});
    builder.addNode(host, std::move(ends));
  }
  auto network = builder.build(bodyHeight > 0 ? bodyHeight : heightOf(centrelines));
  if (!network) return network.error();
  CentrelineNetwork result{std::move(*network), {}};
  for (SampledSpline& sweep : sweeps) result.parameters.push_back(std::move(sweep.parameters));
  return result;
}

Centrelines centrelinesOfNetwork(const Network& network, std::span<const vec4> points,
                                 std::uint32_t perSpan) {
  Centrelines result;
  std::vector<std::vector<float>> parameters(network.vessels().size());
  for (std::size_t v = 0; v < parameters.size(); ++v) {
    const std::uint32_t count = network.vessels()[v].spanCount() * perSpan;
    for (std::uint32_t i = 0; i <= count; ++i) parameters[v].push_back(float(i) / float(perSpan));
  }
  for (const Node& node : network.nodes())
    if (node.host) parameters[node.host->vessel.value].push_back(node.host->parameter);
  for (std::size_t v = 0; v < parameters.size(); ++v) {
    const Vessel& vessel = network.vessels()[v];
    std::ranges::sort(parameters[v]);
    std::vector<float> kept;
    Centrelines::Line line{vessel.name, vessel.ontologyId, vessel.kind, {}};
    for (const float u : parameters[v]) {
      const vec4 sample = evaluate(Network::pointsOf(vessel, points), u);
      if (!line.samples.empty() && vec3(sample) == vec3(line.samples.back())) continue;
      line.samples.push_back(sample);
      kept.push_back(u);
    }
    parameters[v] = std::move(kept);
    result.lines.push_back(std::move(line));
  }
  for (const Node& node : network.nodes()) {
    Centrelines::Joint joint;
    if (node.host) {
      const auto& at = parameters[node.host->vessel.value];
      // A sample that coincides with the one before was left out: the last one at or before the place.
      const auto above = std::ranges::upper_bound(at, node.host->parameter);
      joint.host = {node.host->vessel.value,
                    std::uint32_t(std::max<std::ptrdiff_t>(above - at.begin() - 1, 0))};
    }
    for (const VesselEnd& end : network.ends(node)) joint.ends.push_back({end.vessel.value, end.last});
    result.joints.push_back(std::move(joint));
  }
  return result;
}

}  // namespace vasa
