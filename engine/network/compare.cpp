#include "network/compare.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "core/cancellation.h"
#include "core/parallel.h"
#include "math/closest_point.h"

namespace vasa {
namespace {

constexpr double kSampleStep = 0.002;  // [m] between the places at which distances are taken

struct Segment {
  vec3 a, b;
};

/// All pieces of one name.
struct Pieces {
  std::string name, id;
  VesselKind kind = VesselKind::other;
  double length = 0;
  std::vector<Segment> segments;
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
  for (const Vessel& vessel : network.vessels()) {
    const std::string_view name = withoutOrdinal(vessel.name);
    const auto [found, isNew] = numbers.emplace(name, all.size());
    if (isNew) all.push_back({std::string(name), vessel.ontologyId, vessel.kind, 0, {}});
    Pieces& pieces = all[found->second];
    const auto points = network.pointsOf(vessel);
    const double length = lengthOf(points);
    const int steps = std::max(int(vessel.spanCount()), int(std::ceil(length / kSampleStep)));
    vec3 last(evaluate(points, 0));
    for (int k = 1; k <= steps; ++k) {
      const vec3 next(evaluate(points, float(vessel.spanCount()) * float(k) / float(steps)));
      pieces.segments.push_back({last, next});
      last = next;
    }
    pieces.length += length;
  }
  return all;
}

/// Mean over one vessel's segments, each by its length, of the distance from its middle to the other vessel.
double meanDistance(const Pieces& from, const Pieces& to) {
  double sum = 0, weights = 0;
  for (const Segment& s : from.segments) {
    checkpoint();
    const vec3 p = 0.5f * (s.a + s.b);
    float nearest = std::numeric_limits<float>::max();
    for (const Segment& t : to.segments)
      nearest = std::min(nearest, glm::distance(p, glm::mix(t.a, t.b, closestOnSegment(p, t.a, t.b))));
    const double weight = glm::distance(s.a, s.b);
    sum += weight * nearest, weights += weight;
  }
  return sum / std::max(weights, 1e-12);
}

}  // namespace

std::vector<VesselComparison> compareVessels(const Network& network, const Network& other) {
  const std::vector<Pieces> own = piecesOf(network), theirs = piecesOf(other);
  std::map<std::string_view, std::size_t> byName, byId;
  for (std::size_t i = 0; i < theirs.size(); ++i) {
    byName.emplace(theirs[i].name, i);
    if (!theirs[i].id.empty()) byId.emplace(theirs[i].id, i);
  }
  const auto counterpart = [&](const Pieces& pieces) -> const Pieces* {
    if (const auto found = byName.find(pieces.name); found != byName.end()) return &theirs[found->second];
    const auto found = byId.find(pieces.id);
    return found == byId.end() ? nullptr : &theirs[found->second];
  };
  std::vector<std::pair<const Pieces*, const Pieces*>> pairs;
  for (const Pieces& pieces : own)
    if (const Pieces* same = counterpart(pieces)) pairs.emplace_back(&pieces, same);
  std::vector<VesselComparison> all(pairs.size());
  parallelFor(all.size(), 1, [&](std::size_t i) {
    const auto& [a, b] = pairs[i];
    all[i] = {a->name, a->kind, a->length, b->length, meanDistance(*a, *b), meanDistance(*b, *a)};
  });
  return all;
}

}  // namespace vasa
