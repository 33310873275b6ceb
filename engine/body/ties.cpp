#include "body/ties.h"

#include <algorithm>

#include "body/point_tree.h"
#include "core/cancellation.h"

namespace vasa {
namespace {

constexpr float kBesideRadii = 2;  // of both vessels together
// Of the way to the next point: points of two vessels do not lie face to face.
constexpr float kBesideSteps = 0.5f;
constexpr float kFarthestHeights = 0.0045f;  // of the body's height

void addBeside(const Network& network, std::vector<Tie>& ties) {
  const float farthest = kFarthestHeights * network.bodyHeight();
  PointCloud cloud;
  std::vector<std::uint32_t> vesselOf;
  std::vector<float> reach;
  for (std::uint32_t v = 0; v < network.vessels().size(); ++v) {
    const auto own = network.pointsOf(network.vessels()[v]);
    for (std::size_t i = 0; i < own.size(); ++i) {
      const float step = glm::distance(vec3(own[i]), vec3(own[i > 0 ? i - 1 : 1]));
      cloud.points.push_back(vec3(own[i]));
      vesselOf.push_back(v);
      reach.push_back(std::min(kBesideRadii * own[i].w + kBesideSteps * step, 0.5f * farthest));
    }
  }
  const PointTree tree(3, cloud);
  std::vector<std::pair<std::uint32_t, float>> found;
  for (std::uint32_t p = 0; p < cloud.points.size(); ++p) {
    checkpoint();
    const float radius = reach[p] + 0.5f * farthest;
    tree.radiusSearch(&cloud.points[p].x, radius * radius, found, nanoflann::SearchParams(32, 0, true));
    for (const auto& [q, squared] : found)
      if (q > p && vesselOf[q] != vesselOf[p] && squared < (reach[p] + reach[q]) * (reach[p] + reach[q]))
        ties.push_back({p, q});
  }
}

}  // namespace

std::vector<Tie> tiesOf(const Network& network) {
  std::vector<Tie> ties;
  for (const Vessel& vessel : network.vessels())
    for (std::uint32_t i = 1; i < vessel.pointCount; ++i)
      ties.push_back({vessel.firstPoint + i - 1, vessel.firstPoint + i});
  for (const Node& node : network.nodes()) {
    const std::span<const VesselEnd> ends = network.ends(node);
    for (std::size_t k = 1; k < ends.size(); ++k)
      ties.push_back({network.pointOf(ends[0]), network.pointOf(ends[k])});
    if (!node.host || ends.empty()) continue;
    const Vessel& host = network.vessel(node.host->vessel);
    const std::uint32_t span = locate(node.host->parameter, host.spanCount()).span;
    for (std::uint32_t k = 1; k < 3; ++k)
      ties.push_back({network.pointOf(ends[0]), host.firstPoint + span + k});
  }
  addBeside(network, ties);
  return ties;
}

}  // namespace vasa
