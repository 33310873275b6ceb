#include "make_human/growing_tree.h"

#include <algorithm>
#include <cmath>

#include "math/segment_distance.h"

namespace vasa::human {
namespace {

constexpr float kForkReach = 2;  // as in collide: near a fork, tubes may overlap this many radii along them

std::vector<float> arcsOf(const std::vector<vec3>& points) {
  std::vector<float> arcs(1, 0.0f);
  for (std::size_t i = 1; i < points.size(); ++i)
    arcs.push_back(arcs.back() + glm::distance(points[i], points[i - 1]));
  return arcs;
}

struct Located {
  std::size_t i;
  float t;
};

Located locateArc(const std::vector<float>& arcs, float arc) {
  const auto above = std::upper_bound(arcs.begin() + 1, arcs.end() - 1, arc);
  const std::size_t i = std::size_t(above - arcs.begin()) - 1;
  const float step = arcs[i + 1] - arcs[i];
  return {i, step > 0 ? std::clamp((arc - arcs[i]) / step, 0.0f, 1.0f) : 0.0f};
}

}  // namespace

GrowingTree::GrowingTree(const std::vector<LaidVessel>& laid, float step, float clearance, float cell)
    : laidCount_(laid.size()), grid_(cell), clearance_(clearance) {
  for (const LaidVessel& from : laid) {
    Vessel vessel;
    const float spans = float(spanCount(from.points));
    const int count = std::max(int(4 * spans), int(std::ceil(lengthOf(from.points) / step)));
    for (int k = 0; k <= count; ++k) {
      const vec4 p = evaluate(from.points, spans * float(k) / float(count));
      vessel.branch.points.emplace_back(p);
      vessel.radii.push_back(p.w);
    }
    vessel.arcs = arcsOf(vessel.branch.points);
    vessels_.push_back(std::move(vessel));
  }
  for (std::size_t i = 0; i < laid.size(); ++i) {
    for (const Attachment* end : {&laid[i].source, &laid[i].target})
      if (end->kind == Attachment::Kind::side) {
        Vessel& host = vessels_[std::size_t(end->vessel)];
        host.forks.push_back(end->fraction * host.length());
        host.children.push_back(-1);
      }
    enter(int(i));
  }
}

vec3 GrowingTree::positionAt(int vessel, float arc) const {
  const Vessel& v = vessels_[std::size_t(vessel)];
  const Located at = locateArc(v.arcs, arc);
  return glm::mix(v.branch.points[at.i], v.branch.points[at.i + 1], at.t);
}

vec3 GrowingTree::tangentAt(int vessel, float arc) const {
  const Vessel& v = vessels_[std::size_t(vessel)];
  const std::size_t i = locateArc(v.arcs, arc).i;
  return glm::normalize(v.branch.points[i + 1] - v.branch.points[i]);
}

float GrowingTree::radiusAt(int vessel, float arc) const {
  const Vessel& v = vessels_[std::size_t(vessel)];
  const Located at = locateArc(v.arcs, arc);
  return glm::mix(v.radii[at.i], v.radii[at.i + 1], at.t);
}

bool GrowingTree::admits(int vessel, float arc, float reserve, float tip) const {
  const Vessel& v = vessels_[std::size_t(vessel)];
  if (v.removed) return false;
  const float gap = kForkReach * (reserve + radiusAt(vessel, arc)) + 2 * clearance_;
  if (arc < gap || arc > v.length() - 2 * reserve - 2 * clearance_) return false;
  for (float fork : v.forks)
    if (std::abs(fork - arc) < 2 * reserve + 2 * tip + 2 * clearance_) return false;
  for (int stem = vessel; stem >= int(laidCount_); stem = vessels_[std::size_t(stem)].branch.host) {
    const Vessel& s = vessels_[std::size_t(stem)];
    if (float(s.load + 1) > std::pow(s.branch.reserve / s.branch.tip, 3.0f)) return false;
  }
  return true;
}

bool GrowingTree::mayOverlap(const Branch& branch, float arc, float radius,
                             const SegmentGrid::Segment& other) const {
  if (int(other.owner) != branch.host) return false;
  return arc + std::abs(other.at - branch.hostArc) < kForkReach * (radius + other.radius);
}

int GrowingTree::obstacleOf(const Branch& branch) const {
  const std::vector<float> arcs = arcsOf(branch.points);
  for (std::size_t k = 0; k + 1 < branch.points.size(); ++k) {
    const vec3 a = branch.points[k], b = branch.points[k + 1];
    for (std::uint32_t number : grid_.near(a, b, branch.reserve + clearance_)) {
      const SegmentGrid::Segment& s = grid_.segments()[number];
      if (mayOverlap(branch, arcs[k], branch.reserve, s)) continue;
      if (closestOnSegments(a, b, s.a, s.b).distance < branch.reserve + s.radius + clearance_)
        return int(s.owner);
    }
  }
  return -1;
}

vec3 GrowingTree::push(const Branch& branch, std::size_t point, float arc) const {
  const vec3 p = branch.points[point];
  vec3 move{0};
  for (std::uint32_t number : grid_.near(p, p, branch.reserve + 2 * clearance_)) {
    const SegmentGrid::Segment& s = grid_.segments()[number];
    if (mayOverlap(branch, arc, branch.reserve, s)) continue;
    const SegmentClosest<float> closest = closestOnSegments(p, p, s.a, s.b);
    const float lack = branch.reserve + s.radius + 1.5f * clearance_ - closest.distance;
    if (lack > 0 && closest.distance > 1e-6f)
      move += lack / closest.distance * (p - glm::mix(s.a, s.b, closest.t));
  }
  return move;
}

int GrowingTree::add(Branch branch) {
  const int number = int(vessels_.size());
  Vessel vessel;
  vessel.arcs = arcsOf(branch.points);
  vessel.radii.assign(branch.points.size(), branch.reserve);
  vessel.branch = std::move(branch);
  Vessel& host = vessels_[std::size_t(vessel.branch.host)];
  host.forks.push_back(vessel.branch.hostArc);
  host.children.push_back(number);
  for (int stem = vessel.branch.host; stem >= int(laidCount_); stem = vessels_[std::size_t(stem)].branch.host)
    ++vessels_[std::size_t(stem)].load;
  vessels_.push_back(std::move(vessel));
  enter(number);
  return number;
}

void GrowingTree::remove(int vessel) {
  Vessel& v = vessels_[std::size_t(vessel)];
  v.removed = true;
  // Above a stem that was removed, this branch went with it.
  for (int stem = v.branch.host; stem >= int(laidCount_) && !vessels_[std::size_t(stem)].removed;
       stem = vessels_[std::size_t(stem)].branch.host)
    vessels_[std::size_t(stem)].load -= v.load;
}

void GrowingTree::enter(int vessel) {
  const Vessel& v = vessels_[std::size_t(vessel)];
  for (std::size_t k = 0; k + 1 < v.branch.points.size(); ++k)
    grid_.add({v.branch.points[k], v.branch.points[k + 1], std::max(v.radii[k], v.radii[k + 1]),
               std::uint32_t(vessel), v.arcs[k]});
}

std::vector<float> GrowingTree::murrayRadii(int vessel) const {
  const Vessel& v = vessels_[std::size_t(vessel)];
  std::vector<float> radii;
  for (float arc : v.arcs) {
    int tips = 1;
    for (std::size_t i = 0; i < v.forks.size(); ++i)
      if (v.forks[i] >= arc && !vessels_[std::size_t(v.children[i])].removed)
        tips += vessels_[std::size_t(v.children[i])].load;
    radii.push_back(v.branch.tip * std::cbrt(float(tips)));
  }
  return radii;
}

}  // namespace vasa::human
