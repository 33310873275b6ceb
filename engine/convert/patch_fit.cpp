#include "convert/patch_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "convert/unfold.h"
#include "mesh/edges.h"
#include "surface/reference.h"

namespace vasa {
namespace {

constexpr float kEased = 0.5f;      // weight from which on the wall turns into the tube
constexpr float kEaseLimit = 0.6f;  // of the radius: farther from the tube it stays as it is
constexpr int kRelaxations = 400;   // of relaxation

// Vertices on the wall's loops: its first ones.
std::size_t onLoops(const WallPiece& wall) {
  return std::accumulate(wall.loops.begin(), wall.loops.end(), std::size_t(0));
}

// Each vertex' share of each loop, by relaxation: neighbours count by their nearness.
std::vector<vec4> harmonicWeights(const WallPiece& wall) {
  const MeshEdges edges = buildEdges(wall.mesh);
  std::vector<vec4> weights(wall.mesh.positions.size(), vec4(0));
  std::size_t fixed = 0;
  for (std::size_t loop = 0; loop < wall.loops.size(); ++loop)
    for (std::uint32_t k = 0; k < wall.loops[loop]; ++k) weights[fixed++][int(loop)] = 1;
  for (std::size_t i = fixed; i < weights.size(); ++i)
    for (std::size_t loop = 0; loop < wall.loops.size(); ++loop)
      weights[i][int(loop)] = 1.0f / float(wall.loops.size());
  for (int round = 0; round < kRelaxations; ++round) {
    std::vector<vec4> sum(weights.size(), vec4(0));
    std::vector<float> total(weights.size());
    for (const uvec2& e : edges.vertices) {
      const float nearness =
          1 / std::max(glm::distance(wall.mesh.positions[e.x], wall.mesh.positions[e.y]), 1e-9f);
      sum[e.x] += nearness * weights[e.y], total[e.x] += nearness;
      sum[e.y] += nearness * weights[e.x], total[e.y] += nearness;
    }
    for (std::size_t i = fixed; i < weights.size(); ++i) weights[i] = sum[i] / total[i];
  }
  return weights;
}

// Towards the tube's wall beside a ring. @return whether the wall was near enough
bool easeIntoTubes(std::span<const ForkOpening> openings, std::span<const vec4> weights, WallPiece& wall) {
  std::size_t vertex = 0;
  const auto level = [](const WallOpening& o, vec3 p) {
    const vec3 d = p - o.centre;
    return d - glm::dot(d, o.outward) * o.outward;
  };
  for (std::size_t i = 0; i < openings.size(); ++i) {
    const WallOpening& o = openings[i].cut;
    for (std::uint32_t k = 0; k < wall.loops[i]; ++k, ++vertex) {
      const vec3 d = level(o, wall.mesh.positions[vertex]);
      if (glm::length(d) < 0.2f * o.radius) return false;
      wall.mesh.positions[vertex] = o.centre + o.radius * glm::normalize(d);
    }
    for (std::size_t v = onLoops(wall); v < wall.mesh.positions.size(); ++v) {
      const float t = std::clamp((weights[v][int(i)] - kEased) / (1 - kEased), 0.0f, 1.0f);
      const vec3 d = level(o, wall.mesh.positions[v]);
      const float size = glm::length(d), off = o.radius - size;
      if (t <= 0 || size < 0.2f * o.radius) continue;
      const float limit = std::max(0.0f, 1 - std::abs(off) / (kEaseLimit * o.radius));
      wall.mesh.positions[v] += (t * t * (3 - 2 * t) * limit * off / size) * d;
    }
  }
  return true;
}

// As they are drawn: across the vessel, where tubes go on (surface/patch.cpp).
std::vector<vec3> loopNormals(std::span<const ForkOpening> openings, const WallPiece& wall) {
  std::vector<vec3> normals;
  for (std::size_t i = 0; i < openings.size(); ++i)
    for (std::uint32_t k = 0; k < wall.loops[i]; ++k) {
      const vec3 d = wall.mesh.positions[normals.size()] - vec3(openings[i].section);
      normals.push_back(
          unitOr(d - glm::dot(d, openings[i].direction) * openings[i].direction, openings[i].direction));
    }
  return normals;
}

// Each loop once around its axis, without steps back.
bool runsAround(std::span<const ForkOpening> openings, const WallPiece& wall) {
  std::size_t first = 0;
  for (std::size_t i = 0; i < openings.size(); ++i) {
    const WallOpening& o = openings[i].cut;
    const std::uint32_t count = wall.loops[i];
    for (std::uint32_t k = 0; k < count; ++k) {
      const vec3 a = wall.mesh.positions[first + k] - o.centre,
                 b = wall.mesh.positions[first + (k + 1) % count] - o.centre;
      if (glm::dot(glm::cross(a, b), o.outward) < 0) return false;
    }
    first += count;
  }
  return true;
}

std::array<std::uint8_t, ForkPatch::kMostRings> rounded(const vec4& weights) {
  std::array<std::uint8_t, ForkPatch::kMostRings> bytes{};
  int left = 255;
  std::size_t most = 0;
  for (std::size_t k = 0; k < bytes.size(); ++k) {
    bytes[k] = std::uint8_t(std::clamp(255 * weights[int(k)], 0.0f, 255.0f));
    left -= bytes[k];
    if (weights[int(k)] > weights[int(most)]) most = k;
  }
  bytes[most] = std::uint8_t(bytes[most] + left);
  return bytes;
}

}  // namespace

ForkPatch fitPatch(std::span<const ForkOpening> openings, WallPiece wall) {
  const std::vector<vec4> weights = harmonicWeights(wall);
  if (!easeIntoTubes(openings, weights, wall) || !runsAround(openings, wall)) return {};
  unfold(wall.mesh, loopNormals(openings, wall));
  ForkPatch patch;
  for (std::size_t i = 0; i < openings.size(); ++i) {
    const ForkOpening& o = openings[i];
    patch.rings.push_back({o.vessel, o.parameter, vec3(o.section), o.direction, o.section.w, wall.loops[i]});
  }
  patch.positions = std::move(wall.mesh.positions);
  patch.triangles = std::move(wall.mesh.triangles);
  for (const vec4& w : weights) patch.weights.push_back(rounded(w));
  return patch;
}

}  // namespace vasa
