#include "avoid/solver.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

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
      z_(space_.variableCount()) {
  if (body) bones_ = std::make_unique<Bones>(*body, interference_.restTubes());
  if (getenv("DBG") && bones_) fprintf(stderr,"bones %u parts, %zu MB, rest %zu\n", bones_->partCount(), bones_->bytes()>>20, bones_->restContactCount());
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

void Avoider::place(const PosedNetwork& posed, const VolumeKeeper* volume, std::span<vec4> points) {
  const std::span<const vec4> rest = network_->points();
  for (std::size_t p = 0; p < points.size(); ++p)
    points[p] = vec4(vec3(posed.points[p]), volume ? rest[p].w : points[p].w);
  space_.apply(z_, points);
  if (volume) volumeOutcome_ = volume->run(points);
}

void Avoider::separate(const PosedNetwork& posed, const VolumeKeeper* volume, std::span<vec4> points, AvoidReport& report) {
  for (unsigned round = 0; round < options_.rounds; ++round) {
    std::span<const Interference::Place> places;
    {
      Timer timer(report.detectMs);
      places = interference_.find(points, 0);
      sides_.findChanged(interference_.tubes(), posed.rotations, changed_);
      if (bones_) boneContacts_ = bones_->contacts(interference_.tubes());
    }
    Timer timer(report.solveMs);
    const bool grew = pool_.refresh(interference_.tubes());
    const std::size_t added = pool_.add(places, changed_, interference_.tubes(), posed) +
                              pool_.add(boneContacts_, interference_.tubes(), posed);
    if (getenv("DBG")) { int n=0; float w=0; const Interference::Place* worst=nullptr; for (auto& q : places) if (q.interferes()) { ++n; if (q.excess()>w) w=q.excess(), worst=&q; }
      fprintf(stderr,"round %u viol %d changed %zu added %zu pool %zu poolviol %g worst %g", round, n, changed_.size(), added, pool_.constraints().size(), 0.0, w);
      if (worst) { auto a=interference_.layout().address(worst->contact.i), b=interference_.layout().address(worst->contact.j); fprintf(stderr," %s[%u] r%g - %s[%u] r%g allowed %g s %g t %g", network_->vessel(a.vessel).name.c_str(), a.span, interference_.tubes()[worst->contact.i].at(worst->contact.s).w, network_->vessel(b.vessel).name.c_str(), b.span,interference_.tubes()[worst->contact.j].at(worst->contact.t).w, worst->allowed, worst->contact.s, worst->contact.t); }
      fprintf(stderr,"\n"); }
    if (added == 0 && !grew) return;
    ++report.rounds;
    ascend();
    place(posed, volume, points);
  }
}

// Radii at interfering places are capped, and the rest of each vessel takes its volume; in the end, where that only
// moves the trouble about, volume is given up for the certificate.
void Avoider::giveWay(const VolumeKeeper* volume, std::span<vec4> points, AvoidReport& report) {
  bool gave = false;
  for (unsigned round = 0; round < options_.lumenRounds; ++round) {
    {
      Timer timer(report.detectMs);
      if (certify(interference_, points, &remaining_).holds()) break;
    }
    Timer timer(report.solveMs);
    if (!gave) {
      gave = true;
      before_.assign(points.begin(), points.end());
      most_.assign(points.size(), std::numeric_limits<float>::infinity());
    }
    narrow(*network_, interference_.layout(), remaining_, interference_.tubes(), points, most_);
    const bool keepVolume = volume && 2 * round < options_.lumenRounds;
    for (std::size_t p = 0; p < points.size(); ++p)
      points[p].w = keepVolume ? network_->points()[p].w : std::min(points[p].w, most_[p]);
    if (keepVolume) volumeOutcome_ = volume->run(points, most_);
  }
  if (!gave) return;
  narrowed_ = narrowPlaces(*network_, before_, points);
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
  if (bones_) {
    Timer timer(report.boneMs);
    bones_->pose(posed.jointMatrices);
    boneContacts_ = bones_->contacts(interference_.tubes());
    noteBones(boneContacts_, report.boneContacts, report.boneDepth);
    report.boneContactsAfter = report.boneContacts, report.boneDepthAfter = report.boneDepth;
  }
  sides_.findChanged(interference_.tubes(), posed.rotations, changed_);
  report.sidesChanged = report.sidesChangedAfter = std::uint32_t(changed_.size());
  if (report.before.holds() && changed_.empty() && boneContacts_.empty()) return report;
  separate(posed, volume, points, report);
  giveWay(volume, points, report);
  {
    Timer timer(report.certifyMs);
    report.after = certify(interference_, points, &remaining_);
    sides_.findChanged(interference_.tubes(), posed.rotations, changed_);
    report.sidesChangedAfter = std::uint32_t(changed_.size());
    if (bones_) noteBones(boneContacts_ = bones_->contacts(interference_.tubes()), report.boneContactsAfter, report.boneDepthAfter);
    if (getenv("DBGB")) for (auto& c : boneContacts_) { auto a=interference_.layout().address(c.tube); fprintf(stderr,"BONE %s|%u s%.2f r%.2f part %u f %.2f allowed %.2f\n", network_->vessel(a.vessel).name.c_str(), a.span, c.s, interference_.tubes()[c.tube].at(c.s).w*1e3, c.part, c.f*1e3, c.allowed*1e3); }
    if (getenv("DBG")) for (auto& c : changed_) { auto a=interference_.layout().address(c.i), b=interference_.layout().address(c.j);
      auto A=interference_.tubes()[c.i].at(c.s), B=interference_.tubes()[c.j].at(c.t); auto RA=interference_.restTubes()[c.i].at(c.s), RB=interference_.restTubes()[c.j].at(c.t);
      fprintf(stderr,"CH %s[%u/%u] s%.2f r%.2f - %s[%u/%u] t%.2f r%.2f  depth %.2f dist %.2f restdist %.2f mm carried %.2f\n", network_->vessel(a.vessel).name.c_str(), a.span, network_->vessel(a.vessel).spanCount(), c.s, A.w*1e3, network_->vessel(b.vessel).name.c_str(), b.span, network_->vessel(b.vessel).spanCount(), c.t, B.w*1e3, c.f*1e3, glm::distance(vec3(A),vec3(B))*1e3, glm::distance(vec3(RA),vec3(RB))*1e3, glm::length(sides_.carried({c.i,c.j,c.s,c.t}, interference_.tubes(), posed.rotations))); }
  }
  report.volume = volumeOutcome_;
  report.constraints = std::uint32_t(pool_.constraints().size());
  noteMovement(posed.points, points, report);
  return report;
}

}  // namespace vasa
