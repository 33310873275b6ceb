#include "support/walk.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "avoid/sides.h"

namespace vasa::test {
namespace {

constexpr float kShortest = 1 / 8.0f;  // of a step: made however far it goes in

}  // namespace

Posed atRest(const Network& network, std::size_t joints) {
  return unturned({network.points().begin(), network.points().end()}, std::vector<mat4>(joints, mat4(1)));
}

Posed unturned(std::vector<vec4> points, std::vector<mat4> joints) {
  std::vector<quat> rotations(points.size(), quat(1, 0, 0, 0));
  return {std::move(points), std::move(rotations), std::move(joints)};
}

Posed between(const Posed& from, const Posed& to, float share) {
  if (share >= 1) return to;
  Posed at = from;
  for (std::size_t p = 0; p < at.points.size(); ++p) {
    at.points[p] = glm::mix(from.points[p], to.points[p], share);
    at.rotations[p] = glm::slerp(from.rotations[p], to.rotations[p], share);
  }
  for (std::size_t j = 0; j < at.joints.size(); ++j)
    at.joints[j] = from.joints[j] * (1 - share) + to.joints[j] * share;
  return at;
}

std::size_t changedSides(const Network& network, const Posed& posed, std::span<const vec4> points) {
  Interference interference(network);
  RestSides sides(network, interference);
  interference.find(points);
  std::vector<RestSides::Turned> changed;
  sides.findChanged(interference.tubes(), posed.rotations, changed);
  return changed.size();
}

Walker::Walker(Avoider& avoider, const Posed& rest, const VolumeKeeper* volume)
    : avoider_(&avoider),
      volume_(volume),
      posed_(rest),
      points_(rest.points),
      corrections_(points_.size(), vec3(0)) {
  avoider.start({}, posed_, volume, points_);
}

AvoidReport Walker::along(const std::function<Posed(float)>& way, unsigned steps, float seconds) {
  AvoidReport last;
  const float longest = 1 / float(steps);
  for (float done = 0; done < 1;) {
    for (float length = std::min(longest, 1 - done);; length /= 2) {
      const float next = done + length > 1 - 0.5f * kShortest * longest ? 1 : done + length;
      const Posed posed = way(next);
      const bool shortest = length <= kShortest * longest;
      const auto report = avoider_->step(posed, volume_, {(next - done) * seconds, shortest, true}, points_);
      if (!report) continue;
      last = *report;
      arrive(posed, last);
      done = next;
      break;
    }
  }
  return last;
}

AvoidReport Walker::to(const Posed& target) {
  const Posed from = posed_;
  float farthest = 0;
  for (std::size_t p = 0; p < from.points.size(); ++p)
    farthest = std::max(farthest, glm::distance(vec3(from.points[p]), vec3(target.points[p])));
  for (std::size_t j = 0; j < from.joints.size(); ++j)
    farthest = std::max(farthest, glm::distance(vec3(from.joints[j][3]), vec3(target.joints[j][3])));
  const auto steps = std::max(unsigned(std::ceil(farthest / kStep)), 1u);
  return along([&](float share) { return between(from, target, share); }, steps, float(steps) * kStepSeconds);
}

AvoidReport Walker::stay(unsigned steps, float seconds) {
  AvoidReport last;
  for (unsigned k = 0; k < steps; ++k) last = jump(posed_, seconds);
  return last;
}

AvoidReport Walker::jump(const Posed& target, float seconds) {
  const AvoidReport report = *avoider_->step(target, volume_, {seconds, true, true}, points_);
  arrive(target, report);
  return report;
}

void Walker::arrive(const Posed& posed, const AvoidReport& report) {
  posed_ = posed;
  correctionStep_ = 0;
  for (std::size_t p = 0; p < points_.size(); ++p) {
    const vec3 correction = vec3(points_[p]) - vec3(posed.points[p]);
    correctionStep_ = std::max(correctionStep_, glm::distance(correction, corrections_[p]));
    corrections_[p] = correction;
  }
  seen(report);
}

Solved solve(Avoider& avoider, const Posed& rest, const Posed& pose) {
  Walker walker(avoider, rest);
  const AvoidReport report = walker.to(pose);
  return {avoider.look(pose, pose.points), report, walker.points()};
}

Way wayOf(Walker& walker, const std::function<Posed(float)>& way, unsigned steps) {
  Way made;
  const auto seen = walker.seen;
  walker.seen = [&](const AvoidReport& report) {
    seen(report);
    made.largest = std::max(made.largest, walker.correctionStep());
  };
  walker.along(way, steps, 1);
  walker.seen = seen;
  made.end = walker.points();
  return made;
}

void checkShorterSteps(const std::function<Way(unsigned)>& made, float apart, float share) {
  Way coarse = made(30);
  for (const unsigned steps : {120u, 480u}) {
    CAPTURE(steps);
    const Way fine = made(steps);
    float farthest = 0;
    for (std::size_t p = 0; p < fine.end.size(); ++p)
      farthest = std::max(farthest, glm::distance(vec3(fine.end[p]), vec3(coarse.end[p])));
    MESSAGE(steps << " steps: " << 1e3f * farthest << " mm apart, largest " << 1e3f * fine.largest
                  << " mm of " << 1e3f * coarse.largest << " mm");
    CHECK(farthest < apart);
    CHECK(fine.largest < share * coarse.largest);
    coarse = fine;
  }
}

std::vector<vec4> line(vec3 from, vec3 to, float radius, std::uint32_t count) {
  std::vector<vec4> points;
  for (std::uint32_t k = 0; k < count; ++k)
    points.emplace_back(glm::mix(from, to, float(k) / float(count - 1)), radius);
  return points;
}

}  // namespace vasa::test
