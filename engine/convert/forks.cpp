#include "convert/forks.h"

#include <algorithm>
#include <optional>

namespace vasa {
namespace {

// A branch's trimmed end, looking towards the fork.
struct Arm {
  ChainEnd end;
  vec3 position, direction;
  float radius;
};

std::optional<Arm> armOf(const ChainEnd& end, const std::vector<vec4>& sections) {
  if (sections.size() < 2) return std::nullopt;
  const auto at = [&](std::size_t i) { return end.last ? sections[sections.size() - 1 - i] : sections[i]; };
  const vec4 first = at(0);
  // A chord of about two radii: single sections jitter.
  std::size_t i = 1;
  while (i + 1 < sections.size() && glm::distance(vec3(at(i)), vec3(first)) < 2 * first.w) ++i;
  const vec3 chord = vec3(first) - vec3(at(i));
  const float length = glm::length(chord);
  if (!(length > 0)) return std::nullopt;
  return Arm{end, vec3(first), chord / length, first.w};
}

vec3 hermite(vec3 a, vec3 directionA, vec3 b, vec3 directionB, float t) {
  const float length = glm::distance(a, b), s = 1 - t;
  const vec3 b1 = a + directionA * (length / 3), b2 = b + directionB * (length / 3);
  return s * s * s * a + 3 * s * s * t * b1 + 3 * s * t * t * b2 + t * t * t * b;
}

vec3 placeNode(const std::vector<Arm>& arms, vec3 rough) {
  if (arms.size() < 2) return rough;
  std::size_t i = 0, j = 1;
  float best = -2;
  for (std::size_t a = 0; a < arms.size(); ++a)
    for (std::size_t b = a + 1; b < arms.size(); ++b) {
      const float straight = -glm::dot(arms[a].direction, arms[b].direction);
      const float alike = std::min(arms[a].radius, arms[b].radius) / std::max(arms[a].radius, arms[b].radius);
      if (straight + alike > best) best = straight + alike, i = a, j = b;
    }
  vec3 chosen = rough;
  float least = std::numeric_limits<float>::infinity();
  for (int step = 0; step <= 16; ++step) {
    const vec3 p =
        hermite(arms[i].position, arms[i].direction, arms[j].position, arms[j].direction, float(step) / 16);
    float miss = arms.size() > 2 ? 0 : glm::distance(p, rough);
    for (std::size_t k = 0; k < arms.size(); ++k) {
      if (k == i || k == j) continue;
      const vec3 d = p - arms[k].position;
      const float along = std::max(0.0f, glm::dot(d, arms[k].direction));
      miss += glm::distance(d, along * arms[k].direction);
    }
    if (miss < least) least = miss, chosen = p;
  }
  return chosen;
}

// Sections from an arm's end to the node, without the first and with the last.
std::vector<vec4> lead(const Arm& arm, vec3 node, float widest, const TriangleTree& surface) {
  const float length = glm::distance(arm.position, node);
  const int count = std::clamp(int(length / std::max(0.6f * arm.radius, 1e-9f)), 1, 8);
  std::vector<vec4> sections;
  const vec3 towards = length > 0 ? (node - arm.position) / length : arm.direction;
  for (int i = 1; i <= count; ++i) {
    const float t = float(i) / float(count), s = 1 - t;
    // Leaves the arm along its direction; arrives straight.
    const vec3 b1 = arm.position + arm.direction * (length / 3), b2 = node - towards * (length / 3);
    const vec3 p =
        i == count ? node
                   : s * s * s * arm.position + 3 * s * s * t * b1 + 3 * s * t * t * b2 + t * t * t * node;
    const float clearance = std::min(surface.nearest(p, widest).distance, widest);
    sections.push_back(vec4(p, std::max(arm.radius, clearance)));
  }
  return sections;
}

float medianOf(std::vector<vec4> points) {
  if (points.empty()) return 0;
  const auto middle = points.begin() + std::ptrdiff_t(points.size() / 2);
  std::nth_element(points.begin(), middle, points.end(),
                   [](const vec4& a, const vec4& b) { return a.w < b.w; });
  return middle->w;
}

}  // namespace

void connectForks(AxisGraph& graph, std::vector<std::vector<vec4>>& sections, const TriangleTree& surface) {
  const auto ends = chainEnds(graph);
  const auto trimmed = sections;
  for (std::uint32_t node = 0; node < graph.nodes.size(); ++node) {
    std::vector<Arm> arms;
    for (const ChainEnd& end : ends[node])
      if (const auto arm = armOf(end, trimmed[end.chain])) arms.push_back(*arm);
    if (ends[node].size() > 1)
      graph.nodes[node] = placeNode(arms, graph.nodes[node]);
    else if (!arms.empty())
      graph.nodes[node] = arms[0].position;
    if (ends[node].size() < 2) continue;
    float widest = 0;
    for (const Arm& arm : arms) widest = std::max(widest, arm.radius);
    for (const Arm& arm : arms) {
      auto& list = sections[arm.end.chain];
      const auto added = lead(arm, graph.nodes[node], widest, surface);
      if (arm.end.last)
        list.insert(list.end(), added.begin(), added.end());
      else
        list.insert(list.begin(), added.rbegin(), added.rend());
    }
  }
  for (std::uint32_t i = 0; i < graph.chains.size(); ++i) {
    const AxisChain& chain = graph.chains[i];
    if (sections[i].size() >= 2) continue;
    const float radius = medianOf(chain.points);
    sections[i] = {vec4(graph.nodes[chain.start], radius), vec4(graph.nodes[chain.end], radius)};
  }
}

}  // namespace vasa
