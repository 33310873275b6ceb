#include "surface/vessel_line.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/disjoint_sets.h"
#include "core/hash.h"
#include "core/ids.h"

namespace vasa {
namespace {

constexpr std::uint32_t kSamplesPerSpan = 8;
constexpr float kLongestDouble = 8;  // radii
// Ends so many radii of the thinner apart may run on: scanned parts overlap by up to 1.9 (iliac veins and
// cava, femoral and popliteal artery). At 2.5 no more do.
constexpr float kOneJunction = 2;
// Share of a vessel's radius within which others begin in it. Beyond, they begin on what leaves it there.
constexpr float kWithin = 0.9f;
// Greatest cosine between two ends' outward directions that still run on: an arch of the aorta may end at a
// right angle to where the ascending one does. At 0.5 ends of vessels that turn back are joined.
constexpr float kStraightest = 0.2f;

// An end of a vessel as a node sees it.
struct Arm {
  VesselEnd end;
  vec3 place, outward;
  float radius;
};

std::uint32_t key(const VesselEnd& end) { return 2 * end.vessel.value + (end.last ? 1 : 0); }

// Direction over the first one and a half radii: tangents at an end are noise.
Arm armOf(const Network& network, const VesselEnd& end) {
  const Vessel& vessel = network.vessel(end.vessel);
  const auto points = network.pointsOf(vessel);
  const float spans = float(vessel.spanCount());
  const vec4 start = network.points()[network.pointOf(end)];
  vec3 outward(0);
  for (int i = 1; i <= 32; ++i) {
    const float u = spans * float(i * i) / 1024.0f;
    outward = vec3(evaluate(points, end.last ? spans - u : u) - start);
    if (glm::length(outward) > 1.5f * start.w) break;
  }
  const float length = glm::length(outward);
  return {end, vec3(start), length > 0 ? outward / length : vec3(0, 0, 1), start.w};
}

// What a left-out vessel is a double of: its parameters 0 and spans are those of `vessel`, `at[0]` and
// `at[1]`.
struct Double {
  VesselId vessel;
  std::array<float, 2> at{};
};

float wayBetween(std::span<const vec4> points, float from, float to) {
  float way = 0;
  vec3 before(evaluate(points, from));
  for (int i = 1; i <= 32; ++i) {
    const vec3 next(evaluate(points, glm::mix(from, to, float(i) / 32)));
    way += glm::distance(before, next);
    before = next;
  }
  return way;
}

std::optional<Double> doubleOf(const Network& network, const Vessel& vessel) {
  for (const bool last : {false, true}) {
    const NodeId side = vessel.node(last), tip = vessel.node(!last);
    if (!side.valid() || !tip.valid() || !network.node(side).host || network.node(tip).host) continue;
    const Host host = *network.node(side).host;
    const auto points = network.pointsOf(network.vessel(host.vessel));
    for (const VesselEnd& end : network.ends(network.node(tip))) {
      if (end.vessel != host.vessel) continue;
      const float at = end.last ? float(spanCount(points)) : 0, way = wayBetween(points, at, host.parameter);
      const float radius = std::max(evaluate(points, host.parameter).w, evaluate(points, at).w);
      if (way > kLongestDouble * radius || lengthOf(network.pointsOf(vessel)) > 1.5f * way + radius) continue;
      return Double{host.vessel, {last ? at : host.parameter, last ? host.parameter : at}};
    }
  }
  return std::nullopt;
}

// Which ends run on into which.
class Joiner {
 public:
  Joiner(const Network& network, std::span<const std::array<VesselId, 2>> apart)
      : network_(network),
        apart_(apart),
        partner_(2 * network.vessels().size(), kNone),
        lines_(network.vessels().size()) {}

  // Joins the best pair of these ends.
  bool joinBest(const std::vector<VesselEnd>& ends) {
    std::vector<Arm> arms;
    float largest = 0;
    for (const VesselEnd& end : ends) {
      if (partner_[key(end)] != kNone) continue;  // a free end may meet several branches
      arms.push_back(armOf(network_, end));
      largest = std::max(largest, arms.back().radius);
    }
    float best = -1e9f;
    std::size_t one = 0, other = 0;
    for (std::size_t i = 0; i < arms.size(); ++i)
      for (std::size_t k = 0; k < i; ++k) {
        const float cosine = glm::dot(arms[i].outward, arms[k].outward);
        if (cosine > kStraightest ||
            lines_.find(arms[i].end.vessel.value) == lines_.find(arms[k].end.vessel.value) ||
            keptApart(arms[i].end.vessel, arms[k].end.vessel) ||
            glm::distance(arms[i].place, arms[k].place) >
                kOneJunction * std::min(arms[i].radius, arms[k].radius))
          continue;
        const float score = 1.5f * std::min(arms[i].radius, arms[k].radius) / largest - cosine;
        if (score > best) best = score, one = i, other = k;
      }
    if (best == -1e9f) return false;
    const VesselEnd a = arms[one].end, b = arms[other].end;
    partner_[key(a)] = key(b);
    partner_[key(b)] = key(a);
    lines_.unite(a.vessel.value, b.vessel.value);
    return true;
  }
  std::uint32_t partner(std::uint32_t end) const { return partner_[end]; }
  bool joins(VesselId vessel) const {
    return partner_[2 * vessel.value] != kNone || partner_[2 * vessel.value + 1] != kNone;
  }

 private:
  bool keptApart(VesselId a, VesselId b) const {
    return std::any_of(apart_.begin(), apart_.end(), [&](const auto& pair) {
      return (pair[0] == a && pair[1] == b) || (pair[0] == b && pair[1] == a);
    });
  }

  const Network& network_;
  std::span<const std::array<VesselId, 2>> apart_;
  std::vector<std::uint32_t> partner_;
  DisjointSets lines_;  // of vessels that run on into one another
};

vec4 pointAt(const Network& network, const Host& host) {
  return evaluate(network.pointsOf(network.vessel(host.vessel)), host.parameter);
}

// Nodes that are one place for the eye, and what meets there.
struct Junction {
  std::vector<VesselEnd> ends;
  std::optional<Host> host;  // a vessel that begins in none of the nodes
  bool passes = false;       // that one, to either side
  Host trunk;                // what carries the others
};

// The end of a host that a node on it lies beside, and the node there: so near that ends of both may run on
// into one another, or still within what the host's end leaves. kNone where that end is free.
struct Beside {
  VesselEnd end;
  std::uint32_t node;
};
std::optional<Beside> besideEnd(const Network& network, const Node& own) {
  const Host& host = *own.host;
  const Vessel& vessel = network.vessel(host.vessel);
  const auto points = network.pointsOf(vessel);
  const bool last = host.parameter > 0.5f * float(vessel.spanCount());
  const NodeId node = vessel.node(last);
  const vec4 tip = last ? points.back() : points.front(), place = pointAt(network, host);
  const float way = wayBetween(points, host.parameter, vessel.parameterOf(last));
  if (!node.valid()) return way > tip.w ? std::nullopt : std::optional<Beside>({{host.vessel, last}, kNone});
  float widest = 0;
  for (const VesselEnd& end : network.ends(own))
    widest = std::max(widest, network.points()[network.pointOf(end)].w);
  float reach = kOneJunction * std::min(widest, place.w);
  if (const auto& beyond = network.node(node).host)
    reach = std::max(reach, kWithin * pointAt(network, *beyond).w);
  if (way > reach) return std::nullopt;
  return Beside{{host.vessel, last}, node.value};
}

std::vector<Junction> junctionsOf(const Network& network) {
  const auto nodes = network.nodes();
  DisjointSets sets(nodes.size());
  std::vector<std::optional<Beside>> beside(nodes.size());
  for (std::uint32_t i = 0; i < nodes.size(); ++i) {
    if (nodes[i].host) beside[i] = besideEnd(network, nodes[i]);
    if (beside[i] && beside[i]->node != kNone) sets.unite(i, beside[i]->node);
  }
  std::vector<Junction> junctions(nodes.size());
  for (std::uint32_t i = 0; i < nodes.size(); ++i) {
    Junction& junction = junctions[sets.find(i)];
    const auto ends = network.ends(nodes[i]);
    junction.ends.insert(junction.ends.end(), ends.begin(), ends.end());
    if (!nodes[i].host || (beside[i] && beside[i]->node != kNone)) continue;
    junction.host = nodes[i].host;
    junction.passes = !beside[i];
    if (beside[i]) junction.ends.push_back(beside[i]->end);
  }
  return junctions;
}

// Takes out vessels that lead from a junction to itself and lie within.
std::vector<VesselId> takeWithin(const Network& network, Junction& junction) {
  std::vector<VesselId> within;
  for (const VesselEnd& end : junction.ends) {
    const auto points = network.pointsOf(network.vessel(end.vessel));
    if (end.last && std::ranges::count(junction.ends, VesselEnd{end.vessel, false}) > 0 &&
        lengthOf(points) < 2 * kOneJunction * std::max(points.front().w, points.back().w))
      within.push_back(end.vessel);
  }
  std::erase_if(junction.ends,
                [&](const VesselEnd& end) { return std::ranges::count(within, end.vessel) > 0; });
  return within;
}

// The joined ends carry the others, or what has none here, or the largest.
Host trunkOf(const Network& network, const Joiner& joiner, const Junction& junction) {
  const auto joined = [&](const VesselEnd& end) { return joiner.partner(key(end)) != kNone; };
  if (junction.host && (junction.passes || std::ranges::none_of(junction.ends, joined)))
    return *junction.host;
  const VesselEnd carrier = *std::ranges::max_element(junction.ends, {}, [&](const VesselEnd& end) {
    return (joined(end) ? 1e6f : 0.0f) + armOf(network, end).radius;
  });
  return {carrier.vessel, network.vessel(carrier.vessel).parameterOf(carrier.last)};
}

}  // namespace

VesselLine::VesselLine(const Network& network, std::vector<Part> parts) : parts_(std::move(parts)) {
  float at = 0;
  for (std::uint32_t p = 0; p < parts_.size(); ++p) {
    const Vessel& vessel = network.vessel(parts_[p].vessel);
    const auto points = network.pointsOf(vessel);
    const std::uint32_t count = kSamplesPerSpan * vessel.spanCount();
    for (std::uint32_t i = 0; i <= count; ++i) {
      const float u = float(parts_[p].reversed ? count - i : i) / kSamplesPerSpan;
      const vec4 point = evaluate(points, u);
      const float step = samples_.empty() ? 0 : glm::distance(vec3(point), samples_.back().centre);
      if (i == 0 && p > 0) joins_.push_back({at, step});
      at += step;
      samples_.push_back({vec3(point), point.w, at, u, p});
    }
  }
}

std::uint64_t VesselLine::key() const {
  static_assert(sizeof(Sample) == 28);  // no gaps
  return hashOf(std::span<const Sample>(samples_));
}

std::size_t VesselLine::sampleBefore(float way) const {
  const auto after = std::upper_bound(samples_.begin(), samples_.end(), way,
                                      [](float w, const Sample& sample) { return w < sample.at; });
  const std::size_t index = std::size_t(after - samples_.begin());
  return std::min(index > 0 ? index - 1 : 0, samples_.size() - 2);
}

float VesselLine::wayOf(VesselId vessel, float u) const {
  const auto part =
      std::find_if(parts_.begin(), parts_.end(), [&](const Part& p) { return p.vessel == vessel; });
  float way = 0;
  for (std::size_t i = 0; i + 1 < samples_.size(); ++i) {
    const Sample &a = samples_[i], &b = samples_[i + 1];
    if (a.part != b.part || a.part != std::uint32_t(part - parts_.begin())) continue;
    way = a.u == b.u ? a.at : glm::mix(a.at, b.at, std::clamp((u - a.u) / (b.u - a.u), 0.0f, 1.0f));
    if (std::min(a.u, b.u) <= u && u <= std::max(a.u, b.u)) break;
  }
  return way;
}

LinePlace VesselLine::place(float way) const {
  const std::size_t i = sampleBefore(way);
  const Sample &a = samples_[i], &b = samples_[i + 1];
  const Part& part = parts_[a.part];
  if (a.part != b.part || b.at <= a.at) return {part.vessel.value, a.u, part.reversed};
  const float share = std::clamp((way - a.at) / (b.at - a.at), 0.0f, 1.0f);
  float u = glm::mix(a.u, b.u, share);
  if (std::abs(u - std::round(u)) < 1e-4f) u = std::round(u);  // a ring that is there anyway
  return {part.vessel.value, u, part.reversed};
}

vec4 VesselLine::point(float way) const {
  const std::size_t i = sampleBefore(way);
  const Sample &a = samples_[i], &b = samples_[i + 1];
  const float share = b.at > a.at ? std::clamp((way - a.at) / (b.at - a.at), 0.0f, 1.0f) : 0;
  return glm::mix(vec4(a.centre, a.radius), vec4(b.centre, b.radius), share);
}

vec3 VesselLine::tangent(float way) const {
  for (std::size_t i = sampleBefore(way), reach = 0; reach < samples_.size(); ++reach) {
    const std::size_t low = i > reach ? i - reach : 0, high = std::min(i + 1 + reach, samples_.size() - 1);
    const vec3 chord = samples_[high].centre - samples_[low].centre;
    const float length = glm::length(chord);
    if (length > 1e-9f) return chord / length;
  }
  return {0, 0, 1};
}

VesselLine::Foot VesselLine::nearest(vec3 point, float around, float reach) const {
  Foot best{around, 1e30f, 0};
  for (std::size_t i = sampleBefore(around - reach);
       i + 1 < samples_.size() && samples_[i].at <= around + reach; ++i) {
    const Sample &a = samples_[i], &b = samples_[i + 1];
    const vec3 along = b.centre - a.centre;
    const float length2 = glm::dot(along, along);
    const float share = length2 > 0 ? std::clamp(glm::dot(point - a.centre, along) / length2, 0.0f, 1.0f) : 0;
    const float distance = glm::distance(point, a.centre + share * along);
    if (distance < best.distance)
      best = {glm::mix(a.at, b.at, share), distance, glm::mix(a.radius, b.radius, share)};
  }
  return best;
}

VesselLines makeVesselLines(const Network& network, std::span<const std::array<VesselId, 2>> apart) {
  std::vector<std::optional<Double>> doubles;
  for (const Vessel& vessel : network.vessels()) doubles.push_back(doubleOf(network, vessel));
  for (std::uint32_t v = 0; v < doubles.size(); ++v)  // not of one another
    if (doubles[v] && doubles[doubles[v]->vessel.value]) doubles[v].reset();
  const auto drawn = [&](const VesselEnd& end) { return !doubles[end.vessel.value]; };
  Joiner joiner(network, apart);
  std::vector<Junction> junctions = junctionsOf(network);
  std::vector<char> carries(network.vessels().size(), false);  // no doubles
  for (const auto& twin : doubles)
    if (twin) carries[twin->vessel.value] = true;
  for (Junction& junction : junctions) {
    std::erase_if(junction.ends, [&](const VesselEnd& end) { return !drawn(end); });
    const std::vector<VesselId> within = takeWithin(network, junction);
    if (junction.ends.empty()) continue;
    if (!junction.passes && junction.ends.size() >= 2) joiner.joinBest(junction.ends);
    junction.trunk = trunkOf(network, joiner, junction);
    carries[junction.trunk.vessel.value] = true;
    for (const VesselId vessel : within) {
      if (!carries[vessel.value] && drawn({junction.trunk.vessel, false}) && !joiner.joins(vessel))
        doubles[vessel.value] =
            Double{junction.trunk.vessel, {junction.trunk.parameter, junction.trunk.parameter}};
      else  // a vessel like others
        junction.ends.insert(junction.ends.end(), {{vessel, false}, {vessel, true}});
    }
  }
  VesselLines result;
  std::vector<std::uint32_t> lineOf(network.vessels().size(), kNone);
  for (std::uint32_t v = 0; v < lineOf.size(); ++v) {
    result.doubles += doubles[v].has_value();
    if (lineOf[v] != kNone || doubles[v]) continue;
    std::uint32_t start = 2 * v;  // walk back to the line's first end
    while (joiner.partner(start) != kNone) start = joiner.partner(start) ^ 1u;
    std::vector<VesselLine::Part> parts;
    for (std::uint32_t end = start;;) {
      parts.push_back({{end / 2}, (end & 1) != 0});
      lineOf[end / 2] = std::uint32_t(result.lines.size());
      end = joiner.partner(end ^ 1u);
      if (end == kNone) break;
    }
    result.lines.emplace_back(network, std::move(parts));
  }
  result.ends.resize(result.lines.size());
  const auto settle = [&](const VesselEnd& end, Host host) {
    if (!drawn(end) || joiner.partner(key(end)) != kNone) return;
    if (const auto& twin = doubles[host.vessel.value]) {
      const float share = host.parameter / float(network.vessel(host.vessel).spanCount());
      host = {twin->vessel, glm::mix(twin->at[0], twin->at[1], share)};
    }
    if (host.vessel == end.vessel) return;
    const std::uint32_t line = lineOf[end.vessel.value], hostLine = lineOf[host.vessel.value];
    const VesselLine::Part& first = result.lines[line].parts().front();
    const bool atStart = first.vessel == end.vessel && first.reversed == end.last;
    result.ends[line][atStart ? 0 : 1] = {true, hostLine,
                                          result.lines[hostLine].wayOf(host.vessel, host.parameter)};
  };
  for (const Junction& junction : junctions)
    for (const VesselEnd& end : junction.ends) {
      const NodeId node = network.vessel(end.vessel).node(end.last);
      if (!node.valid()) continue;
      const auto& own = network.node(node).host;
      const Host& trunk = junction.trunk;
      const vec4 place = pointAt(network, trunk);
      const bool stays =
          own && (lineOf[own->vessel.value] == lineOf[trunk.vessel.value] ||
                  glm::distance(vec3(pointAt(network, *own)), vec3(place)) > kWithin * place.w);
      settle(end, stays ? *own : trunk);
    }
  return result;
}

}  // namespace vasa
