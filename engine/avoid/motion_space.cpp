#include "avoid/motion_space.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "core/parallel.h"

namespace vasa {
namespace {

// What a place owes to hosts of hosts is followed down to this, and responses to this of the largest.
constexpr float kSmallest = 1e-3f;
constexpr float kSamePace = 1.0001f;  // below what is allowed by that much: above rounding

float carriedShare(std::uint32_t steps, std::uint32_t points, std::uint32_t carried) {
  const float reach = float(std::min(carried, points - 1));
  const float x = std::min(float(steps) / reach, 1.0f);
  return 1 - x * x * (3 - 2 * x);
}

}  // namespace

MotionSpace::MotionSpace(const Network& network, float beta, std::span<const float> masses)
    : network_(&network),
      pointCount_(network.points().size()),
      vesselOf_(pointCount_),
      startShare_(pointCount_, 0),
      endShare_(pointCount_, 0),
      nodeWeight_(network.nodes().size(), 0),
      nodeMotion_(network.nodes().size()),
      nodeChanged_(network.nodes().size()),
      again_(network.vessels().size()) {
  const auto carried = std::uint32_t(std::ceil(BendingMetric::bowOf(beta)));
  for (const Node& node : network.nodes()) {
    Hosting& hosting = hostings_.emplace_back();
    if (!node.host) continue;
    hosting.host = &network.vessel(node.host->vessel);
    const SpanParameter at = locate(node.host->parameter, hosting.host->spanCount());
    hosting.span = at.span;
    hosting.weights = deBoorWeights(at.span, hosting.host->spanCount(), at.t);
  }
  for (std::uint32_t v = 0; v < network.vessels().size(); ++v) {
    const Vessel& vessel = network.vessels()[v];
    const bool start = vessel.start.valid(), end = vessel.end.valid();
    const float mass = masses.empty() ? 1 : masses[v];
    blocks_.push_back(
        {vessel.firstPoint + (start ? 1u : 0u),
         BendingMetric(vessel.pointCount - (start ? 1u : 0u) - (end ? 1u : 0u), start, end, beta), 1 / mass});
    const auto startShare = std::span(startShare_).subspan(vessel.firstPoint, vessel.pointCount);
    const auto endShare = std::span(endShare_).subspan(vessel.firstPoint, vessel.pointCount);
    for (std::uint32_t l = 0; l < vessel.pointCount; ++l) {
      vesselOf_[vessel.firstPoint + l] = v;
      if (start) startShare[l] = carriedShare(l, vessel.pointCount, carried);
      if (end) endShare[l] = carriedShare(vessel.pointCount - 1 - l, vessel.pointCount, carried);
    }
    if (start) nodeWeight_[vessel.start.value] += mass * BendingMetric::energy(startShare, beta);
    if (end) nodeWeight_[vessel.end.value] += mass * BendingMetric::energy(endShare, beta);
  }
}

MotionSpace::Row MotionSpace::Rows::append(const Rows& others, const Row& row) {
  Row own = row;
  own.firstTerm = std::uint32_t(terms.size());
  own.firstRun = std::uint32_t(runs.size());
  own.firstResponse = std::uint32_t(responses.size());
  const std::span<const Run> theirs = others.runsOf(row);
  std::uint32_t count = 0;
  for (const Run& run : theirs) count += run.count;
  const auto first = others.responses.begin() + row.firstResponse;
  terms.insert(terms.end(), others.termsOf(row).begin(), others.termsOf(row).end());
  runs.insert(runs.end(), theirs.begin(), theirs.end());
  responses.insert(responses.end(), first, first + count);
  return own;
}

void MotionSpace::addPlace(VesselId vessel, std::uint32_t span, float t, float weight,
                           std::vector<Term>& terms) const {
  const Vessel& own = network_->vessel(vessel);
  const vec4 weights = deBoorWeights(span, own.spanCount(), t);
  for (std::uint32_t l = 0; l < 4; ++l) addPoint(own, span + l, weight * weights[int(l)], terms);
}

void MotionSpace::addPoint(const Vessel& vessel, std::uint32_t local, float weight,
                           std::vector<Term>& terms) const {
  if (std::abs(weight) < kSmallest) return;
  const std::uint32_t point = vessel.firstPoint + local;
  const bool fixed =
      (local == 0 && vessel.start.valid()) || (local + 1 == vessel.pointCount && vessel.end.valid());
  if (!fixed) terms.push_back({point, weight});
  if (startShare_[point] > 0) addNode(vessel.start, weight * startShare_[point], terms);
  if (endShare_[point] > 0) addNode(vessel.end, weight * endShare_[point], terms);
}

void MotionSpace::addNode(NodeId node, float weight, std::vector<Term>& terms) const {
  if (const auto& [host, span, weights] = hostings_[node.value]; host) {
    for (std::uint32_t l = 0; l < 4; ++l) addPoint(*host, span + l, weight * weights[int(l)], terms);
  } else if (std::abs(weight) >= kSmallest) {
    terms.push_back({std::uint32_t(pointCount_) + node.value, weight});
  }
}

MotionSpace::Row MotionSpace::finish(std::vector<Term>& terms, Rows& rows) const {
  std::sort(terms.begin(), terms.end(), [](const Term& a, const Term& b) {
    return a.variable != b.variable ? a.variable < b.variable : a.weight < b.weight;
  });
  Row row{std::uint32_t(rows.terms.size()), 0, std::uint32_t(rows.runs.size()), 0,
          std::uint32_t(rows.responses.size())};
  for (const Term& term : terms) {
    if (row.termCount > 0 && rows.terms.back().variable == term.variable)
      rows.terms.back().weight += term.weight;
    else
      rows.terms.push_back(term), ++row.termCount;
  }
  static thread_local std::vector<float> work;  // zero between calls
  const std::span<const Term> own = rows.termsOf(row);
  for (std::size_t k = 0; k < own.size();) {
    if (own[k].variable >= pointCount_) {
      const float response = own[k].weight / nodeWeight_[own[k].variable - pointCount_];
      rows.runs.push_back({own[k].variable, 1});
      rows.responses.push_back(response);
      row.diagonal += own[k++].weight * response;
      continue;
    }
    const std::uint32_t vessel = vesselOf_[own[k].variable];
    const Block& block = blocks_[vessel];
    work.resize(std::max<std::size_t>(work.size(), block.metric.count()));
    const std::span<float> x = std::span(work).first(block.metric.count());
    const std::size_t begin = k;
    for (; k < own.size() && own[k].variable < pointCount_ && vesselOf_[own[k].variable] == vessel; ++k)
      x[own[k].variable - block.first] = own[k].weight;
    const auto [first, last] = block.metric.solveNear(
        x, {own[begin].variable - block.first, own[k - 1].variable - block.first + 1}, kSmallest);
    for (std::uint32_t l = first; l < last; ++l) x[l] *= block.lightness;
    for (std::size_t l = begin; l < k; ++l) row.diagonal += own[l].weight * x[own[l].variable - block.first];
    rows.runs.push_back({block.first + first, last - first});
    rows.responses.insert(rows.responses.end(), x.begin() + first, x.begin() + last);
    std::fill(x.begin() + first, x.begin() + last, 0.0f);
  }
  row.runCount = std::uint32_t(rows.runs.size()) - row.firstRun;
  return row;
}

vec3 MotionSpace::motionOf(const Vessel& vessel, std::uint32_t local, std::span<const vec3> z) const {
  const std::uint32_t point = vessel.firstPoint + local;
  vec3 motion = z[point];
  if (startShare_[point] > 0) motion += startShare_[point] * nodeMotion_[vessel.start.value];
  if (endShare_[point] > 0) motion += endShare_[point] * nodeMotion_[vessel.end.value];
  return motion;
}

void MotionSpace::moveNodes(std::span<const vec3> z) {
  for (const NodeId id : network_->pinOrder()) {
    const auto& [host, span, weights] = hostings_[id.value];
    vec3 motion(0);
    if (host)
      for (std::uint32_t l = 0; l < 4; ++l) motion += weights[int(l)] * motionOf(*host, span + l, z);
    else
      motion = z[pointCount_ + id.value];
    nodeChanged_[id.value] = motion != std::exchange(nodeMotion_[id.value], motion);
  }
}

void MotionSpace::apply(std::span<const vec3> z, std::span<vec4> points) {
  moveNodes(z);
  parallelFor(network_->vessels().size(), kGrain, [&](std::size_t v) {
    const Vessel& vessel = network_->vessels()[v];
    for (std::uint32_t l = 0; l < vessel.pointCount; ++l)
      points[vessel.firstPoint + l] += vec4(motionOf(vessel, l, z), 0);
  });
  pinEnds(*network_, points);
}

void MotionSpace::keepNear(std::span<const vec3> other, std::span<vec3> z, float always,
                           FunctionRef<float(std::uint32_t, float)> allowed) {
  difference_.resize(z.size());
  for (std::size_t v = 0; v < z.size(); ++v) difference_[v] = z[v] - other[v];
  const auto shorten = [&](vec3& variable, std::uint32_t point, vec3 motion) {
    if (glm::dot(motion, motion) <= always * always) return false;
    const float length = glm::length(motion), limit = allowed(point, length), most = limit / kSamePace;
    if (!(length > limit)) return false;
    variable += (most / length - 1) * motion;
    return true;
  };
  for (std::size_t n = 0; n < nodeWeight_.size(); ++n) {
    const Node& node = network_->nodes()[n];
    if (node.host || node.endCount == 0) continue;
    vec3& motion = difference_[pointCount_ + n];
    shorten(motion, network_->pointOf(network_->ends(node)[0]), motion);
  }
  const std::span<const Vessel> vessels = network_->vessels();
  for (std::size_t v = 0; v < vessels.size(); ++v)
    again_[v] =
        std::ranges::any_of(std::span(difference_).subspan(vessels[v].firstPoint, vessels[v].pointCount),
                            [](vec3 motion) { return motion != vec3(0); });
  std::ranges::fill(nodeMotion_, vec3(0));
  const auto changed = [&](NodeId node) { return node.valid() && nodeChanged_[node.value]; };
  // No point of a vessel moves farther: its shares of the two nodes' motions add up to 1 at the most.
  const auto reach = [&](const Vessel& vessel) {
    const auto lengthOf = [&](NodeId node) {
      return node.valid() ? glm::length(nodeMotion_[node.value]) : 0.0f;
    };
    float farthest = 0;
    for (const vec3& own : std::span(difference_).subspan(vessel.firstPoint, vessel.pointCount))
      farthest = std::max(farthest, glm::dot(own, own));
    return std::sqrt(farthest) + std::max(lengthOf(vessel.start), lengthOf(vessel.end));
  };
  // What hangs on a vessel's side goes along with it, so that is known only once its host has been drawn
  // nearer. A vessel is looked at anew where it, or a node that it hangs on, has changed.
  do {
    moveNodes(difference_);
    parallelFor(vessels.size(), kGrain, [&](std::size_t v) {
      const Vessel& vessel = vessels[v];
      if (!std::exchange(again_[v], false) && !changed(vessel.start) && !changed(vessel.end)) return;
      if (reach(vessel) <= always) return;
      for (std::uint32_t l = vessel.start.valid(); l + vessel.end.valid() < vessel.pointCount; ++l)
        again_[v] |= shorten(difference_[vessel.firstPoint + l], vessel.firstPoint + l,
                             motionOf(vessel, l, difference_));
    });
  } while (std::ranges::any_of(again_, std::identity()));
  for (std::size_t v = 0; v < z.size(); ++v) z[v] = other[v] + difference_[v];
}

}  // namespace vasa
