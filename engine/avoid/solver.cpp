#include "avoid/solver.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <utility>

// Coordinate ascent on the dual: with g = W⁻¹ a the response of the variables to a constraint's row a,
//   Δλ = (d - n·(C_i - C_j) - αλ) / (a·g + α),   λ <- max(0, λ + Δλ),   z += Δλ n g,
// so that z is always the minimiser for the present multipliers. α is a little compliance: where there is no room the
// multipliers stay finite.
namespace vasa {
namespace {

constexpr float kCompliance = 1e-3f;  // α as a share of a·g
constexpr float kSettled = 1e-6f;     // [m]

class Timer {
 public:
  explicit Timer(double& sum) : sum_(sum) {}
  ~Timer() { sum_ += std::chrono::duration<double, std::milli>(Clock::now() - start_).count(); }
  Timer(const Timer&) = delete;
  Timer& operator=(const Timer&) = delete;

 private:
  using Clock = std::chrono::steady_clock;
  double& sum_;
  Clock::time_point start_ = Clock::now();
};

void noteMovement(std::span<const vec4> from, std::span<const vec4> to, AvoidReport& report) {
  double sum = 0;
  for (std::size_t p = 0; p < from.size(); ++p) {
    const float moved = glm::distance(vec3(from[p]), vec3(to[p]));
    report.movedMax = std::max(report.movedMax, moved);
    sum += double(moved) * moved;
  }
  if (!from.empty()) report.movedRms = float(std::sqrt(sum / double(from.size())));
}

void noteBones(std::span<const BoneContact> contacts, std::uint32_t& count, float& depth) {
  count = 0, depth = 0;
  std::uint32_t last = kNoTube;
  for (const BoneContact& contact : contacts) {
    count += contact.tube != last;
    last = contact.tube;
    depth = std::max(depth, contact.allowed - contact.f);
  }
}

}  // namespace

Avoider::Avoider(const Network& network, const Body* body, AvoidOptions options)
    : network_(&network),
      options_(options),
      interference_(network),
      space_(network, options.bending),
      sides_(network, interference_),
      pool_(network, space_, interference_, sides_),
      z_(space_.variableCount()),
      posedTubes_(interference_.layout().count()) {
  if (body) bones_ = std::make_unique<Bones>(*body, interference_.restTubes());
}

float Avoider::presentOf(const Constraint& constraint) const {
  vec3 motion(0);
  for (const auto& [variable, weight] : pool_.rows().termsOf(constraint.row)) motion += weight * z_[variable];
  return constraint.start + glm::dot(constraint.normal, motion);
}

void Avoider::push(Constraint& constraint, float amount) {
  const vec3 force = amount * constraint.normal;
  const float* response = pool_.rows().responses.data() + constraint.row.firstResponse;
  for (const auto& [first, count] : pool_.rows().runsOf(constraint.row))
    for (std::uint32_t k = 0; k < count; ++k) z_[first + k] += *response++ * force;
}

void Avoider::ascend() {
  for (unsigned sweep = 0; sweep < options_.sweeps; ++sweep) {
    float largest = 0;
    for (Constraint& constraint : pool_.constraints()) {
      const float compliance = kCompliance * constraint.row.diagonal;
      const float lack = constraint.distance - presentOf(constraint) - compliance * constraint.multiplier;
      const float step = std::clamp(lack / (constraint.row.diagonal + compliance), -constraint.multiplier,
                                    std::max(constraint.limit - constraint.multiplier, 0.0f));
      if (step == 0) continue;
      constraint.multiplier += step;
      push(constraint, step);
      largest = std::max(largest, std::abs(step) * constraint.row.diagonal);
    }
    if (largest < kSettled) return;
  }
}

void Avoider::place(const PosedVessels& posed, const VolumeKeeper* volume, std::span<vec4> points) {
  const std::span<const vec4> rest = network_->points();
  for (std::size_t p = 0; p < points.size(); ++p)
    points[p] = vec4(vec3(posed.points[p]), volume ? rest[p].w : points[p].w);
  space_.apply(z_, points);
  if (volume) volumeOutcome_ = volume->run(points);
}

void Avoider::look(const PosedVessels& posed, std::span<const vec4> points, Bones::Which which, AvoidReport& report) {
  report.certifyMs = 0;
  {
    Timer timer(report.certifyMs);
    places_ = interference_.find(points);
    sides_.findChanged(interference_.tubes(), posed.rotations, changed_);
  }
  report.detectMs += report.certifyMs;
  lookAtBones(which, report);
}

void Avoider::lookAtBones(Bones::Which which, AvoidReport& report) {
  if (!bones_) return;
  Timer timer(report.boneMs);
  boneContacts_ = bones_->contacts(interference_.tubes(), posedTubes_, which);
}

void Avoider::separate(const PosedVessels& posed, const VolumeKeeper* volume, std::span<vec4> points, AvoidReport& report) {
  for (unsigned round = 0; round < options_.rounds; ++round) {
    {
      Timer timer(report.solveMs);
      const std::span<const Bezier> tubes = interference_.tubes();
      const bool grew = pool_.refresh(tubes);
      const std::size_t added = pool_.add(places_, changed_, tubes, posed) + pool_.add(boneContacts_, tubes, posed);
      if (added == 0 && !grew) return;
      ++report.rounds;
      ascend();
      place(posed, volume, points);
    }
    look(posed, points, Bones::Which::nearAtLast, report);
  }
}

// Starts again, but vessels that bones hold against one another, and what hangs together with them within some nodes,
// are let through the bones.
void Avoider::letThroughBones(const PosedVessels& posed, const VolumeKeeper* volume, unsigned nodes,
                              std::span<vec4> points, AvoidReport& report) {
  std::vector<VesselId> vessels;
  std::vector<char> taken(network_->vessels().size(), 0);
  const auto take = [&](VesselId vessel) {
    if (!std::exchange(taken[vessel.value], char(1))) vessels.push_back(vessel);
  };
  for (const Interference::Place& place : remaining_)
    for (const std::uint32_t tube : {place.contact.i, place.contact.j}) take(interference_.layout().address(tube).vessel);
  for (std::size_t first = 0; nodes-- > 0;) {
    const std::size_t last = vessels.size();
    for (; first < last; ++first) {
      const Vessel& vessel = network_->vessel(vessels[first]);
      for (const NodeId id : {vessel.start, vessel.end}) {
        if (!id.valid()) continue;
        if (const auto& host = network_->node(id).host) take(host->vessel);
        for (const VesselEnd& end : network_->ends(network_->node(id))) take(end.vessel);
      }
    }
  }
  for (const VesselId vessel : vessels) pool_.letThroughBones(vessel);
  pool_.restart();
  std::fill(z_.begin(), z_.end(), vec3(0));
  narrowed_.clear();
  place(posed, volume, points);
  look(posed, points, Bones::Which::nearAtLast, report);
}

// Radii at interfering places are capped, and the rest of each vessel takes its volume; in the end, where that only
// moves the trouble about, volume is given up for the certificate.
void Avoider::giveWay(const PosedVessels& posed, const VolumeKeeper* volume, std::span<vec4> points, AvoidReport& report) {
  bool gave = false;
  for (unsigned round = 0; round < options_.lumenRounds && !certificateOf(places_, &remaining_).holds(); ++round) {
    {
      Timer timer(report.solveMs);
      if (!gave) {
        gave = true;
        before_.assign(points.begin(), points.end());
        most_.assign(points.size(), std::numeric_limits<float>::infinity());
      }
      const bool lastResort = 2 * round >= options_.lumenRounds, keepVolume = volume && !lastResort;
      narrow(*network_, interference_.layout(), remaining_, interference_.tubes(), points, lastResort, most_);
      for (std::size_t p = 0; p < points.size(); ++p)
        points[p].w = keepVolume ? network_->points()[p].w : std::min(points[p].w, most_[p]);
      if (keepVolume) volumeOutcome_ = volume->run(points, most_);
    }
    look(posed, points, Bones::Which::nearAtLast, report);
  }
  if (!gave) return;
  narrowed_ = narrowPlaces(*network_, before_, points);
  report.narrowSpans = std::uint32_t(narrowed_.size());
  report.leastLumen = 1;
  for (const NarrowPlace& narrow : narrowed_) report.leastLumen = std::min(report.leastLumen, narrow.factor);
}

AvoidReport Avoider::run(const PosedVessels& posed, const VolumeKeeper* volume, std::span<vec4> points) {
  AvoidReport report;
  pool_.clear();
  narrowed_.clear();
  std::fill(z_.begin(), z_.end(), vec3(0));
  if (bones_) {
    bones_->pose(posed.jointMatrices);
    interference_.layout().shape(posed.points, posedTubes_);
  }
  look(posed, points, Bones::Which::all, report);
  report.before = certificateOf(places_, &found_);
  report.sidesChanged = std::uint32_t(changed_.size());
  noteBones(boneContacts_, report.boneContacts, report.boneDepth);
  if (!report.before.holds() || !changed_.empty() || !boneContacts_.empty()) {
    separate(posed, volume, points, report);
    giveWay(posed, volume, points, report);
    for (const unsigned nodes : {2u, 1000u}) {
      if (!bones_ || certificateOf(places_, &remaining_).holds()) break;
      letThroughBones(posed, volume, nodes, points, report);
      separate(posed, volume, points, report);
      giveWay(posed, volume, points, report);
    }
  }
  if (report.rounds > 0) lookAtBones(Bones::Which::all, report);
  report.after = certificateOf(places_, &remaining_);
  report.sidesChangedAfter = std::uint32_t(changed_.size());
  noteBones(boneContacts_, report.boneContactsAfter, report.boneDepthAfter);
  report.volume = volumeOutcome_;
  report.constraints = std::uint32_t(pool_.constraints().size());
  noteMovement(posed.points, points, report);
  return report;
}

}  // namespace vasa
