#include "convert/shared_rims.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <tuple>

#include "core/cancellation.h"

namespace vasa {
namespace {

constexpr std::size_t kLeastVertices = 3;

/// A vertex of an element; places that are alike have one number.
struct Corner {
  vec3 place;
  std::uint32_t element, vertex;
  auto key() const { return std::tuple(place.x, place.y, place.z, element, vertex); }
};

std::vector<Corner> sortedCorners(std::span<const SourceElement> elements) {
  std::vector<Corner> corners;
  for (std::uint32_t e = 0; e < elements.size(); ++e) {
    const auto& positions = elements[e].element.mesh.positions;
    for (std::uint32_t v = 0; v < positions.size(); ++v) corners.push_back({positions[v], e, v});
  }
  std::ranges::sort(corners, {}, &Corner::key);
  return corners;
}

/// Numbers of places, by element and vertex, and for each two elements those that both have.
struct Places {
  std::vector<std::vector<std::uint32_t>> of;
  std::vector<vec3> at;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<std::uint32_t>> shared;  // ascending
};

Places placesOf(std::span<const SourceElement> elements) {
  Places places;
  for (const SourceElement& source : elements) places.of.emplace_back(source.element.mesh.positions.size());
  const std::vector<Corner> corners = sortedCorners(elements);
  for (std::size_t i = 0; i < corners.size();) {
    const auto number = std::uint32_t(places.at.size());
    places.at.push_back(corners[i].place);
    std::vector<std::uint32_t> owners;
    for (; i < corners.size() && corners[i].place == places.at.back(); ++i) {
      places.of[corners[i].element][corners[i].vertex] = number;
      if (owners.empty() || owners.back() != corners[i].element) owners.push_back(corners[i].element);
    }
    for (std::size_t a = 0; a < owners.size(); ++a)
      for (std::size_t b = a + 1; b < owners.size(); ++b)
        places.shared[{owners[a], owners[b]}].push_back(number);
  }
  return places;
}

/// The shared places in runs that the mesh's edges join.
std::vector<std::vector<std::uint32_t>> runs(const TriangleMesh& mesh,
                                             const std::vector<std::uint32_t>& placeOf,
                                             const std::vector<std::uint32_t>& shared) {
  std::vector<std::uint32_t> parent(shared.size());
  std::iota(parent.begin(), parent.end(), 0u);
  const auto root = [&](std::uint32_t i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
  };
  const auto indexOf = [&](std::uint32_t vertex) {
    const auto at = std::ranges::lower_bound(shared, placeOf[vertex]);
    return at != shared.end() && *at == placeOf[vertex] ? std::int64_t(at - shared.begin()) : -1;
  };
  for (const uvec3& t : mesh.triangles) {
    const std::int64_t corners[3] = {indexOf(t.x), indexOf(t.y), indexOf(t.z)};
    for (int k = 0; k < 3; ++k) {
      const std::int64_t a = corners[k], b = corners[(k + 1) % 3];
      if (a >= 0 && b >= 0) parent[root(std::uint32_t(a))] = root(std::uint32_t(b));
    }
  }
  std::map<std::uint32_t, std::vector<std::uint32_t>> byRoot;
  for (std::uint32_t i = 0; i < shared.size(); ++i) byRoot[root(i)].push_back(shared[i]);
  std::vector<std::vector<std::uint32_t>> result;
  for (auto& [first, run] : byRoot) result.push_back(std::move(run));
  return result;
}

}  // namespace

std::vector<SharedRim> sharedRims(std::span<const SourceElement> elements) {
  const Places places = placesOf(elements);
  std::vector<SharedRim> rims;
  for (const auto& [pair, shared] : places.shared) {
    checkpoint();
    if (shared.size() < kLeastVertices) continue;
    const auto [first, second] = pair;
    for (const auto& run : runs(elements[first].element.mesh, places.of[first], shared)) {
      if (run.size() < kLeastVertices) continue;
      SharedRim rim{first, second, vec3(0), 0};
      for (const std::uint32_t place : run) rim.centre += places.at[place] / float(run.size());
      for (const std::uint32_t place : run)
        rim.radius += glm::distance(places.at[place], rim.centre) / float(run.size());
      rims.push_back(rim);
    }
  }
  return rims;
}

}  // namespace vasa
