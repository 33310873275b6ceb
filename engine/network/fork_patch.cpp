#include "network/fork_patch.h"

#include <algorithm>
#include <cmath>

#include "network/network.h"

namespace vasa {
namespace {

bool finite(vec3 v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

std::string ringFault(const Network& network, const PatchRing& ring) {
  if (ring.vessel.value >= network.vessels().size()) return "a ring is on a vessel that is not there";
  const float spans = float(network.vessel(ring.vessel).spanCount());
  if (!(ring.parameter >= 0 && ring.parameter <= spans)) return "a ring lies outside its vessel";
  if (!finite(ring.centre) || !std::isfinite(ring.radius) || !(ring.radius > 0))
    return "a ring has no size or place";
  if (!(std::abs(glm::length(ring.outward) - 1) < 1e-3f)) return "a ring has no direction";
  if (ring.vertices < 3) return "a loop has fewer than 3 vertices";
  if (ring.vertices > kMostOnLoop) return "a loop has more than 4096 vertices";
  return {};
}

std::string vertexFault(const ForkPatch& patch, float reach) {
  for (const PatchRing& ring : patch.rings)
    if (!(glm::distance(ring.centre, patch.rings[0].centre) <= reach)) return "its rings lie too far apart";
  for (const vec3& p : patch.positions)
    if (!(glm::distance(p, patch.rings[0].centre) <= reach)) return "a vertex lies too far away";
  if (patch.weights.size() != patch.positions.size()) return "vertices and weights differ in number";
  for (const auto& weights : patch.weights) {
    int sum = 0;
    for (std::size_t k = 0; k < weights.size(); ++k)
      sum += k < patch.rings.size() ? weights[k] : 256 * weights[k];
    if (sum != 255) return "weights do not add up";
  }
  for (const uvec3& t : patch.triangles)
    if (std::max({t.x, t.y, t.z}) >= patch.positions.size() || t.x == t.y || t.y == t.z || t.z == t.x)
      return "a triangle has no three vertices";
  return {};
}

// Directed edges: of each two triangles that share one it runs both ways, and along the loops it runs
// backwards.
std::string surfaceFault(const ForkPatch& patch) {
  std::vector<std::uint64_t> edges;
  const auto add = [&](std::uint64_t from, std::uint64_t to) { edges.push_back(from << 32 | to); };
  for (const uvec3& t : patch.triangles) add(t.x, t.y), add(t.y, t.z), add(t.z, t.x);
  std::uint32_t first = 0;
  for (const PatchRing& ring : patch.rings) {
    for (std::uint32_t k = 0; k < ring.vertices; ++k) add(first + k, first + (k + 1) % ring.vertices);
    first += ring.vertices;
  }
  std::sort(edges.begin(), edges.end());
  if (std::adjacent_find(edges.begin(), edges.end()) != edges.end())
    return "triangles overlap or disagree on the outside";
  for (const std::uint64_t edge : edges)
    if (!std::binary_search(edges.begin(), edges.end(), edge << 32 | edge >> 32))
      return "its border is not its loops";
  return {};
}

}  // namespace

std::string patchFault(const Network& network, const ForkPatch& patch) {
  if (patch.rings.size() < ForkPatch::kFewestRings || patch.rings.size() > ForkPatch::kMostRings)
    return "it has " + std::to_string(patch.rings.size()) + " rings, not 3 or 4";
  if (patch.positions.size() > ForkPatch::kMostVertices) return "it has more than 65535 vertices";
  std::size_t onLoops = 0;
  for (const PatchRing& ring : patch.rings) {
    if (std::string fault = ringFault(network, ring); !fault.empty()) return fault;
    onLoops += ring.vertices;
  }
  if (onLoops > patch.positions.size()) return "its loops have more vertices than it has";
  if (std::string fault = vertexFault(patch, network.bodyHeight()); !fault.empty()) return fault;
  return surfaceFault(patch);
}

Result<Network> withPatches(Network network, std::vector<ForkPatch> patches) {
  for (std::size_t i = 0; i < patches.size(); ++i)
    if (const std::string fault = patchFault(network, patches[i]); !fault.empty())
      return badInput("patch " + std::to_string(i) + ": " + fault);
  network.patches_ = std::move(patches);
  return network;
}

}  // namespace vasa
