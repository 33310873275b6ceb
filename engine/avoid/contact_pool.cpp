#include "avoid/contact_pool.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/parallel.h"
#include "core/stable_sort.h"
#include "math/direction.h"

// Coordinate ascent on the dual: with g = W⁻¹ a the response of the variables to a constraint's row a,
//   Δλ = (d - n·(C_i - C_j) - αλ) / (a·g + α),   λ <- max(0, λ + Δλ),   z += Δλ n g,
// so that z is always the minimiser for the present multipliers (but for what stays still). α is a little
// compliance: where there is no room the multipliers stay finite. Steps are over-relaxed, λ <- max(0, λ +
// ωΔλ), which converges for all 0 < ω < 2.
namespace vasa {
namespace {

constexpr float kCompliance = 1e-3f;      // α as a share of a·g
constexpr float kOverRelaxation = 1.3f;   // ω: 1.2 to 1.6 settle more in as many sweeps than 1 does
constexpr float kClearanceShare = 0.02f;  // of the sum of the radii
constexpr float kLeastClearance = 1e-5f;  // [m]
constexpr float kSameParameter = 0.04f;   // constraints of one pair closer than this in s and t are one
constexpr float kSameDirection = 0.98f;   // ... if their normals are about the same too
constexpr float kSure = 0.8f;             // of a side at rest, from which on it counts in full
constexpr float kSameSide = 0.5f;         // cosine between a gap and what the last one has become
constexpr float kNegligible = Correction::kNegligible;
constexpr float kLeastDiagonal = 1e-4f;  // below it nothing that may move can mend the place
// How far a multiplier may push on its own: times what is lacking and the radii.
constexpr float kReach = 10;

float widestOf(const Bezier& tube) { return std::max({tube.b[0].w, tube.b[1].w, tube.b[2].w, tube.b[3].w}); }

// Which way to part two tubes: along their gap, unless they have come nearer than half of what is asked for
// or passed through one another since they were last apart; then towards the side on which they were.
vec3 wayApart(vec3 gap, vec3 before, float distance, vec3 otherwise) {
  const float sure = std::min(glm::length(before) / (0.5f * distance), 1.0f);
  const vec3 side = directionOf(before);
  const float beyond = glm::dot(gap, side);
  const float turn = std::clamp(1 - 2 * beyond / distance, 0.0f, 1.0f);
  return unitOr(gap + sure * (turn * distance - std::min(beyond, 0.0f)) * side, unitOr(before, otherwise));
}

// The gap of two places in the last shape, as the motion has carried it along, without what lies along the
// tubes.
vec3 gapBefore(const Contact& at, std::span<const Bezier> shape, const LastShape& last) {
  const vec3 apart = vec3(last.tubes[at.i].at(at.s)) - vec3(last.tubes[at.j].at(at.t));
  return sideways(0.5f * (last.turns[at.i] * apart + last.turns[at.j] * apart),
                  directionAt(shape[at.i], at.s), directionAt(shape[at.j], at.t));
}

bool samePlace(const Constraint& a, const Constraint& b) {
  return std::max(std::abs(a.s - b.s), std::abs(a.t - b.t)) < kSameParameter;
}

auto keyOf(const Constraint& constraint) { return std::pair{constraint.i, constraint.other}; }

}  // namespace

bool keepsSide(const Contact& at, std::span<const Bezier> shape, const LastShape& last) {
  const vec3 gap = vec3(shape[at.i].at(at.s)) - vec3(shape[at.j].at(at.t)),
             before = gapBefore(at, shape, last);
  return glm::dot(gap, before) > kSameSide * glm::length(gap) * glm::length(before);
}

ContactPool::ContactPool(const MotionSpace& space, const Interference& interference, const RestSides& sides)
    : space_(&space), interference_(&interference), sides_(&sides) {}

void ContactPool::clear() {
  constraints_.clear();
  rows_.clear();
  sorted_ = 0;
}

template <class Vector>
Vector ContactPool::motionOf(const Constraint& constraint, std::span<const Vector> z) const {
  Vector motion(0);
  for (const auto& [variable, weight] : rows_.termsOf(constraint.row)) motion += weight * z[variable];
  return motion;
}

void ContactPool::begin(Constraint& constraint, std::span<const Bezier> shape,
                        std::span<const vec3> z) const {
  const vec4 a = shape[constraint.i].at(constraint.s);
  const vec4 b = constraint.isBone() ? vec4(constraint.point, 0) : shape[constraint.other].at(constraint.t);
  constraint.distance = a.w + b.w + constraint.clearance;
  constraint.start = glm::dot(constraint.normal, vec3(a) - vec3(b) - motionOf<vec3>(constraint, z));
}

void ContactPool::refresh(std::span<const Bezier> shape, std::span<const vec3> z) {
  for (Constraint& constraint : constraints_) begin(constraint, shape, z);
}

float ContactPool::clearanceFor(const Constraint& at, float radii) const {
  const vec4 restA = interference_->restTubes()[at.i].at(at.s),
             restB = interference_->restTubes()[at.other].at(at.t);
  const float atRest = glm::distance(vec3(restA), vec3(restB)) - restA.w - restB.w;
  const float wanted = std::max(kClearanceShare * radii, kLeastClearance);
  return std::min(wanted, atRest < 0 ? atRest : std::max(atRest, kLeastClearance));
}

// Two vessels that touch may roll around one another, but not beyond a right angle from where they lay at
// rest; where that is the less sure, the farther they were apart then, not quite to where it counts as
// another side. Those that cross are left where they are: asked to go back, they would be pressed into one
// another. What has come ahead of a vessel's end would slip around it: it stays as far on its side as it has
// to, to be there once it is beside the end again.
bool ContactPool::wouldRoll(const RestSides::Turned& turned, std::span<const Bezier> shape, float most,
                            Constraint& constraint) {
  const auto& [at, side, aheadOfEnd] = turned;
  const auto [i, j, s, t, f, contactNormal] = at;
  if (!aheadOfEnd && crossOver(directionAt(shape[i], s), directionAt(shape[j], t))) return false;
  const float sure = glm::length(side);
  const vec4 a = shape[i].at(s), b = shape[j].at(t);
  const float apart = glm::distance(vec3(a), vec3(b)), radii = a.w + b.w;
  const float doubt = std::clamp((kSure - sure) / (kSure - RestSides::kLeastSure), 0.0f, 1.0f);
  float least = 0.9f * RestSides::kChanged * doubt * apart;
  if (aheadOfEnd) least = std::min(least, -std::max(apart - radii, 0.0f));
  constraint = {.i = i, .other = j, .s = s, .t = t, .normal = side / sure};
  constraint.limit = kReach * apart;
  constraint.clearance = std::min(least, f + most) - radii;
  return least - f > kNegligible;
}

void ContactPool::propose(const Contact& contact, std::span<const Bezier> shape, const LastShape& last,
                          Proposals& found) {
  const std::uint32_t i = contact.i, j = contact.j;
  if (contact.f > std::max(kClearanceShare * (widestOf(shape[i]) + widestOf(shape[j])), kLeastClearance))
    return;
  for (const auto& [s, t] : sidePlaces(contact, shape)) {
    const vec4 a = shape[i].at(s), b = shape[j].at(t);
    const vec3 gap = vec3(a) - vec3(b);
    Constraint constraint{.i = i, .other = j, .s = s, .t = t};
    constraint.clearance = clearanceFor(constraint, a.w + b.w);
    const float distance = a.w + b.w + constraint.clearance;
    if (glm::dot(gap, gap) > distance * distance) continue;
    const vec3 before = last.anew[i] || last.anew[j]
                            ? 0.5f * distance * sides_->carried({i, j, s, t}, shape, last.rotations)
                            : gapBefore({i, j, s, t}, shape, last);
    constraint.normal = wayApart(gap, before, distance, contact.normal);
    const float lack = distance - glm::dot(constraint.normal, gap);
    if (lack <= kNegligible) continue;
    constraint.limit = kReach * (lack + a.w + b.w);
    const auto own = std::span(found.constraints).first(found.count);
    if (std::ranges::any_of(own, [&](const Constraint& other) { return samePlace(other, constraint); }) ||
        known(constraint, kSameDirection))
      continue;
    giveRow(constraint, found.rows);
    found.constraints[found.count++] = constraint;
  }
}

void ContactPool::propose(const BoneContact& place, std::span<const Bezier> shape, Proposals& found) const {
  const float radius = shape[place.tube].at(place.s).w;
  Constraint& constraint = found.constraints[found.count++];
  constraint = {.i = place.tube,
                .other = Constraint::kBone | place.part,
                .s = place.s,
                .normal = place.normal,
                .point = place.point};
  constraint.clearance = place.allowed + std::max(kClearanceShare * radius,
                                                  place.allowed < 0 ? kLeastClearance : kContactMargin);
  constraint.limit = kReach * (constraint.clearance - place.f + 2 * radius);
  giveRow(constraint, found.rows);
}

// The constraint that already asks for the same, or null.
Constraint* ContactPool::known(const Constraint& wanted, float cosine) {
  const auto sorted = std::span(constraints_).first(sorted_);
  auto own = std::ranges::lower_bound(sorted, keyOf(wanted), {}, keyOf);
  for (; own != sorted.end() && keyOf(*own) == keyOf(wanted); ++own)
    if (samePlace(*own, wanted) && glm::dot(own->normal, wanted.normal) > cosine) return &*own;
  return nullptr;
}

// Where its row lies is told of `rows`.
void ContactPool::giveRow(Constraint& constraint, MotionSpace::Rows& rows) const {
  static thread_local std::vector<MotionSpace::Term> terms;
  terms.clear();
  const auto [vessel, span] = interference_->layout().address(constraint.i);
  space_->addPlace(vessel, span, constraint.s, 1, terms);
  if (!constraint.isBone()) {
    const auto [otherVessel, otherSpan] = interference_->layout().address(constraint.other);
    space_->addPlace(otherVessel, otherSpan, constraint.t, -1, terms);
  }
  constraint.row = space_->finish(terms, rows);
}

// With a row that lies in `rows`.
void ContactPool::take(const Constraint& constraint, const MotionSpace::Rows& rows,
                       std::span<const Bezier> shape, std::span<const vec3> z) {
  if (constraint.row.diagonal <= kLeastDiagonal) return;
  Constraint& own = constraints_.emplace_back(constraint);
  own.row = rows_.append(rows, constraint.row);
  own.limit /= own.row.diagonal;
  begin(own, shape, z);
}

void ContactPool::addSides(std::span<const RestSides::Turned> turned, std::span<const Bezier> shape,
                           float most, std::span<const vec3> z) {
  const std::size_t before = constraints_.size();
  sideRows_.clear();
  for (const RestSides::Turned& own : turned) {
    Constraint constraint;
    if (!wouldRoll(own, shape, most, constraint)) continue;
    giveRow(constraint, sideRows_);
    take(constraint, sideRows_, shape, z);
  }
  sortIn(before);
}

void ContactPool::sortIn(std::size_t before) {
  const auto earlier = [](const Constraint& a, const Constraint& b) { return keyOf(a) < keyOf(b); };
  stableSort(std::span(constraints_).subspan(before), sortRoom_, earlier);
  mergeInPlace(std::span(constraints_), before, sortRoom_, earlier);
  sorted_ = constraints_.size();
}

void ContactPool::add(std::span<const Interference::Place> places, std::span<const BoneContact> bones,
                      std::span<const Bezier> shape, const LastShape& last, std::span<const char> moved,
                      std::span<vec3> z) {
  proposals_.resize(std::max(proposals_.size(), bones.size() + places.size()));
  const auto atBones = std::span(proposals_).first(bones.size()),
             atPlaces = std::span(proposals_).subspan(bones.size(), places.size());
  parallelFor(bones.size() + places.size(), kGrain, [&](std::size_t k) {
    Proposals& found = proposals_[k];
    found.count = 0;
    found.rows.clear();
    if (k < bones.size()) return propose(bones[k], shape, found);
    const Contact& contact = places[k - bones.size()].contact;
    if (moved.empty() || moved[contact.i] || moved[contact.j]) propose(contact, shape, last, found);
  });
  const std::size_t before = constraints_.size();
  for (const Proposals& proposals : atBones) {
    const Constraint& constraint = proposals.constraints[0];
    // A bone's surface is not flat: the plane goes along with the place, and takes its push along.
    if (Constraint* own = known(constraint, kSameWayOut)) {
      push<vec3>(*own, own->multiplier * (constraint.normal - own->normal), z);
      own->normal = constraint.normal;
      own->point = constraint.point;
      begin(*own, shape, z);
    } else {
      take(constraint, proposals.rows, shape, z);
    }
  }
  for (const Proposals& proposals : atPlaces)
    for (const Constraint& constraint : std::span(proposals.constraints).first(proposals.count))
      take(constraint, proposals.rows, shape, z);
  sortIn(before);
}

template <class Vector>
void ContactPool::push(const Constraint& constraint, Vector force, std::span<Vector> z) const {
  const float* response = rows_.responses.data() + constraint.row.firstResponse;
  for (const auto& [first, count] : rows_.runsOf(constraint.row)) {
    Vector* const own = z.data() + first;
    for (std::uint32_t k = 0; k < count; ++k) own[k] += response[k] * force;
    response += count;
  }
}

// Returns how far that moved the place.
float ContactPool::ascend(Constraint& constraint) {
  const vec3 motion(motionOf<vec4>(constraint, z_));
  const float diagonal = constraint.row.diagonal,
              present = constraint.start + glm::dot(constraint.normal, motion);
  const float lack = constraint.distance - present - kCompliance * diagonal * constraint.multiplier;
  const float step =
      std::clamp(kOverRelaxation * lack / ((1 + kCompliance) * diagonal), -constraint.multiplier,
                 std::max(constraint.limit - constraint.multiplier, 0.0f));
  if (std::abs(step) * diagonal < kNegligible) return 0;
  constraint.multiplier += step;
  push<vec4>(constraint, vec4(step * constraint.normal, 0), z_);
  return std::abs(step) * diagonal;
}

void ContactPool::ascend(unsigned sweeps, float still, std::span<vec3> z) {
  z_.resize(z.size());
  std::ranges::transform(z, z_.begin(), [](vec3 own) { return vec4(own, 0); });
  for (unsigned sweep = 0; sweep < sweeps; ++sweep) {
    float largest = 0;
    for (Constraint& constraint : constraints_) largest = std::max(largest, ascend(constraint));
    if (largest == 0) break;
  }
  for (std::size_t v = 0; v < z.size(); ++v)
    if (glm::distance(vec3(z_[v]), z[v]) > still) z[v] = vec3(z_[v]);
}

}  // namespace vasa
