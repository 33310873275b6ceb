#include "convert/rings.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/cancellation.h"
#include "core/ids.h"

namespace vasa {
namespace {

struct Neighbours {
  std::vector<std::uint32_t> first, vertices;
  Neighbours(const TriangleMesh& mesh, const MeshEdges& edges) : first(mesh.positions.size() + 1, 0) {
    for (const uvec2& e : edges.vertices) ++first[e.x + 1], ++first[e.y + 1];
    std::partial_sum(first.begin(), first.end(), first.begin());
    vertices.resize(first.back());
    std::vector<std::uint32_t> next(first.begin(), first.end() - 1);
    for (const uvec2& e : edges.vertices) vertices[next[e.x]++] = e.y, vertices[next[e.y]++] = e.x;
  }
  std::span<const std::uint32_t> of(std::uint32_t v) const {
    return std::span(vertices).subspan(first[v], first[v + 1] - first[v]);
  }
};

using Ring = std::vector<std::uint32_t>;

// The layer's vertices in the order of one closed loop through all of them; empty where they are not one.
Ring closedLoop(const Ring& layer, const std::vector<std::uint32_t>& layerOf, const Neighbours& neighbours) {
  if (layer.size() < 3) return {};
  const std::uint32_t number = layerOf[layer[0]];
  Ring loop{layer[0]};
  std::uint32_t before = kNone;
  while (true) {
    std::uint32_t inside = 0, next = kNone;
    for (const std::uint32_t v : neighbours.of(loop.back()))
      if (layerOf[v] == number) {
        ++inside;
        if (v != before && (next == kNone || v < next)) next = v;
      }
    if (inside != 2 || next == kNone) return {};
    if (next == loop.front()) break;
    before = loop.back();
    loop.push_back(next);
    if (loop.size() > layer.size()) return {};
  }
  return loop.size() == layer.size() ? loop : Ring{};
}

std::vector<Ring> layersFrom(const Ring& start, std::size_t vertexCount, const Neighbours& neighbours,
                             std::vector<std::uint32_t>& layerOf) {
  layerOf.assign(vertexCount, kNone);
  std::vector<Ring> layers{start};
  for (const std::uint32_t v : start) layerOf[v] = 0;
  while (true) {
    checkpoint();
    Ring next;
    for (const std::uint32_t v : layers.back())
      for (const std::uint32_t w : neighbours.of(v))
        if (layerOf[w] == kNone) {
          layerOf[w] = std::uint32_t(layers.size());
          next.push_back(w);
        }
    if (next.empty()) return layers;
    layers.push_back(std::move(next));
  }
}

// Centroid and vector area of a loop (Newell), as a fan around its mean point.
struct LoopArea {
  dvec3 centre{0}, area{0};
};
LoopArea areaOf(const TriangleMesh& mesh, const Ring& loop) {
  dvec3 mean(0);
  for (const std::uint32_t v : loop) mean += dvec3(mesh.positions[v]) / double(loop.size());
  LoopArea result;
  std::vector<dvec3> part;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const dvec3 a(mesh.positions[loop[i]]), b(mesh.positions[loop[(i + 1) % loop.size()]]);
    part.push_back(0.5 * glm::cross(a - mean, b - mean));
    result.area += part.back();
  }
  const double length = glm::length(result.area);
  if (!(length > 0)) return {mean, dvec3(0)};
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const dvec3 a(mesh.positions[loop[i]]), b(mesh.positions[loop[(i + 1) % loop.size()]]);
    result.centre += (mean + a + b) / 3.0 * glm::dot(part[i], result.area) / (length * length);
  }
  return result;
}

std::vector<vec4> sectionsOf(const TriangleMesh& mesh, const std::vector<Ring>& rings) {
  std::vector<LoopArea> loops;
  for (const Ring& ring : rings) loops.push_back(areaOf(mesh, ring));
  std::vector<vec4> sections;
  for (std::size_t i = 0; i < loops.size(); ++i) {
    const dvec3 chord = loops[std::min(i + 1, loops.size() - 1)].centre - loops[i > 0 ? i - 1 : 0].centre;
    const double length = glm::length(chord);
    if (!(length > 0)) return {};
    const double area = std::abs(glm::dot(loops[i].area, chord / length));
    if (!(area > 0)) return {};
    sections.push_back(vec4(vec3(loops[i].centre), float(std::sqrt(area / double(kPi)))));
  }
  return sections;
}

std::optional<std::vector<vec4>> ringsFrom(const TriangleMesh& mesh, const Ring& start,
                                           const Neighbours& neighbours) {
  std::vector<std::uint32_t> layerOf;
  const std::vector<Ring> layers = layersFrom(start, mesh.positions.size(), neighbours, layerOf);
  std::vector<Ring> rings;
  std::size_t inRings = 0, firstLayer = 0, lastLayer = 0;
  for (std::size_t i = 0; i < layers.size(); ++i) {
    Ring ring = closedLoop(layers[i], layerOf, neighbours);
    if (ring.empty()) continue;
    if (rings.empty())
      firstLayer = i;
    else if (lastLayer + 1 != i)
      return std::nullopt;  // something else between the rings
    lastLayer = i;
    inRings += ring.size();
    rings.push_back(std::move(ring));
  }
  if (rings.size() < 3 || float(inRings) < kRingShare * float(mesh.positions.size())) return std::nullopt;
  std::vector<vec4> sections = sectionsOf(mesh, rings);
  if (sections.empty()) return std::nullopt;
  // What closes an end beyond its last ring: a lid that stands out gets a section of half the radius on it.
  const auto lid = [&](std::size_t from, std::size_t to, const vec4& ring) -> std::optional<vec4> {
    vec3 tip(ring);
    for (std::size_t i = from; i < to; ++i)
      for (const std::uint32_t v : layers[i])
        if (glm::distance(mesh.positions[v], vec3(ring)) > glm::distance(tip, vec3(ring)))
          tip = mesh.positions[v];
    const vec3 middle = vec3(ring) + 0.9f * (tip - vec3(ring));
    if (from == to || glm::distance(tip, vec3(ring)) < 0.2f * ring.w) return std::nullopt;
    return vec4(middle, 0.5f * ring.w);
  };
  if (const auto end = lid(lastLayer + 1, layers.size(), sections.back())) sections.push_back(*end);
  if (const auto begin = lid(0, firstLayer, sections.front())) sections.insert(sections.begin(), *begin);
  return sections;
}

}  // namespace

std::optional<std::vector<vec4>> traceRings(const TriangleMesh& mesh, const MeshEdges& edges,
                                            std::span<const BoundaryLoop> loops) {
  const Neighbours neighbours(mesh, edges);
  std::vector<Ring> starts;
  for (const BoundaryLoop& loop : loops)
    if (starts.size() < 2) starts.push_back(loop.vertices);
  if (loops.size() < 2) {
    // Fans: the vertices with the most neighbours.
    std::vector<std::uint32_t> order(mesh.positions.size());
    std::iota(order.begin(), order.end(), 0u);
    const std::size_t count = std::min<std::size_t>(2, order.size());
    std::partial_sort(order.begin(), order.begin() + std::ptrdiff_t(count), order.end(),
                      [&](std::uint32_t a, std::uint32_t b) {
                        const auto na = neighbours.of(a).size(), nb = neighbours.of(b).size();
                        return na != nb ? na > nb : a < b;
                      });
    for (std::size_t i = 0; i < count; ++i) starts.push_back({order[i]});
  }
  for (const Ring& start : starts)
    if (auto sections = ringsFrom(mesh, start, neighbours)) return sections;
  return std::nullopt;
}

}  // namespace vasa
