#include "convert/wall_thin.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "math/closest_point.h"

namespace vasa {
namespace {

constexpr int kPasses = 16;
constexpr std::uint32_t kFewestOnLoop = 8;
constexpr float kTurned = 0.6f;  // least cosine between a triangle before and after
constexpr float kNeedle = 0.1f;  // least double area, in squares of the longest edge

class Thinner {
 public:
  Thinner(const WallPiece& wall, float error) : error_(error), mesh_(wall.mesh), loops_(wall.loops) {
    around_.resize(mesh_.positions.size());
    spent_.resize(mesh_.positions.size());
    loopOf_.assign(mesh_.positions.size(), -1);
    for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t)
      for (int k = 0; k < 3; ++k) around_[mesh_.triangles[t][k]].push_back(t);
    std::size_t vertex = 0;
    for (std::size_t loop = 0; loop < loops_.size(); ++loop)
      for (std::uint32_t k = 0; k < loops_[loop]; ++k) loopOf_[vertex++] = int(loop);
  }

  WallPiece run() {
    bool changed = true;
    for (int pass = 0; pass < kPasses && changed; ++pass) {
      changed = false;
      for (std::uint32_t u = 0; u < around_.size(); ++u) changed = moveAway(u) || changed;
    }
    return rest();
  }

 private:
  std::vector<std::uint32_t> neighbours(std::uint32_t u) const {
    std::vector<std::uint32_t> all;
    for (const std::uint32_t t : around_[u])
      for (int k = 0; k < 3; ++k)
        if (const std::uint32_t v = mesh_.triangles[t][k]; v != u && std::ranges::find(all, v) == all.end())
          all.push_back(v);
    return all;
  }

  bool moveAway(std::uint32_t u) {
    if (around_[u].empty() || (loopOf_[u] >= 0 && loops_[std::size_t(loopOf_[u])] <= kFewestOnLoop))
      return false;
    std::vector<std::uint32_t> to = neighbours(u);
    const std::vector<std::uint32_t> own = to;
    std::ranges::sort(to, [&](std::uint32_t a, std::uint32_t b) {
      const float da = glm::distance(mesh_.positions[a], mesh_.positions[u]),
                  db = glm::distance(mesh_.positions[b], mesh_.positions[u]);
      return da != db ? da < db : a < b;
    });
    for (const std::uint32_t v : to)
      if (const float cost = costOf(u, v, own); cost >= 0) {
        collapse(u, v, cost);
        return true;
      }
    return false;
  }

  bool holds(std::uint32_t triangle, std::uint32_t v) const {
    const uvec3& t = mesh_.triangles[triangle];
    return t.x == v || t.y == v || t.z == v;
  }
  std::size_t shared(std::uint32_t u, std::uint32_t v) const {
    return std::size_t(std::ranges::count_if(around_[u], [&](std::uint32_t t) { return holds(t, v); }));
  }

  // What moving u onto v adds to its error; below 0 where that may not be.
  float costOf(std::uint32_t u, std::uint32_t v, std::span<const std::uint32_t> own) const {
    const std::size_t both = shared(u, v);
    const bool onLoop = loopOf_[u] >= 0;
    if (onLoop ? loopOf_[v] != loopOf_[u] || both != 1 : both != 2) return -1;
    const std::vector<std::uint32_t> others = neighbours(v);
    if (std::size_t(std::ranges::count_if(
            own, [&](std::uint32_t n) { return std::ranges::find(others, n) != others.end(); })) != both)
      return -1;
    const vec3 &from = mesh_.positions[u], &to = mesh_.positions[v];
    float cost = 0;
    if (onLoop)
      for (const std::uint32_t w : own)
        if (w != v && loopOf_[w] == loopOf_[u] && shared(u, w) == 1) {
          const vec3 before = mesh_.positions[w];
          cost =
              std::max(cost, glm::distance(from, glm::mix(before, to, closestOnSegment(from, before, to))));
        }
    for (const std::uint32_t t : around_[u]) {
      if (holds(t, v)) continue;
      std::array<vec3, 3> old, now;
      for (int k = 0; k < 3; ++k) {
        old[std::size_t(k)] = mesh_.positions[mesh_.triangles[t][k]];
        now[std::size_t(k)] = mesh_.triangles[t][k] == u ? to : old[std::size_t(k)];
      }
      const vec3 a = glm::cross(old[1] - old[0], old[2] - old[0]),
                 b = glm::cross(now[1] - now[0], now[2] - now[0]);
      const float size = glm::length(b);
      const float longest = std::max(
          {glm::distance(now[0], now[1]), glm::distance(now[1], now[2]), glm::distance(now[2], now[0])});
      if (size < kNeedle * longest * longest || glm::dot(a, b) < kTurned * glm::length(a) * size) return -1;
      cost = std::max(cost, std::abs(glm::dot(from - now[0], b)) / size);
    }
    return spent_[u] + cost <= error_ ? cost : -1;
  }

  void collapse(std::uint32_t u, std::uint32_t v, float cost) {
    spent_[v] = std::max(spent_[v], spent_[u] + cost);
    for (const std::uint32_t t : around_[u]) {
      uvec3& corners = mesh_.triangles[t];
      if (holds(t, v)) {
        for (int k = 0; k < 3; ++k)
          if (corners[k] != u) std::erase(around_[corners[k]], t);
        corners = uvec3(u);
        continue;
      }
      for (int k = 0; k < 3; ++k)
        if (corners[k] == u) corners[k] = v;
      around_[v].push_back(t);
    }
    around_[u].clear();
    if (loopOf_[u] >= 0) --loops_[std::size_t(loopOf_[u])];
  }

  WallPiece rest() const {
    WallPiece thin{WallFault::none, {}, loops_};
    std::vector<std::uint32_t> number(around_.size());
    for (std::uint32_t v = 0; v < around_.size(); ++v) {  // loops stay in front and in order
      number[v] = std::uint32_t(thin.mesh.positions.size());
      if (!around_[v].empty()) thin.mesh.positions.push_back(mesh_.positions[v]);
    }
    for (const uvec3& t : mesh_.triangles)
      if (t.x != t.y) thin.mesh.triangles.push_back({number[t.x], number[t.y], number[t.z]});
    return thin;
  }

  float error_;
  TriangleMesh mesh_;
  std::vector<std::uint32_t> loops_;
  std::vector<std::vector<std::uint32_t>> around_;  // triangles of each vertex; none: it is gone
  std::vector<float> spent_;                        // of the error
  std::vector<int> loopOf_;
};

}  // namespace

WallPiece thinned(const WallPiece& wall, float error) { return Thinner(wall, error).run(); }

}  // namespace vasa
