#include "avoid/way.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>
#include <utility>

namespace vasa {
namespace {

constexpr float kFinest = 4e-4f;        // [m] of the grid
constexpr int kMostCells = 96;          // ... a side
constexpr std::size_t kMostLooked = 150'000;
constexpr float kStraightOn = 1.5f;     // times the way ahead counts: not the very shortest, much sooner
constexpr float kNearRather = 0.01f;    // [m] from the stretch, at which a way costs twice as much
constexpr float kAtEnds = 5;            // what a way costs that lacks room near the ends
constexpr int kPulls = 200;
constexpr std::size_t kSmooth = 12;      // places on both sides
constexpr float kNever = std::numeric_limits<float>::infinity();

class Search {
 public:
  Search(const StretchLine& line, const Room& room, float need)
      : line_(line), room_(room), need_(need), start_(line.places.front()), goal_(line.places.back()) {
    Aabb box;
    for (const vec3& place : line.places) box.add(place, kWayAside);
    const vec3 size = box.extent();
    step_ = std::max(kFinest, std::max({size.x, size.y, size.z}) / kMostCells);
    counts_ = ivec3(size / step_) + 2;
    origin_ = start_ - step_ * glm::floor((start_ - box.low) / step_);  // the way begins on the grid
    nodes_.resize(std::size_t(counts_.x) * std::size_t(counts_.y) * std::size_t(counts_.z));
  }

  std::vector<vec3> run() {
    const std::uint32_t first = indexOf(ivec3(glm::round((start_ - origin_) / step_)));
    nodes_[first].cost = 0;
    open_.push({0, first});
    for (std::size_t looked = 0; !open_.empty() && looked < kMostLooked;) {
      const std::uint32_t index = open_.top().second;
      open_.pop();
      if (std::exchange(nodes_[index].done, true)) continue;
      ++looked;
      if (glm::distance(placeOf(cellAt(index)), goal_) <= step_) return wayTo(index);
      goOn(index);
    }
    return {};
  }

 private:
  static constexpr std::uint32_t kNowhere = ~0u;
  struct Node {
    float cost = kNever;
    float price = 0;  // of a metre; 0: not looked at, below: no room
    std::uint32_t from = kNowhere;
    bool done = false;
  };

  vec3 placeOf(ivec3 cell) const { return origin_ + step_ * vec3(cell); }
  std::uint32_t indexOf(ivec3 c) const { return std::uint32_t((c.z * counts_.y + c.y) * counts_.x + c.x); }
  ivec3 cellAt(std::uint32_t i) const { return {int(i) % counts_.x, int(i) / counts_.x % counts_.y, int(i) / (counts_.x * counts_.y)}; }

  float priceOf(vec3 place) const {
    const std::uint32_t nearest = line_.nearest(place);
    if (room_.at(place, need_, line_.tubes[nearest]) >= need_) return 1 + glm::distance(place, line_.places[nearest]) / kNearRather;
    return std::min(glm::distance(place, start_), glm::distance(place, goal_)) < need_ + 2 * step_ ? kAtEnds : -1;
  }

  void goOn(std::uint32_t index) {
    const ivec3 cell = cellAt(index);
    for (int k = 0; k < 27; ++k) {
      const ivec3 next = cell + ivec3(k % 3, k / 3 % 3, k / 9) - 1;
      if (glm::any(glm::lessThan(next, ivec3(0))) || glm::any(glm::greaterThanEqual(next, counts_))) continue;
      Node& node = nodes_[indexOf(next)];
      if (node.done) continue;
      const vec3 place = placeOf(next);
      if (node.price == 0) node.price = priceOf(place);
      if (node.price < 0) continue;
      const float cost = nodes_[index].cost + glm::distance(placeOf(cell), place) * node.price;
      if (cost >= node.cost) continue;
      node.cost = cost;
      node.from = index;
      open_.push({cost + kStraightOn * glm::distance(place, goal_), indexOf(next)});
    }
  }

  std::vector<vec3> wayTo(std::uint32_t index) const {
    std::vector<vec3> way{goal_};
    for (; nodes_[index].from != kNowhere; index = nodes_[index].from) way.push_back(placeOf(cellAt(index)));
    way.push_back(start_);
    std::ranges::reverse(way);
    return way;
  }

  using Entry = std::pair<float, std::uint32_t>;  // ties by number: one order everywhere
  const StretchLine& line_;
  const Room& room_;
  float need_, step_ = 0;
  vec3 start_, goal_, origin_{0};
  ivec3 counts_{0};
  std::vector<Node> nodes_;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open_;
};

std::vector<vec3> evenly(std::span<const vec3> way, std::size_t count) {
  std::vector<float> arcs{0};
  for (std::size_t k = 1; k < way.size(); ++k) arcs.push_back(arcs.back() + glm::distance(way[k - 1], way[k]));
  std::vector<vec3> out;
  std::size_t k = 1;
  for (std::size_t i = 0; i < count; ++i) {
    const float arc = arcs.back() * float(i) / float(count - 1);
    while (k + 1 < way.size() && arcs[k] < arc) ++k;
    const float piece = arcs[k] - arcs[k - 1];
    out.push_back(glm::mix(way[k - 1], way[k], piece > 0 ? std::clamp((arc - arcs[k - 1]) / piece, 0.0f, 1.0f) : 0.0f));
  }
  return out;
}

void pullStraight(const StretchLine& line, const Room& room, float wanted, std::vector<vec3>& way) {
  const auto roomAt = [&](vec3 p) { return room.at(p, wanted, line.tubes[line.nearest(p)]); };
  for (int pull = 0; pull < kPulls; ++pull)
    for (std::size_t k = 1; k + 1 < way.size(); ++k) {
      const vec3 middle = 0.5f * (way[k - 1] + way[k + 1]);
      if (roomAt(middle) >= roomAt(way[k])) way[k] = middle;
    }
}

}  // namespace

std::vector<vec3> findWay(const StretchLine& line, const Room& room, float need) {
  std::vector<vec3> way = Search(line, room, need).run();
  if (way.empty()) return way;
  way = evenly(way, line.places.size());
  pullStraight(line, room, need + kWayRoom, way);
  return evenly(way, line.places.size());
}

std::vector<float> placesAlong(std::span<const vec3> way, std::span<const vec3> line) {
  const std::size_t n = line.size(), m = way.size();
  std::vector<float> cost(n * m);
  const auto at = [&](std::size_t k, std::size_t j, std::size_t lineBack, std::size_t wayBack) {
    return k >= lineBack && j >= wayBack ? cost[(k - lineBack) * m + j - wayBack] : kNever;
  };
  for (std::size_t k = 0; k < n; ++k)
    for (std::size_t j = 0; j < m; ++j) {
      const vec3 gap = line[k] - way[j];
      const float before = k + j == 0 ? 0 : std::min({at(k, j, 1, 0), at(k, j, 0, 1), at(k, j, 1, 1)});
      cost[k * m + j] = before + glm::dot(gap, gap);
    }
  std::vector<float> sums(n, 0), counts(n, 0), places(n);
  for (std::size_t k = n - 1, j = m - 1;;) {
    sums[k] += float(j), ++counts[k];
    if (k + j == 0) break;
    const float both = at(k, j, 1, 1), ownOnly = at(k, j, 1, 0), wayOnly = at(k, j, 0, 1);
    if (both <= std::min(ownOnly, wayOnly)) --k, --j;
    else if (ownOnly <= wayOnly) --k;
    else --j;
  }
  for (std::size_t k = 0; k < n; ++k) sums[k] /= counts[k];
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t half = std::min({kSmooth, k, n - 1 - k});
    places[k] = 0;
    for (std::size_t i = k - half; i <= k + half; ++i) places[k] += sums[i] / float(2 * half + 1);
  }
  places.front() = 0;
  places.back() = float(m - 1);
  return places;
}

}  // namespace vasa
