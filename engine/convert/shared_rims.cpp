#include "convert/shared_rims.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "core/cancellation.h"
#include "core/disjoint_sets.h"
#include "core/ids.h"

namespace vasa {
namespace {

constexpr std::size_t kLeastVertices = 3;
constexpr std::size_t kMostOwners = 8;  // of a place: no more vessels meet along one rim

/// A vertex of an element.
struct Corner {
  vec3 place;
  std::uint32_t element, vertex;
  auto key() const { return std::tuple(place.x, place.y, place.z, element, vertex); }
};

std::vector<Corner> sortedCorners(std::span<const SourceElement> elements) {
  std::vector<Corner> corners;
  for (std::uint32_t e = 0; e < elements.size(); ++e) {
    const auto& positions = elements[e].element.mesh.positions;
    for (std::uint32_t v = 0; v < positions.size(); ++v) {
      const vec3 p = positions[v];
      if (std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z)) corners.push_back({p, e, v});
    }
  }
  checkpoint();
  std::ranges::sort(corners, {}, &Corner::key);
  return corners;
}

/// Places that several elements have, numbered.
struct SharedPlaces {
  std::vector<vec3> at;
  std::vector<std::vector<std::uint32_t>> owners;    // elements, ascending
  std::vector<std::vector<std::uint32_t>> numberOf;  // by element and vertex; kNone: no other has it
};

SharedPlaces sharedPlaces(std::span<const SourceElement> elements) {
  SharedPlaces places;
  for (const SourceElement& source : elements)
    places.numberOf.emplace_back(source.element.mesh.positions.size(), kNone);
  const std::vector<Corner> corners = sortedCorners(elements);
  for (std::size_t first = 0, end = 0; first < corners.size(); first = end) {
    std::vector<std::uint32_t> owners;
    for (end = first; end < corners.size() && corners[end].place == corners[first].place; ++end)
      if (owners.empty() || owners.back() != corners[end].element) owners.push_back(corners[end].element);
    if (owners.size() < 2 || owners.size() > kMostOwners) continue;
    for (std::size_t i = first; i < end; ++i)
      places.numberOf[corners[i].element][corners[i].vertex] = std::uint32_t(places.at.size());
    places.at.push_back(corners[first].place);
    places.owners.push_back(std::move(owners));
  }
  return places;
}

using Edge = std::pair<std::uint32_t, std::uint32_t>;  // of numbered places

/// For each later element that one shares edges with, those edges.
std::map<std::uint32_t, std::vector<Edge>> sharedEdges(const SharedPlaces& places, std::uint32_t element,
                                                       const TriangleMesh& mesh) {
  std::map<std::uint32_t, std::vector<Edge>> edges;
  const std::vector<std::uint32_t>& numberOf = places.numberOf[element];
  for (const uvec3& t : mesh.triangles)
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t a = numberOf[t[k]], b = numberOf[t[(k + 1) % 3]];
      if (a == kNone || b == kNone) continue;
      for (const std::uint32_t other : places.owners[a])
        if (other > element && std::ranges::binary_search(places.owners[b], other))
          edges[other].emplace_back(a, b);
    }
  return edges;
}

/// The places that edges join, run by run.
std::vector<std::vector<std::uint32_t>> runsOf(const std::vector<Edge>& edges) {
  std::vector<std::uint32_t> all;
  for (const auto& [a, b] : edges) all.insert(all.end(), {a, b});
  std::ranges::sort(all);
  all.erase(std::unique(all.begin(), all.end()), all.end());
  const auto index = [&](std::uint32_t place) {
    return std::uint32_t(std::ranges::lower_bound(all, place) - all.begin());
  };
  DisjointSets sets(all.size());
  for (const auto& [a, b] : edges) sets.unite(index(a), index(b));
  std::map<std::uint32_t, std::vector<std::uint32_t>> byFirst;
  for (std::uint32_t i = 0; i < all.size(); ++i) byFirst[sets.find(i)].push_back(all[i]);
  std::vector<std::vector<std::uint32_t>> runs;
  for (auto& [first, run] : byFirst) runs.push_back(std::move(run));
  return runs;
}

}  // namespace

std::vector<SharedRim> sharedRims(std::span<const SourceElement> elements) {
  const SharedPlaces places = sharedPlaces(elements);
  std::vector<SharedRim> rims;
  for (std::uint32_t first = 0; first < elements.size(); ++first) {
    checkpoint();
    for (const auto& [second, edges] : sharedEdges(places, first, elements[first].element.mesh))
      for (const std::vector<std::uint32_t>& run : runsOf(edges)) {
        if (run.size() < kLeastVertices) continue;
        SharedRim rim{first, second, vec3(0), 0};
        const float share = 1 / float(run.size());
        for (const std::uint32_t place : run) rim.centre += share * places.at[place];
        for (const std::uint32_t place : run)
          rim.radius += share * glm::distance(places.at[place], rim.centre);
        rims.push_back(rim);
      }
  }
  return rims;
}

}  // namespace vasa
