#include "repair/rest_parting.h"

#include <algorithm>

#include "avoid/side_places.h"
#include "math/direction.h"

// Each step solves the whole problem anew about the present shape, for all motion from rest and not for one
// more bit of it:
//   least ½ zᵀ W z   with   n · J z >= clearance - f + n · J z_now   at each place,
// and goes most of the way there. J is the place's row: how far apart a motion brings the two centre lines.
namespace vasa {
namespace {

// Β: a bow of less than two points to either side, so that little else is moved, and two points at a moved
// node go along: each more takes a wide vessel's next 3 cm. More takes more of a surface
// away from where it was scanned (0.3: 0.2 % of it), less leaves more pairs overlapping (0.03: 11 for 6).
constexpr float kBending = 0.1f;
// A step; forces last, so that steps go on where the last one ended.
constexpr unsigned kSweeps = 20;
// Of the way to the solution: normals turn as tubes pass one another.
constexpr float kPartingStep = 0.5f;
// [m] the motion of a point: out of the side of a vessel as wide as a vena cava
constexpr float kFarthestMove = 0.006f;
// [m] what lay against one another is still told when it swings back by so much
constexpr float kWatched = 0.0003f;
// N · J W⁻¹ Jᵀ n: below, a place moves with what it should move from.
constexpr float kLeastLeverage = 1e-4f;
constexpr float kThinningStep = 0.2f;  // of what is lacking, so that motion can do the rest
// Most that the share of a radius changes from one point to the next.
constexpr float kPartTaper = 0.3f;
constexpr float kLightest = 0.03f, kHeaviest = 100;  // by the median: what is lighter or heavier moves alike

// Volume by point of each vessel, by the median vessel's.
std::vector<float> relativeMasses(const Network& network) {
  std::vector<float> masses;
  for (const Vessel& vessel : network.vessels()) {
    const std::span<const vec4> points = network.pointsOf(vessel);
    float mass = 0;
    for (std::size_t l = 1; l < points.size(); ++l) {
      const float radius = 0.5f * (points[l - 1].w + points[l].w);
      mass += radius * radius * glm::distance(vec3(points[l - 1]), vec3(points[l]));
    }
    masses.push_back(mass / float(points.size()));
  }
  std::vector<float> sorted = masses;
  std::ranges::nth_element(sorted, sorted.begin() + std::ptrdiff_t(sorted.size() / 2));
  const float median = sorted[sorted.size() / 2];
  for (float& mass : masses) mass = median > 0 ? std::clamp(mass / median, kLightest, kHeaviest) : 1;
  return masses;
}

}  // namespace

RestParting::RestParting(const Network& network, float clearance)
    : network_(&network),
      clearance_(clearance),
      space_(network, kBending, relativeMasses(network)),
      z_(space_.variableCount(), vec3(0)),
      shares_(network.points().size(), 1),
      points_(network.points().begin(), network.points().end()) {}

float RestParting::watched() const { return clearance_ + kWatched; }

float RestParting::forceOf(const Key& key) const {
  const auto found = std::ranges::lower_bound(forces_, key, {}, &Force::key);
  return found != forces_.end() && found->key == key ? found->size : 0;
}

void RestParting::addPushes(const Contact& contact, const NetworkTubes& layout, std::span<const Bezier> tubes,
                            std::vector<Push>& pushes) {
  const NetworkTubes::Address a = layout.address(contact.i), b = layout.address(contact.j);
  const auto places = sidePlaces(contact, tubes);
  for (std::uint32_t k = 0; k < places.size(); ++k) {
    const auto [s, t] = places[k];
    const vec4 on = tubes[contact.i].at(s), other = tubes[contact.j].at(t);
    const vec3 gap = vec3(on) - vec3(other);
    const float f = glm::length(gap) - on.w - other.w;
    if (f >= watched()) continue;
    terms_.clear();
    space_.addPlace(a.vessel, a.span, s, 1, terms_);
    space_.addPlace(b.vessel, b.span, t, -1, terms_);
    const MotionSpace::Row row = space_.finish(terms_, rows_);
    if (row.diagonal <= kLeastLeverage) continue;
    vec3 moved(0);
    for (const MotionSpace::Term& term : rows_.termsOf(row)) moved += term.weight * z_[term.variable];
    const vec3 normal = k == 0 ? contact.normal : unitOr(gap, contact.normal);
    const Key key{{contact.i, contact.j}, k};
    pushes.push_back({row, key, normal, clearance_ - f + glm::dot(moved, normal), forceOf(key)});
  }
}

void RestParting::ascend(std::span<Push> pushes, std::span<vec3> z) const {
  const auto push = [&](const Push& at, float force) {
    const float* response = rows_.responses.data() + at.row.firstResponse;
    for (const MotionSpace::Run& run : rows_.runsOf(at.row))
      for (std::uint32_t l = 0; l < run.count; ++l) z[run.first + l] += *response++ * force * at.normal;
  };
  for (const Push& at : pushes)
    if (at.force > 0) push(at, at.force);
  for (unsigned sweep = 0; sweep < kSweeps; ++sweep)
    for (Push& at : pushes) {
      vec3 moved(0);
      for (const MotionSpace::Term& term : rows_.termsOf(at.row)) moved += term.weight * z[term.variable];
      const float more = std::max(-at.force, (at.distance - glm::dot(moved, at.normal)) / at.row.diagonal);
      if (more == 0) continue;
      at.force += more;
      push(at, more);
    }
}

void RestParting::move(std::span<const Interference::Place> places, const NetworkTubes& layout,
                       std::span<const Bezier> tubes) {
  rows_.clear();
  std::vector<Push> pushes;
  for (const Interference::Place& place : places) addPushes(place.contact, layout, tubes, pushes);
  std::vector<vec3> wanted(z_.size(), vec3(0));
  ascend(pushes, wanted);
  forces_.clear();
  for (const Push& push : pushes) forces_.push_back({push.key, push.force});
  for (std::size_t k = 0; k < z_.size(); ++k) {
    z_[k] += kPartingStep * (wanted[k] - z_[k]);
    if (const float far = glm::length(z_[k]); far > kFarthestMove) z_[k] *= kFarthestMove / far;
  }
  shape();
}

void RestParting::thin(std::span<const Interference::Place> places, const NetworkTubes& layout,
                       std::span<const Bezier> tubes) {
  for (const auto& [contact, allowed] : places) {
    const float lack = clearance_ - contact.f,
                radii = tubes[contact.i].at(contact.s).w + tubes[contact.j].at(contact.t).w;
    if (lack <= 0 || radii <= 0) continue;
    const float factor = std::max(0.5f, 1 - kThinningStep * lack / radii);
    for (const std::uint32_t tube : {contact.i, contact.j}) {
      const NetworkTubes::Address at = layout.address(tube);
      const std::uint32_t first = network_->vessel(at.vessel).firstPoint + at.span;
      for (std::uint32_t p = first; p < first + 4; ++p) {
        const float least = std::max(kLeastRadiusShare, 1 - kMostThinning / network_->points()[p].w);
        shares_[p] = std::min(shares_[p], std::max(least, shares_[p] * factor));
      }
    }
  }
  taper(shares_);
  shape();
}

void RestParting::taper(std::span<float> shares) const {
  for (const Node& node : network_->nodes()) {
    if (node.host) continue;
    const auto at = [&](const VesselEnd& end) -> float& { return shares[network_->pointOf(end)]; };
    float least = 1;
    for (const VesselEnd& end : network_->ends(node)) least = std::min(least, at(end));
    for (const VesselEnd& end : network_->ends(node)) at(end) = least;
  }
  for (const Vessel& vessel : network_->vessels()) {
    const std::span<float> own = Network::pointsOf(vessel, shares);
    for (std::size_t l = 1; l < own.size(); ++l) own[l] = std::min(own[l], own[l - 1] + kPartTaper);
    for (std::size_t l = own.size() - 1; l-- > 0;) own[l] = std::min(own[l], own[l + 1] + kPartTaper);
  }
}

void RestParting::shape() {
  std::ranges::copy(network_->points(), points_.begin());
  space_.apply(z_, points_);
  for (std::size_t p = 0; p < points_.size(); ++p) points_[p].w *= shares_[p];
}

}  // namespace vasa
