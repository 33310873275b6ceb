#include "collide/network_tubes.h"

#include <algorithm>
#include <queue>
#include <tuple>
#include <utility>

#include "math/quadrature.h"

// Neighbours come from a graph whose places are the spans' ends and the points where side branches sit, and
// whose edges are the stretches from each place of a span to the next along it, as long as the arc (from each
// to every other they would grow with the square of the branches that leave one span). A node's ends are one
// place. From the places of each tube a shortest-path search runs as far as it and tubes no wider than it may
// reach; each of these that has a place within reach is a neighbour. So many narrow tubes cost no more for a
// wide one somewhere.
namespace vasa {
namespace {

float arcLength(const Bezier& tube) {
  float sum = 0;
  for (const auto& [t, weight] : kGauss4) sum += weight * glm::length(vec3(tube.derivative(t)));
  return sum;
}

struct Place {
  std::uint32_t id;
  float t;  // on the tube
};

struct Graph {
  std::vector<std::vector<Place>> placesOf;  // tube -> places, by t
  struct Visit {
    std::uint32_t tube, index;  // of placesOf[tube]
  };
  std::vector<std::vector<Visit>> tubesAt;  // place -> tubes
};

Graph buildGraph(const Network& network, const NetworkTubes& tubes) {
  Graph graph;
  graph.placesOf.resize(tubes.count());
  std::uint32_t next = std::uint32_t(network.nodes().size());
  for (std::uint32_t v = 0; v < network.vessels().size(); ++v) {
    const Vessel& vessel = network.vessels()[v];
    for (std::uint32_t knot = 0; knot <= vessel.spanCount(); ++knot) {
      std::uint32_t id = next;
      if (knot == 0 && vessel.start.valid()) id = vessel.start.value;
      if (knot == vessel.spanCount() && vessel.end.valid()) id = vessel.end.value;
      if (id == next) ++next;
      if (knot > 0) graph.placesOf[tubes.tube({v}, knot - 1)].push_back({id, 1});
      if (knot < vessel.spanCount()) graph.placesOf[tubes.tube({v}, knot)].push_back({id, 0});
    }
  }
  for (std::uint32_t n = 0; n < network.nodes().size(); ++n) {
    const Node& node = network.nodes()[n];
    if (!node.host) continue;
    const SpanParameter at = locate(node.host->parameter, network.vessel(node.host->vessel).spanCount());
    graph.placesOf[tubes.tube(node.host->vessel, at.span)].push_back({n, at.t});
  }
  graph.tubesAt.resize(next);
  for (std::uint32_t tube = 0; tube < tubes.count(); ++tube) {
    auto& places = graph.placesOf[tube];
    std::sort(places.begin(), places.end(),
              [](Place a, Place b) { return std::tie(a.t, a.id) < std::tie(b.t, b.id); });
    for (std::uint32_t i = 0; i < places.size(); ++i) graph.tubesAt[places[i].id].push_back({tube, i});
  }
  return graph;
}

// The neighbours of one tube that are narrower, or as wide and of a lower number.
class NeighbourSearch {
 public:
  NeighbourSearch(const Graph& graph, std::span<const Bezier> tubes, std::span<const float> lengths,
                  float reach)
      : graph_(graph), lengths_(lengths), reach_(reach), searched_(graph.tubesAt.size(), 0) {
    for (const Bezier& tube : tubes)
      radii_.push_back(std::max(std::max(tube.b[0].w, tube.b[1].w), std::max(tube.b[2].w, tube.b[3].w)));
  }

  void addTo(std::vector<TubePair>& pairs, std::uint32_t tube) {
    for (const Place& start : graph_.placesOf[tube]) {
      search(start.id, reach_ * 2 * radii_[tube]);
      for (const auto& [gap, place] : settled_)
        for (const Graph::Visit& visit : graph_.tubesAt[place]) {
          const std::uint32_t other = visit.tube;
          if (std::tie(radii_[other], other) >= std::tie(radii_[tube], tube)) continue;
          if (gap < reach_ * (radii_[tube] + radii_[other])) pairs.push_back(orderedPair(tube, other));
        }
    }
  }

 private:
  using Reached = std::pair<float, std::uint32_t>;  // how far off, place

  void search(std::uint32_t start, float limit) {
    std::priority_queue<Reached, std::vector<Reached>, std::greater<>> open;
    settled_.clear();
    ++searches_;
    open.push({0, start});
    while (!open.empty()) {
      const auto [distance, place] = open.top();
      open.pop();
      if (distance >= limit) return;
      if (std::exchange(searched_[place], searches_) == searches_) continue;
      settled_.emplace_back(distance, place);
      for (const Graph::Visit& visit : graph_.tubesAt[place]) {
        const auto& along = graph_.placesOf[visit.tube];
        for (const std::uint32_t next :
             {visit.index - 1, visit.index + 1})  // one before the first is past the last
          if (next < along.size() && searched_[along[next].id] != searches_)
            open.push({distance + std::abs(along[next].t - along[visit.index].t) * lengths_[visit.tube],
                       along[next].id});
      }
    }
  }

  const Graph& graph_;
  std::span<const float> lengths_;
  float reach_;
  std::vector<float> radii_;
  std::vector<std::uint32_t> searched_;  // by which search a place was settled last
  std::uint32_t searches_ = 0;
  std::vector<Reached> settled_;
};

}  // namespace

NetworkTubes::NetworkTubes(const Network& network, float reach) {
  for (std::uint32_t v = 0; v < network.vessels().size(); ++v) {
    const Vessel& vessel = network.vessels()[v];
    runs_.push_back({vessel.firstPoint, vessel.spanCount()});
    firstTube_.push_back(count());
    for (std::uint32_t span = 0; span < vessel.spanCount(); ++span) addresses_.push_back({{v}, span});
  }
  std::vector<Bezier> tubes(count());
  shape(network.points(), tubes);
  std::vector<float> lengths;
  for (const Bezier& tube : tubes) lengths.push_back(arcLength(tube));
  const Graph graph = buildGraph(network, *this);
  NeighbourSearch search(graph, tubes, lengths, reach);
  std::vector<TubePair> pairs;
  for (std::uint32_t tube = 0; tube < count(); ++tube) search.addTo(pairs, tube);
  neighbours_ = Exclusions(count(), pairs);
}

void NetworkTubes::shape(std::span<const vec4> points, std::span<Bezier> tubes) const {
  Bezier* next = tubes.data();
  for (const Run& run : runs_) {
    const std::span<const vec4> own = points.subspan(run.firstPoint, run.spans + 3);
    for (std::uint32_t span = 0; span < run.spans; ++span, ++next) {
      const vec4* d = &own[span];
      // Away from the clamped ends every span has the uniform weights.
      if (span >= 2 && span + 3 <= run.spans) {
        const vec4 b1 = (2.0f * d[1] + d[2]) / 3.0f, b2 = (d[1] + 2.0f * d[2]) / 3.0f;
        *next = {{(d[0] + 4.0f * d[1] + d[2]) / 6.0f, b1, b2, (d[1] + 4.0f * d[2] + d[3]) / 6.0f}};
      } else {
        *next = bezierOfSpan(own, span);
      }
    }
  }
}

}  // namespace vasa
