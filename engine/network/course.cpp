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

// How every place that one can come to is reached from a place (Dijkstra 1959).
struct Reach {
  std::uint32_t farthest;
  std::vector<double> lengths;
  std::vector<std::uint32_t> before;

  Reach(const Neighbours& neighbours, std::uint32_t start)
      : farthest(start),
        lengths(neighbours.size(), std::numeric_limits<double>::infinity()),
        before(neighbours.size(), start) {
    using Entry = std::pair<double, std::uint32_t>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
    lengths[start] = 0;
    queue.push({0, start});
    while (!queue.empty()) {
      const auto [length, at] = queue.top();
      queue.pop();
      if (length > lengths[at]) continue;
      farthest = at;  // they come in order
      for (const Neighbour& next : neighbours[at])
        if (length + next.length < lengths[next.place]) {
          lengths[next.place] = length + next.length, before[next.place] = at;
          queue.push({lengths[next.place], next.place});
        }
    }
  }
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
    if (!vessel.start.valid()) ends.push_back({own.front(), points.front().w});
    if (!vessel.end.valid()) ends.push_back({own.back(), points.back().w});
  }
  for (std::size_t i = 0; i < ends.size(); ++i)  // what was torn there goes on
    for (std::size_t j = 0; j < i; ++j)
      if (glm::distance(places_[ends[i].place], places_[ends[j].place]) <
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
  for (const Step& step : steps_) sum += glm::distance(places_[step.from], places_[step.to]);
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
  for (std::uint32_t start = 0; start < places_.size(); ++start) {
    if (met[start]) continue;
    const Reach first(neighbours, start), second(neighbours, first.farthest);
    for (std::size_t k = 0; k < met.size(); ++k) met[k] = met[k] || std::isfinite(first.lengths[k]);
    if (!(second.lengths[second.farthest] > longest)) continue;
    longest = second.lengths[second.farthest];
    best.assign(1, places_[second.farthest]);
    for (std::uint32_t at = second.farthest; at != first.farthest; at = second.before[at])
      best.push_back(places_[second.before[at]]);
  }
  return best;
}

double wayLength(std::span<const vec3> way) {
  double sum = 0;
  for (std::size_t i = 1; i < way.size(); ++i) sum += glm::distance(way[i - 1], way[i]);
  return sum;
}

}  // namespace vasa
