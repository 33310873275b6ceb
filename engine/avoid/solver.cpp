#include "avoid/solver_state.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <limits>
#include <tuple>
#include <utility>

// Coordinate ascent on the dual: with g = W⁻¹ a the response of the variables to a constraint's row a,
//   Δλ = (d - n·(C_i - C_j) - αλ) / (a·g + α),   λ <- max(0, λ + Δλ),   z += Δλ n g,
// so that z is always the minimiser for the present multipliers. α is a little compliance: where there is no room the
// multipliers stay finite.
namespace vasa {
namespace {

constexpr float kCompliance = 1e-3f;  // α as a share of a·g
constexpr float kSettled = 1e-6f;     // [m]

// What is tried, one after the other, where there is no room for all that is asked for: the vessels that are still in
// one another's way are parted the way they lie, and let through bones with what is joined to them within some nodes.
constexpr unsigned kResorts[] = {0, 0, 2, 6, 1000, 0, 0, 0};

void noteMovement(std::span<const vec4> from, std::span<const vec4> to, AvoidReport& report) {
  double sum = 0;
  for (std::size_t p = 0; p < from.size(); ++p) {
    const float moved = glm::distance(vec3(from[p]), vec3(to[p]));
    report.movedMax = std::max(report.movedMax, moved);
    sum += double(moved) * moved;
  }
  if (!from.empty()) report.movedRms = float(std::sqrt(sum / double(from.size())));
}

// What contacts are sorted by.
std::tuple<std::uint32_t, std::uint32_t, float> placeOf(const BoneContact& contact) {
  return {contact.tube, contact.part, contact.s};
}

std::uint32_t tubesOf(std::span<const BoneContact> contacts, const auto& counts) {
  std::uint32_t count = 0, last = kNoTube;
  for (const BoneContact& contact : contacts)
    if (counts(contact) && std::exchange(last, contact.tube) != contact.tube) ++count;
  return count;
}

}  // namespace

std::uint32_t tubesOf(std::span<const BoneContact> contacts) {
  return tubesOf(contacts, [](const BoneContact&) { return true; });
}

BoneReport reportOf(std::span<const BoneContact> contacts) {
  const auto atRest = [](const BoneContact& contact) { return contact.allowed < 0; };
  BoneReport report{tubesOf(contacts, std::not_fn(atRest)), tubesOf(contacts, atRest)};
  for (const BoneContact& contact : contacts) report.depth = std::max(report.depth, contact.allowed - contact.f);
  return report;
}

void Avoider::State::push(const Constraint& constraint, const MotionSpace::Rows& rows, float amount) {
  const vec3 force = amount * constraint.normal;
  const float* response = rows.responses.data() + constraint.row.firstResponse;
  for (const auto& [first, count] : rows.runsOf(constraint.row))
    for (std::uint32_t k = 0; k < count; ++k) z[first + k] += *response++ * force;
}

// What all multipliers move together.
void Avoider::State::sumUp() {
  std::fill(z.begin(), z.end(), vec3(0));
  for (const Constraint& constraint : boneConstraints.constraints())
    if (constraint.multiplier > 0) push(constraint, boneConstraints.rows(), constraint.multiplier);
  for (const Constraint& constraint : pool.constraints())
    if (constraint.multiplier > 0) push(constraint, pool.rows(), constraint.multiplier);
}

// Returns how far that moved the place.
float Avoider::State::ascend(Constraint& constraint, const MotionSpace::Rows& rows) {
  vec3 motion(0);
  for (const auto& [variable, weight] : rows.termsOf(constraint.row)) motion += weight * z[variable];
  const float diagonal = constraint.row.diagonal, present = constraint.start + glm::dot(constraint.normal, motion);
  const float lack = constraint.distance - present - kCompliance * diagonal * constraint.multiplier;
  const float step = std::clamp(lack / ((1 + kCompliance) * diagonal), -constraint.multiplier,
                                std::max(constraint.limit - constraint.multiplier, 0.0f));
  if (step == 0) return 0;
  constraint.multiplier += step;
  push(constraint, rows, step);
  return std::abs(step) * diagonal;
}

void Avoider::State::ascend() {
  for (unsigned sweep = 0; sweep < options.sweeps; ++sweep) {
    float largest = 0;
    for (Constraint& constraint : boneConstraints.constraints())
      largest = std::max(largest, ascend(constraint, boneConstraints.rows()));
    for (Constraint& constraint : pool.constraints())
      largest = std::max(largest, ascend(constraint, pool.rows()));
    if (largest < kSettled) return;
  }
}

void Avoider::State::place(const PosedVessels& posed, const VolumeKeeper* volume, std::span<vec4> points) {
  const std::span<const vec4> rest = network.points();
  for (std::size_t p = 0; p < points.size(); ++p)
    points[p] = vec4(vec3(posed.points[p]), volume ? rest[p].w : points[p].w);
  space.apply(z, points);
  if (volume) volumeOutcome = volume->run(points);
}

void Avoider::State::look(const PosedVessels& posed, std::span<const vec4> points, Bones::Which which, AvoidReport& report) {
  report.certifyMs = 0;
  {
    StageClock clock(report.certifyMs);
    places = interference.find(points);
    sides.findChanged(interference.tubes(), posed.rotations, changed);
  }
  report.detectMs += report.certifyMs;
  lookAtBones(which, report);
}

void Avoider::State::lookAtBones(Bones::Which which, AvoidReport& report) {
  if (!bones) return;
  StageClock clock(report.boneMs);
  boneContacts = bones->contacts(interference.tubes(), {posedTubes, posedTurns}, which);
  if (!wall) return;
  skinContacts.clear();
  wall->addContacts(interference.tubes(), bones->partCount(), skinContacts);
  allContacts.clear();
  std::ranges::merge(boneContacts, skinContacts, std::back_inserter(allContacts), {}, &placeOf, &placeOf);
}

void Avoider::State::separate(unsigned rounds, const PosedVessels& posed, const VolumeKeeper* volume, std::span<vec4> points,
                              AvoidReport& report) {
  for (unsigned round = 0; round < rounds; ++round) {
    {
      StageClock clock(report.solveMs);
      const std::span<const Bezier> tubes = interference.tubes();
      const bool grew = pool.refresh(tubes);
      const std::size_t added = pool.add(places, changed, tubes, posed);
      const std::size_t asking = boneConstraints.update(wall ? std::span<const BoneContact>(allContacts) : boneContacts, tubes, posedTubes);
      if (added + asking == 0 && !grew) return;
      ++report.rounds;
      sumUp();
      ascend();
      place(posed, volume, points);
    }
    look(posed, points, Bones::Which::nearAtLast, report);
  }
}

// Vessels that bones hold against one another, and what hangs together with them within some nodes, are let through the
// bones.
void Avoider::State::letThroughBones(unsigned nodes) {
  std::vector<VesselId> vessels;
  std::vector<char> taken(network.vessels().size(), 0);
  const auto take = [&](VesselId vessel) {
    if (!std::exchange(taken[vessel.value], char(1))) vessels.push_back(vessel);
  };
  for (const Interference::Place& place : remaining)
    for (const std::uint32_t tube : {place.contact.i, place.contact.j}) take(interference.layout().address(tube).vessel);
  for (std::size_t first = 0; nodes-- > 0;) {
    const std::size_t last = vessels.size();
    for (; first < last; ++first) {
      const Vessel& vessel = network.vessel(vessels[first]);
      for (const NodeId id : {vessel.start, vessel.end}) {
        if (!id.valid()) continue;
        if (const auto& host = network.node(id).host) take(host->vessel);
        for (const VesselEnd& end : network.ends(network.node(id))) take(end.vessel);
      }
    }
  }
  for (const VesselId vessel : vessels) boneConstraints.letThrough(vessel);
  boneConstraints.restart();
  pool.restart();
}

// Radii at interfering places and in bones are capped, and the rest of each vessel takes its volume; in the end, where
// that only moves the trouble about, volume is given up for the certificate.
void Avoider::State::giveWay(const PosedVessels& posed, const VolumeKeeper* volume, std::span<vec4> points, AvoidReport& report) {
  bool gave = false;
  for (unsigned round = 0; round < options.lumenRounds; ++round) {
    const bool apart = certificateOf(places, &remaining).holds(), lastResort = 2 * round >= options.lumenRounds;
    if (apart && (lastResort || boneContacts.empty())) break;
    {
      StageClock clock(report.solveMs);
      if (!gave) {
        gave = gaveWay = true;
        most.assign(points.size(), std::numeric_limits<float>::infinity());
      }
      const bool keepVolume = volume && !lastResort;
      if (!lastResort) narrow(network, interference.layout(), boneContacts, interference.tubes(), points, false, most);
      narrow(network, interference.layout(), remaining, interference.tubes(), points, lastResort, most);
      for (std::size_t p = 0; p < points.size(); ++p)
        points[p].w = keepVolume ? network.points()[p].w : std::min(points[p].w, most[p]);
      if (keepVolume) volumeOutcome = volume->run(points, most);
    }
    look(posed, points, Bones::Which::nearAtLast, report);
  }
}

// The points with the radii that they would have if nothing gave way.
std::vector<vec4> Avoider::State::widePoints(const VolumeKeeper* volume, std::span<const vec4> points) const {
  std::vector<vec4> wide(points.begin(), points.end());
  for (std::size_t p = 0; p < wide.size(); ++p) wide[p].w = network.points()[p].w;
  if (volume) volume->run(wide);
  return wide;
}

// From the multipliers as they are, after some were given up.
void Avoider::State::tryAgain(unsigned rounds, const PosedVessels& posed, const VolumeKeeper* volume, std::span<vec4> points,
                              AvoidReport& report) {
  {
    StageClock clock(report.solveMs);
    sumUp();
    place(posed, volume, points);
  }
  look(posed, points, Bones::Which::nearAtLast, report);
  separate(rounds, posed, volume, points, report);
  giveWay(posed, volume, points, report);
}

AvoidReport Avoider::State::run(const PosedVessels& posed, const VolumeKeeper* volume, std::span<vec4> points) {
  AvoidReport report;
  pool.clear();
  boneConstraints.clear();
  narrowed.clear();
  gaveWay = false;
  std::fill(z.begin(), z.end(), vec3(0));
  if (bones) {
    bones->pose(posed.jointMatrices);
    if (wall) wall->pose(posed.jointMatrices);
    interference.layout().shape(posed.points, posedTubes);
    for (std::uint32_t tube = 0; tube < posedTurns.size(); ++tube) {
      const auto [vessel, span] = interference.layout().address(tube);
      posedTurns[tube] = posed.rotations[network.vessel(vessel).firstPoint + span + 1];
    }
  }
  look(posed, points, Bones::Which::all, report);
  report.before = certificateOf(places, &found);
  report.sidesChanged = std::uint32_t(changed.size());
  report.bones = reportOf(boneContacts);
  report.skinContacts = tubesOf(skinContacts);
  if (!report.before.holds() || !changed.empty() || report.bones.contacts + report.bones.deeper + report.skinContacts > 0) {
    separate(options.rounds, posed, volume, points, report);
    giveWay(posed, volume, points, report);
    for (const unsigned nodes : kResorts) {
      if (options.rounds == 0 || certificateOf(places, &remaining).holds()) break;
      if (nodes > 0 && bones) letThroughBones(nodes);
      pool.partAsTheyLie(remaining);
      tryAgain(options.rounds, posed, volume, points, report);
    }
  }
  if (report.rounds > 0 && certificateOf(places, &remaining).holds()) {
    bringBack(posed, volume, points, report);
    leaveBones(posed, volume, points, report);
    goAroundBones(posed, volume, points, report);
  }
  if (gaveWay) narrowed = narrowPlaces(network, widePoints(volume, points), points);
  report.after = certificateOf(places, &remaining);
  report.sidesChangedAfter = std::uint32_t(changed.size());
  report.bonesAfter = reportOf(boneContacts);
  report.skinContactsAfter = tubesOf(skinContacts);
  report.volume = volumeOutcome;
  report.narrowSpans = std::uint32_t(narrowed.size());
  for (const NarrowPlace& narrow : narrowed) report.leastLumen = std::min(report.leastLumen, narrow.factor);
  report.constraints = std::uint32_t(pool.constraints().size() + boneConstraints.constraints().size());
  noteMovement(posed.points, points, report);
  return report;
}

Avoider::Avoider(const Network& network, const Body* body, AvoidOptions options)
    : state_(std::make_unique<State>(network, body, options)) {}
Avoider::~Avoider() = default;
Avoider::Avoider(Avoider&&) noexcept = default;

AvoidReport Avoider::run(const PosedVessels& posed, const VolumeKeeper* volume, std::span<vec4> points) {
  return state_->run(posed, volume, points);
}
std::span<const Interference::Place> Avoider::remaining() const {
  return state_->remaining;
}
std::span<const NarrowPlace> Avoider::narrowed() const {
  return state_->narrowed;
}
std::span<const Contact> Avoider::changedSides() const {
  return state_->changed;
}
std::span<const BoneContact> Avoider::inBones() const {
  return state_->boneContacts;
}
JointId Avoider::jointOfBone(std::uint32_t part) const {
  return state_->bones->jointOf(part);
}
std::span<const Interference::Place> Avoider::found() const {
  return state_->found;
}
const NetworkTubes& Avoider::layout() const {
  return state_->interference.layout();
}
std::size_t Avoider::restPairCount() const {
  return state_->interference.restPairCount();
}
std::size_t Avoider::restBoneContactCount() const {
  return state_->bones ? state_->bones->restContactCount() : 0;
}
std::size_t Avoider::neighbourCount() const {
  return state_->interference.neighbourCount();
}

}  // namespace vasa
