#include "mesh/level_set.h"

#include <cmath>
#include <limits>
#include <queue>

#include "core/cancellation.h"

namespace vasa {
namespace {

// Arrival at c of a straight front that passes a at ta and b at tb, if it comes from inside the angle a-c-b;
// otherwise along the nearer edge. With x = distances along ab in a's frame, c = (p, q), q > 0:
// the front's unit direction is (s, sqrt(1 - s²)), s = (tb - ta) / |ab|.
double arrival(dvec3 a, dvec3 b, dvec3 c, double ta, double tb) {
  const double alongEdges = std::min(ta + glm::distance(a, c), tb + glm::distance(b, c));
  const double length = glm::distance(a, b);
  if (!(length > 0) || !(std::abs(tb - ta) < length)) return alongEdges;
  const dvec3 x = (b - a) / length;
  const double p = glm::dot(c - a, x);
  const double q = glm::length(c - a - p * x);
  const double s = (tb - ta) / length, h = std::sqrt(1 - s * s);
  if (!(h > 0)) return alongEdges;
  const double foot = p - q * s / h;  // where the ray that reaches c crosses ab
  if (foot < 0 || foot > length) return alongEdges;
  return std::min(alongEdges, ta + p * s + q * h);
}

}  // namespace

std::vector<float> surfaceDistance(const TriangleMesh& mesh, const VertexTriangles& around,
                                   std::span<const std::uint32_t> sources) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  std::vector<double> time(mesh.positions.size(), kInfinity);
  std::vector<bool> settled(mesh.positions.size(), false);
  using Entry = std::pair<double, std::uint32_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> front;
  for (const std::uint32_t v : sources) {
    time[v] = 0;
    front.push({0, v});
  }
  Checkpoints checkpoints;
  while (!front.empty()) {
    checkpoints.pass();
    const auto [t, v] = front.top();
    front.pop();
    if (settled[v]) continue;
    settled[v] = true;
    for (const std::uint32_t triangle : around.of(v)) {
      const uvec3& corners = mesh.triangles[triangle];
      for (int k = 0; k < 3; ++k) {
        const std::uint32_t c = corners[k];
        if (settled[c]) continue;
        const std::uint32_t other = corners.x + corners.y + corners.z - v - c;
        const dvec3 pv(mesh.positions[v]), pc(mesh.positions[c]);
        double candidate = t + glm::distance(pv, pc);
        if (settled[other])
          candidate = std::min(candidate, arrival(pv, dvec3(mesh.positions[other]), pc, t, time[other]));
        if (candidate < time[c]) {
          time[c] = candidate;
          front.push({candidate, c});
        }
      }
    }
  }
  return {time.begin(), time.end()};
}

std::uint32_t farthest(std::span<const float> distance) {
  std::uint32_t best = 0;
  float most = -1;
  for (std::uint32_t i = 0; i < distance.size(); ++i)
    if (std::isfinite(distance[i]) && distance[i] > most) most = distance[i], best = i;
  return best;
}

}  // namespace vasa
