#include "io/chain_lines.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <tuple>

#include "core/cancellation.h"
#include "core/ids.h"

namespace vasa {
namespace {

constexpr float kSamePlace = 0.05f;        // of a radius
constexpr float kTurnsBack = 0.87f;        // cosine: within 30 degrees of the way it came
constexpr std::size_t kMostLookedAt = 64;  // samples in a slab of that width: more are another scale's

struct Edge {
  std::uint32_t a, b;  // places
  std::uint32_t line;
};

class Graph {
 public:
  explicit Graph(const std::vector<std::vector<vec4>>& lines) {
    collect(lines);
    weld(lines);
    addEdges(lines);
    pairAtForks();
  }

  std::vector<std::vector<vec4>> chains() {
    std::vector<std::vector<vec4>> result;
    used_.assign(edges_.size(), false);
    // First those with an end, then closed ones from wherever they were told first.
    for (const bool closed : {false, true})
      for (std::uint32_t e = 0; e < edges_.size(); ++e)
        for (const std::uint32_t from : {edges_[e].a, edges_[e].b})
          if (!used_[e] && (closed || nextOf(e, from) == kNone)) result.push_back(follow(e, from));
    return result;
  }

 private:
  static bool before(const vec4& a, const vec4& b) {
    return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
  }
  static bool same(const vec4& a, const vec4& b) { return vec3(a) == vec3(b); }

  void collect(const std::vector<std::vector<vec4>>& lines) {
    for (const auto& line : lines) points_.insert(points_.end(), line.begin(), line.end());
    std::ranges::stable_sort(points_, before);
    points_.erase(std::unique(points_.begin(), points_.end(), same), points_.end());
    same_.resize(points_.size());
    std::iota(same_.begin(), same_.end(), 0u);
  }
  std::uint32_t numberOf(const vec4& sample) const {
    return std::uint32_t(std::lower_bound(points_.begin(), points_.end(), sample, before) - points_.begin());
  }
  std::uint32_t root(std::uint32_t i) {
    while (same_[i] != i) i = same_[i] = same_[same_[i]];
    return i;
  }

  // Ends that miss the sample they mean by rounding.
  void weld(const std::vector<std::vector<vec4>>& lines) {
    Checkpoints checkpoints;
    for (const auto& line : lines)
      for (const bool last : {false, true}) {
        checkpoints.pass();
        const vec4 end = last ? line.back() : line.front(),
                   neighbour = last ? line[line.size() - 2] : line[1];
        // Not so far that it could be its own line's next sample.
        const float reach = std::min(kSamePlace * end.w, 0.25f * glm::distance(vec3(end), vec3(neighbour)));
        const std::uint32_t own = numberOf(end);
        std::uint32_t nearest = kNone;
        float least = reach;
        const auto look = [&](std::uint32_t i) {
          if (const float d = glm::distance(vec3(points_[i]), vec3(end));
              d <= least && !same(points_[i], neighbour))
            least = d, nearest = i;
        };
        for (std::uint32_t i = own + 1, seen = 0;
             i < points_.size() && points_[i].x - end.x <= reach && seen < kMostLookedAt; ++i, ++seen)
          look(i);
        for (std::uint32_t i = own, seen = 0;
             i-- > 0 && end.x - points_[i].x <= reach && seen < kMostLookedAt; ++seen)
          look(i);
        if (nearest != kNone) same_[root(own)] = root(nearest);
      }
  }

  void addEdges(const std::vector<std::vector<vec4>>& lines) {
    std::vector<std::pair<std::uint64_t, std::size_t>> keys;
    for (std::uint32_t l = 0; l < lines.size(); ++l)
      for (std::size_t i = 1; i < lines[l].size(); ++i) {
        const auto& line = lines[l];
        const std::uint32_t a = root(numberOf(line[i - 1])), b = root(numberOf(line[i]));
        if (a == b) continue;
        keys.push_back({std::uint64_t(std::min(a, b)) << 32 | std::max(a, b), edges_.size()});
        edges_.push_back({a, b, l});
      }
    // Of doubles the first told stays, in the order of the file.
    std::ranges::sort(keys);
    std::vector<bool> repeated(edges_.size());
    for (std::size_t k = 1; k < keys.size(); ++k)
      repeated[keys[k].second] = keys[k].first == keys[k - 1].first;
    std::vector<Edge> kept;
    for (std::size_t e = 0; e < edges_.size(); ++e)
      if (!repeated[e]) kept.push_back(edges_[e]);
    edges_ = std::move(kept);
  }

  std::uint32_t other(std::uint32_t edge, std::uint32_t node) const {
    return edges_[edge].a == node ? edges_[edge].b : edges_[edge].a;
  }

  // Of the edges that meet in a place, the two that are one vessel's. Two lines that begin in one inlet, or
  // end in one outlet, and go the same way are two traces of one vessel, not one that goes back the way it
  // came.
  void pairAtForks() {
    next_.assign(2 * edges_.size(), kNone);
    std::vector<std::pair<std::uint32_t, std::uint32_t>> at;  // place, edge
    at.reserve(2 * edges_.size());
    for (std::uint32_t e = 0; e < edges_.size(); ++e)
      at.push_back({edges_[e].a, e}), at.push_back({edges_[e].b, e});
    std::ranges::sort(at);
    std::vector<std::uint32_t> own;
    for (std::size_t first = 0; first < at.size();) {
      const std::uint32_t node = at[first].first;
      own.clear();
      for (; first < at.size() && at[first].first == node; ++first) own.push_back(at[first].second);
      if (own.size() < 2 || own.size() > kMostLookedAt) continue;
      // Radii of nothing leave no fit that is a number: none pair.
      float best = -4;
      std::pair<std::uint32_t, std::uint32_t> pair{kNone, kNone};
      for (std::size_t i = 0; i < own.size(); ++i)
        for (std::size_t k = i + 1; k < own.size(); ++k) {
          const vec4 &p = points_[other(own[i], node)], &q = points_[other(own[k], node)];
          const vec3 a = glm::normalize(vec3(p - points_[node])), b = glm::normalize(vec3(q - points_[node]));
          const Edge &e = edges_[own[i]], &f = edges_[own[k]];
          if (e.line != f.line && (e.a == node) == (f.a == node) && glm::dot(a, b) > kTurnsBack) continue;
          const float fit = -glm::dot(a, b) + 0.5f * std::min(p.w, q.w) / std::max(p.w, q.w);
          if (fit > best) best = fit, pair = {own[i], own[k]};
        }
      if (pair.first == kNone) continue;
      next_[slot(pair.first, node)] = pair.second;
      next_[slot(pair.second, node)] = pair.first;
    }
  }
  std::size_t slot(std::uint32_t edge, std::uint32_t node) const {
    return 2 * std::size_t(edge) + (edges_[edge].b == node);
  }
  std::uint32_t nextOf(std::uint32_t edge, std::uint32_t node) const { return next_[slot(edge, node)]; }

  std::vector<vec4> follow(std::uint32_t edge, std::uint32_t from) {
    std::vector<vec4> line{points_[from]};
    std::uint32_t node = from;
    while (edge != kNone && !used_[edge]) {
      used_[edge] = true;
      node = other(edge, node);
      line.push_back(points_[node]);
      edge = nextOf(edge, node);
    }
    return line;
  }

  std::vector<vec4> points_;
  std::vector<std::uint32_t> same_, next_;
  std::vector<Edge> edges_;
  std::vector<bool> used_;
};

}  // namespace

std::vector<std::vector<vec4>> chainLines(const std::vector<std::vector<vec4>>& lines) {
  return Graph(lines).chains();
}

}  // namespace vasa
