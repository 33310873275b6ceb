#include "avoid/solver.h"

#include <algorithm>
#include <chrono>
#include <cmath>

// Coordinate ascent on the dual: with g = W⁻¹ a the response of the variables to a constraint's row a,
//   Δλ = (d - n·(C_i - C_j) - αλ) / (a·g + α),   λ <- max(0, λ + Δλ),   z += Δλ n g,
// so that z is always the minimiser for the present multipliers. α is a little compliance: where there is no room the
// multipliers stay finite.
namespace vasa {
namespace {

constexpr float kMargin = 5e-6f;      // [m] tubes nearer than this are still pushed
constexpr float kCompliance = 1e-3f;  // α as a share of a·g
constexpr unsigned kAllNeighboursEvery = 3;  // rounds
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

}  // namespace

Avoider::Avoider(const Network& network, AvoidOptions options)
    : network_(&network),
      options_(options),
      interference_(network),
      space_(network, options.bending),
      pool_(network, space_, interference_),
      z_(space_.variableCount()) {}

float Avoider::presentOf(const Constraint& constraint) const {
  vec3 motion(0);
  for (const auto& [variable, weight] : constraint.row.terms) motion += weight * z_[variable];
  return constraint.start + glm::dot(constraint.normal, motion);
}

void Avoider::push(Constraint& constraint, float amount) {
  const vec3 force = amount * constraint.normal;
  const float* response = constraint.row.response.data();
  for (const auto& [first, count] : constraint.row.runs)
    for (std::uint32_t k = 0; k < count; ++k) z_[first + k] += *response++ * force;
}

void Avoider::ascend() {
  for (unsigned sweep = 0; sweep < options_.sweeps; ++sweep) {
    float largest = 0;
    for (Constraint& constraint : pool_.constraints()) {
      const float compliance = kCompliance * constraint.row.diagonal;
      const float lack = constraint.distance - presentOf(constraint) - compliance * constraint.multiplier;
      const float step = std::max(lack / (constraint.row.diagonal + compliance), -constraint.multiplier);
      if (step == 0) continue;
      constraint.multiplier += step;
      push(constraint, step);
      largest = std::max(largest, std::abs(step) * constraint.row.diagonal);
    }
    if (largest < kSettled) return;
  }
}

void Avoider::project() {
  for (Constraint& constraint : pool_.constraints()) {
    const float lack = constraint.distance - presentOf(constraint);
    if (lack > 0) push(constraint, lack / constraint.row.diagonal);
  }
}

float Avoider::violation() const {
  float largest = 0;
  for (const Constraint& constraint : pool_.constraints())
    largest = std::max(largest, constraint.distance - presentOf(constraint));
  return largest;
}

void Avoider::place(const PosedNetwork& posed, const VolumeKeeper* volume, std::span<vec4> points) const {
  const std::span<const vec4> rest = network_->points();
  for (std::size_t p = 0; p < points.size(); ++p)
    points[p] = vec4(vec3(posed.points[p]), volume ? rest[p].w : points[p].w);
  space_.apply(z_, points);
  if (volume) volume->run(points);
}

void Avoider::separate(const PosedNetwork& posed, const VolumeKeeper* volume, std::span<vec4> points, AvoidReport& report) {
  const unsigned last = options_.rounds + options_.projections;
  // Neighbours seldom come to meet by being pushed: all of them are looked at now and then, and before it ends.
  Interference::Watch watch = Interference::Watch::neighboursThatMetLastTime;
  for (unsigned round = 0; round < last; ++round) {
    std::span<const Interference::Place> places;
    {
      Timer timer(report.detectMs);
      places = interference_.find(points, kMargin, watch);
    }
    Timer timer(report.solveMs);
    pool_.refresh(interference_.tubes());
    const std::size_t added = pool_.add(places, interference_.tubes(), posed);
    if (added == 0 && violation() < kMargin) {
      if (watch == Interference::Watch::allNeighbours) return;
      watch = Interference::Watch::allNeighbours;
      continue;
    }
    const bool all = round % kAllNeighboursEvery == 1 || round >= options_.rounds;
    watch = all ? Interference::Watch::allNeighbours : Interference::Watch::neighboursThatMetLastTime;
    ++report.rounds;
    if (round < options_.rounds) ascend();
    else project();
    place(posed, volume, points);
  }
}

void Avoider::giveWay(std::span<vec4> points, AvoidReport& report) {
  std::vector<vec4> before;
  for (unsigned round = 0; round < options_.lumenRounds; ++round) {
    {
      Timer timer(report.detectMs);
      if (certify(interference_, points, &remaining_).holds()) break;
    }
    Timer timer(report.solveMs);
    if (before.empty()) before.assign(points.begin(), points.end());
    narrow(*network_, interference_.layout(), remaining_, interference_.tubes(), points);
  }
  if (before.empty()) return;
  narrowed_ = narrowPlaces(*network_, before, points);
  report.narrowSpans = std::uint32_t(narrowed_.size());
  for (const NarrowPlace& narrow : narrowed_) report.leastLumen = std::min(report.leastLumen, narrow.factor);
}

AvoidReport Avoider::run(const PosedNetwork& posed, const VolumeKeeper* volume, std::span<vec4> points) {
  AvoidReport report;
  pool_.clear();
  narrowed_.clear();
  std::fill(z_.begin(), z_.end(), vec3(0));
  {
    Timer timer(report.detectMs);
    report.before = certify(interference_, points, &found_);
  }
  report.after = report.before;
  remaining_.clear();
  if (report.before.holds()) return report;
  separate(posed, volume, points, report);
  giveWay(points, report);
  {
    Timer timer(report.certifyMs);
    report.after = certify(interference_, points, &remaining_);
  }
  report.constraints = std::uint32_t(pool_.constraints().size());
  noteMovement(posed.points, points, report);
  return report;
}

}  // namespace vasa
