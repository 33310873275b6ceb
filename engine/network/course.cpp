#include "network/course.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <queue>

#include "curve/bspline.h"

namespace vasa {
namespace {

struct Neighbour {
  std::uint32_t place;
  double length;
};
using Neighbours = std::vector<std::vector<Neighbour>>;

// How every place that one can come to is reached from a place (Dijkstra 1959). Made once, for many.
class Reach {
 public:
  explicit Reach(const Neighbours& neighbours)
      : neighbours_(neighbours), lengths_(neighbours.size(), kFar), before_(neighbours.size()) {}

  /// O(reached log reached)
  void from(std::uint32_t start) {
    for (const std::uint32_t place : reached_) lengths_[place] = kFar;
    reached_.clear();
    using Entry = std::pair<double, std::uint32_t>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
    lengths_[start] = 0, before_[start] = start;
    queue.push({0, start});
    while (!queue.empty()) {
      const auto [length, at] = queue.top();
      queue.pop();
      if (length > lengths_[at]) continue;
      reached_.push_back(at);
      for (const Neighbour& next : neighbours_[at])
        if (length + next.length < lengths_[next.place]) {
          lengths_[next.place] = length + next.length, before_[next.place] = at;
          queue.push({lengths_[next.place], next.place});
        }
    }
  }
  const std::vector<std::uint32_t>& reached() const { return reached_; }  ///< the nearest first
  double length(std::uint32_t place) const { return lengths_[place]; }
  std::uint32_t before(std::uint32_t place) const { return before_[place]; }

 private:
  static constexpr double kFar = std::numeric_limits<double>::infinity();
  const Neighbours& neighbours_;
  std::vector<double> lengths_;
  std::vector<std::uint32_t> before_, reached_;
};

}  // namespace

Course::Course(const Network& network, std::span<const VesselId> vessels, double spacing) {
  std::map<std::uint32_t, std::uint32_t> ofNode;
  const auto placeOf = [&](NodeId node, vec3 p) {
    if (!node.valid()) return add(p);
    const auto [found, isNew] = ofNode.emplace(node.value, std::uint32_t(places_.size()));
    return isNew ? add(p) : found->second;
  };
  std::map<std::uint32_t, std::vector<std::uint32_t>> along;
  struct FreeEnd {
    VesselId vessel;
    std::uint32_t place;
    float radius;
  };
  std::vector<FreeEnd> ends;
  for (const VesselId id : vessels) {
    const Vessel& vessel = network.vessel(id);
    const auto points = network.pointsOf(vessel);
    const int count = std::max(int(vessel.spanCount()), int(std::ceil(lengthOf(points) / spacing)));
    std::vector<std::uint32_t>& own = along[id.value];
    for (int k = 0; k <= count; ++k) {
      const vec3 p(evaluate(points, float(vessel.spanCount()) * float(k) / float(count)));
      own.push_back(k == 0 ? placeOf(vessel.start, p) : k == count ? placeOf(vessel.end, p) : add(p));
      if (k > 0) steps_.push_back({own[std::size_t(k) - 1], own.back()});
    }
    if (!vessel.start.valid()) ends.push_back({id, own.front(), points.front().w});
    if (!vessel.end.valid()) ends.push_back({id, own.back(), points.back().w});
  }
  alongSteps_ = steps_.size();
  // What was torn goes on. Sorted along x, so that only what is near there is looked at.
  const auto x = [&](const FreeEnd& end) { return places_[end.place].x; };
  std::ranges::stable_sort(ends, {}, x);
  float widest = 0;
  for (const FreeEnd& end : ends) widest = std::max(widest, end.radius);
  for (std::size_t i = 0; i < ends.size(); ++i)
    for (std::size_t j = i; j-- > 0 && x(ends[i]) - x(ends[j]) < widest;)
      if (ends[i].vessel != ends[j].vessel && glm::distance(places_[ends[i].place], places_[ends[j].place]) <
                                                  std::max(ends[i].radius, ends[j].radius))
        steps_.push_back({ends[j].place, ends[i].place});
  for (const auto& [node, place] : ofNode) {  // side branches hang on the nearest place of their host
    const auto& host = network.nodes()[node].host;
    const auto found = host ? along.find(host->vessel.value) : along.end();
    if (found == along.end()) continue;
    const float share = host->parameter / float(network.vessel(host->vessel).spanCount());
    const std::size_t at = std::size_t(std::lround(share * float(found->second.size() - 1)));
    if (found->second[at] != place) steps_.push_back({found->second[at], place});
  }
}

std::uint32_t Course::add(vec3 place) {
  places_.push_back(place);
  return std::uint32_t(places_.size() - 1);
}

double Course::length() const {
  double sum = 0;
  for (const Step& step : std::span(steps_).first(alongSteps_))
    sum += glm::distance(places_[step.from], places_[step.to]);
  return sum;
}

std::vector<vec3> Course::longestWay() const {
  Neighbours neighbours(places_.size());
  for (const Step& step : steps_) {
    const double length = glm::distance(places_[step.from], places_[step.to]);
    neighbours[step.from].push_back({step.to, length}), neighbours[step.to].push_back({step.from, length});
  }
  std::vector<bool> met(places_.size());
  std::vector<vec3> best;
  double longest = -1;
  Reach reach(neighbours);
  for (std::uint32_t start = 0; start < places_.size(); ++start) {
    if (met[start]) continue;
    reach.from(start);
    for (const std::uint32_t place : reach.reached()) met[place] = true;
    const std::uint32_t first = reach.reached().back();
    reach.from(first);
    const std::uint32_t last = reach.reached().back();
    if (!(reach.length(last) > longest)) continue;
    longest = reach.length(last);
    best.assign(1, places_[last]);
    for (std::uint32_t at = last; at != first; at = reach.before(at))
      best.push_back(places_[reach.before(at)]);
  }
  return best;
}

double wayLength(std::span<const vec3> way) {
  double sum = 0;
  for (std::size_t i = 1; i < way.size(); ++i) sum += glm::distance(way[i - 1], way[i]);
  return sum;
}

}  // namespace vasa
