#include "network/compare.h"

#include <algorithm>
#include <limits>
#include <map>
#include <set>

#include "core/cancellation.h"
#include "core/parallel.h"
#include "math/closest_point.h"
#include "network/course.h"

namespace vasa {
namespace {

constexpr double kSampleStep = 0.002;  // [m] between the places at which distances are taken

/// All pieces of one name.
struct Pieces {
  std::string name, id;
  VesselKind kind = VesselKind::other;
  std::vector<VesselId> vessels;
};

/// What is compared of a vessel.
struct Told {
  Course all;
  std::vector<vec3> way;
  Told(const Network& network, std::span<const VesselId> vessels)
      : all(network, vessels, kSampleStep), way(all.longestWay()) {}
};

std::string_view withoutOrdinal(std::string_view name) {
  if (!name.ends_with(')')) return name;
  const std::size_t at = name.rfind(" (");
  if (at == std::string_view::npos) return name;
  const std::string_view inside = name.substr(at + 2, name.size() - at - 3);
  const bool number =
      !inside.empty() && std::ranges::all_of(inside, [](char c) { return c >= '0' && c <= '9'; });
  return number ? name.substr(0, at) : name;
}

std::vector<Pieces> piecesOf(const Network& network) {
  std::vector<Pieces> all;
  std::map<std::string_view, std::size_t> numbers;
  for (std::uint32_t v = 0; v < network.vessels().size(); ++v) {
    const Vessel& vessel = network.vessels()[v];
    const std::string_view name = withoutOrdinal(vessel.name);
    const auto [found, isNew] = numbers.emplace(name, all.size());
    if (isNew) all.push_back({std::string(name), vessel.ontologyId, vessel.kind, {}});
    all[found->second].vessels.push_back({v});
  }
  return all;
}

/// What one network and the other have of a vessel.
struct Pair {
  Pieces own, other;
};

void join(Pieces& into, const Pieces& more) {
  into.vessels.insert(into.vessels.end(), more.vessels.begin(), more.vessels.end());
}

std::vector<Pair> pairsOf(const std::vector<Pieces>& own, const std::vector<Pieces>& other) {
  std::map<std::string_view, const Pieces*> byName;
  for (const Pieces& pieces : other) byName.emplace(pieces.name, &pieces);
  std::set<std::string_view> named;  // of both
  for (const Pieces& pieces : own)
    if (byName.contains(pieces.name)) named.insert(pieces.name);
  std::map<std::string_view, Pieces> byId;  // what no name tells
  for (const Pieces& pieces : other)
    if (!pieces.id.empty() && !named.contains(pieces.name))
      if (const auto [found, isNew] = byId.emplace(pieces.id, pieces); !isNew) join(found->second, pieces);
  std::vector<Pair> pairs;
  std::map<std::string_view, std::size_t> ofId;
  for (const Pieces& pieces : own)
    if (named.contains(pieces.name))
      pairs.push_back({pieces, *byName.at(pieces.name)});
    else if (const auto same = byId.find(pieces.id); same != byId.end()) {
      const auto [found, isNew] = ofId.emplace(pieces.id, pairs.size());
      if (isNew)
        pairs.push_back({pieces, same->second});
      else
        join(pairs[found->second].own, pieces);
    }
  return pairs;
}

/// Mean over a vessel's course, each step by its length, of the distance from its middle to the other's
/// pieces.
double meanDistance(const std::vector<vec3>& way, const Course& to) {
  double sum = 0, weights = 0;
  for (std::size_t i = 1; i < way.size(); ++i) {
    checkpoint();
    const vec3 p = 0.5f * (way[i - 1] + way[i]);
    float nearest = std::numeric_limits<float>::max();
    for (const Course::Step& step : to.steps()) {
      const vec3 a = to.places()[step.from], b = to.places()[step.to];
      nearest = std::min(nearest, glm::distance(p, glm::mix(a, b, closestOnSegment(p, a, b))));
    }
    const double weight = glm::distance(way[i - 1], way[i]);
    sum += weight * nearest, weights += weight;
  }
  return sum / std::max(weights, 1e-12);
}

/// [m] of a course between the places nearest to the other's ends.
double sharedLength(std::span<const vec3> way, std::span<const vec3> other) {
  const auto nearest = [&](vec3 end) {
    return std::size_t(std::ranges::min_element(way, {}, [&](vec3 p) { return glm::distance(p, end); }) -
                       way.begin());
  };
  const auto [low, high] = std::minmax({nearest(other.front()), nearest(other.back())});
  return wayLength(way.subspan(low, high - low + 1));
}

VesselComparison compared(const Network& network, const Network& other, const Pair& pair) {
  const Told a(network, pair.own.vessels), b(other, pair.other.vessels);
  return {pair.own.name,
          pair.other.name,
          pair.own.kind,
          wayLength(a.way),
          wayLength(b.way),
          a.all.length(),
          b.all.length(),
          sharedLength(a.way, b.way),
          sharedLength(b.way, a.way),
          meanDistance(a.way, b.all),
          meanDistance(b.way, a.all)};
}

}  // namespace

std::vector<VesselComparison> compareVessels(const Network& network, const Network& other) {
  const std::vector<Pair> pairs = pairsOf(piecesOf(network), piecesOf(other));
  std::vector<VesselComparison> all(pairs.size());
  parallelFor(all.size(), 1, [&](std::size_t i) { all[i] = compared(network, other, pairs[i]); });
  return all;
}

}  // namespace vasa
