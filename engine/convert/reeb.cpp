#include "convert/reeb.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "core/cancellation.h"
#include "core/disjoint_sets.h"
#include "core/ids.h"

namespace vasa {
namespace {

// The part of a triangle inside a band is numbered first[triangle] + band - low[triangle].
struct Bands {
  std::vector<std::int32_t> low;
  std::vector<std::uint32_t> first;
  std::span<const float> value;
  float step;

  std::int32_t of(std::uint32_t vertex) const { return std::int32_t(std::floor(value[vertex] / step)); }
  std::uint32_t piece(std::uint32_t triangle, std::int32_t band) const {
    return first[triangle] + std::uint32_t(band - low[triangle]);
  }
  Bands(const TriangleMesh& mesh, std::span<const float> values, float height) : value(values), step(height) {
    first.push_back(0);
    for (const uvec3& t : mesh.triangles) {
      const auto [least, most] = std::minmax({of(t.x), of(t.y), of(t.z)});
      low.push_back(least);
      first.push_back(first.back() + std::uint32_t(most - least + 1));
    }
  }
};

struct ContourSum {
  dvec3 moment{0};
  double length = 0;
  void add(vec3 a, vec3 b) {
    // A piece of no length still marks the place.
    const double l = std::max(double(glm::distance(a, b)), 1e-12);
    moment += l * 0.5 * (dvec3(a) + dvec3(b));
    length += l;
  }
  vec4 section() const { return vec4(vec3(moment / length), float(length / (2 * double(kPi)))); }
};

// Contours between sets of neighbouring bands, by (lower set, upper set).
using Links = std::map<std::pair<std::uint32_t, std::uint32_t>, ContourSum>;

Links linkBands(const TriangleMesh& mesh, const Bands& bands, DisjointSets& sets) {
  Links links;
  Checkpoints checkpoints;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    checkpoints.pass();
    uvec3 c = mesh.triangles[t];
    if (bands.value[c.y] < bands.value[c.x]) std::swap(c.x, c.y);
    if (bands.value[c.z] < bands.value[c.y]) std::swap(c.y, c.z);
    if (bands.value[c.y] < bands.value[c.x]) std::swap(c.x, c.y);
    const std::int32_t top = bands.low[t] + std::int32_t(bands.first[t + 1] - bands.first[t]) - 1;
    for (std::int32_t band = bands.low[t]; band < top; ++band) {
      const float level = float(band + 1) * bands.step;
      const auto at = [&](std::uint32_t a, std::uint32_t b) {
        const float va = bands.value[a], vb = bands.value[b];
        return glm::mix(mesh.positions[a], mesh.positions[b],
                        vb > va ? std::clamp((level - va) / (vb - va), 0.0f, 1.0f) : 0.0f);
      };
      const vec3 onLong = at(c.x, c.z);
      const vec3 onShort = level < bands.value[c.y] ? at(c.x, c.y) : at(c.y, c.z);
      links[{sets.find(bands.piece(t, band)), sets.find(bands.piece(t, band + 1))}].add(onLong, onShort);
    }
  }
  return links;
}

}  // namespace

AxisGraph reebGraph(const TriangleMesh& mesh, const MeshEdges& edges, std::span<const float> value,
                    float step) {
  const Bands bands(mesh, value, step);
  DisjointSets sets(bands.first.back());
  Checkpoints checkpoints;
  for (std::uint32_t e = 0; e < edges.size(); ++e) {
    checkpoints.pass();
    const auto triangles = edges.trianglesOf(e);
    const auto [low, high] = std::minmax({bands.of(edges.vertices[e].x), bands.of(edges.vertices[e].y)});
    for (std::size_t i = 1; i < triangles.size(); ++i)
      for (std::int32_t band = low; band <= high; ++band)
        sets.unite(bands.piece(triangles[0], band), bands.piece(triangles[i], band));
  }
  std::vector<std::uint32_t> firstAt(mesh.positions.size(), kNone);
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t vertex = mesh.triangles[t][k];
      const std::uint32_t piece = bands.piece(t, bands.of(vertex));
      if (firstAt[vertex] == kNone) firstAt[vertex] = piece;
      sets.unite(firstAt[vertex], piece);
    }
  const Links links = linkBands(mesh, bands, sets);

  // Every set that is linked becomes a node and every contour a chain of one point; compact() joins them.
  AxisGraph graph;
  std::map<std::uint32_t, std::uint32_t> nodeOf;
  std::vector<std::pair<dvec3, double>> middle;
  for (const auto& [sides, sum] : links) {
    AxisChain chain;
    for (const std::uint32_t set : {sides.first, sides.second})
      if (nodeOf.emplace(set, std::uint32_t(middle.size())).second) middle.emplace_back(dvec3(0), 0.0);
    chain.start = nodeOf[sides.first];
    chain.end = nodeOf[sides.second];
    chain.points = {sum.section()};
    chain.length = step;
    for (const std::uint32_t node : {chain.start, chain.end}) {
      middle[node].first += sum.moment;
      middle[node].second += sum.length;
    }
    graph.chains.push_back(std::move(chain));
  }
  for (const auto& [moment, length] : middle) graph.nodes.push_back(vec3(moment / length));
  compact(graph);
  return graph;
}

}  // namespace vasa
