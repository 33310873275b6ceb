#include "body/reach.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

// A point at the end of a chain of joints moves by ω × (point - joint) where an angle of the joint turns it
// about ω. Of bend and spread, which are one turn v across the bone, ω is the left Jacobian of exp(v) times
// the axis; of the twist, which comes first, the bone's axis as v turns it. Gradients are exact; the second
// derivatives, which the nearest place to an unreachable target asks for, are differences of them. All in
// double precision.
namespace vasa {
namespace {

using dmat3 = glm::dmat3;
using dmat4 = glm::dmat4;

constexpr double kRather = 1e-6;  // [m²/rad²] for staying at what is preferred
// [rad] A start is kept off its limits: a straight elbow would not know that it can bend.
constexpr double kFromLimit = 0.03;
// [rad] Further, and another way of reaching may be found than the one one is on.
constexpr double kLongestStep = 0.4;
constexpr int kMostSteps = 80;
constexpr float kThere = 1e-3f;  // [m]
// [m] Another way must bring the end nearer by this where neither gets there: less would flicker.
constexpr float kNearer = 5e-3f;
// Of 1,000 targets of an arm's, from rest, 10 are missed without, 1 with 4, none with 8.
constexpr int kOtherStarts = 16;

dmat4 inDouble(const mat4& m) { return dmat4(m); }

dmat3 cross(dvec3 v) { return {0, v.z, -v.y, -v.z, 0, v.x, v.y, -v.x, 0}; }

dmat3 turnAcross(dvec3 v) {
  const double size = glm::length(v);
  const dmat3 k = cross(v);
  if (size < 1e-8) return dmat3(1) + k;
  return dmat3(1) + std::sin(size) / size * k + (1 - std::cos(size)) / (size * size) * k * k;
}

dmat3 leftJacobian(dvec3 v) {
  const double size = glm::length(v);
  const dmat3 k = cross(v);
  if (size < 1e-4) return dmat3(1) + 0.5 * k + k * k / 6.0;
  return dmat3(1) + (1 - std::cos(size)) / (size * size) * k +
         (size - std::sin(size)) / (size * size * size) * k * k;
}

dmat3 twistBy(double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {c, s, 0, -s, c, 0, 0, 0, 1};
}

dmat3 directions(const dmat4& m) {
  return {glm::normalize(dvec3(m[0])), glm::normalize(dvec3(m[1])), glm::normalize(dvec3(m[2]))};
}

/// The limb as a chain of transforms that the angles go between.
class Chain {
 public:
  Chain(const Skeleton& skeleton, const Pose& pose, const ReachLimb& limb) {
    dmat4 way(1);  // from the joint before to this one's parent
    for (const ReachJoint& each : limb.joints) {
      const Skeleton::Joint& joint = skeleton.joints[each.joint.value];
      const dmat4 parent =
          joint.parent.valid() ? inDouble(pose.world[joint.parent.value]) : inDouble(skeleton.rootTransform);
      const dmat4 world = inDouble(pose.world[each.joint.value]);
      const dmat4 local = glm::inverse(parent) * world;
      Link link;
      const dmat4 before = links_.empty() ? parent : way * parent;
      link.before = glm::translate(before, dvec3(local[3])) *
                    glm::mat4_cast(glm::dquat(joint.rest.rotation) * glm::dquat(each.axes));
      link.after = glm::scale(
          glm::mat4_cast(glm::inverse(glm::dquat(each.axes))),
          {glm::length(dvec3(local[0])), glm::length(dvec3(local[1])), glm::length(dvec3(local[2]))});
      links_.push_back(link);
      way = glm::inverse(world);
    }
    tip_ = way * inDouble(pose.world[limb.tip.value]) * dvec4(dvec3(limb.offset), 1);
  }

  dvec3 end(std::span<const dvec3> angles) const {
    dmat4 world(1);
    for (std::size_t k = 0; k < links_.size(); ++k)
      world = world * links_[k].before * turned(angles[k]) * links_[k].after;
    return dvec3(world * tip_);
  }

  /// The end, and how each angle moves it.
  dvec3 end(std::span<const dvec3> angles, std::vector<dmat3>& moves) const {
    std::vector<dvec3> centres;
    moves.clear();
    dmat4 world(1);
    for (std::size_t k = 0; k < links_.size(); ++k) {
      const dmat4 here = world * links_[k].before;
      const dvec3 v(angles[k].x, angles[k].y, 0);
      dmat3 axes = leftJacobian(v);
      axes[2] = turnAcross(v)[2];
      moves.push_back(directions(here) * axes);
      centres.push_back(dvec3(here[3]));
      world = here * turned(angles[k]) * links_[k].after;
    }
    const dvec3 there(world * tip_);
    for (std::size_t k = 0; k < moves.size(); ++k)
      for (int axis = 0; axis < 3; ++axis) moves[k][axis] = glm::cross(moves[k][axis], there - centres[k]);
    return there;
  }

 private:
  static dmat4 turned(dvec3 angles) { return dmat4(turnAcross({angles.x, angles.y, 0}) * twistBy(angles.z)); }
  struct Link {
    dmat4 before, after;  // of its turn
  };
  std::vector<Link> links_;
  dvec4 tip_{0, 0, 0, 1};
};

using Values = std::vector<double>;

/// What is made least, over the angles that are free to change.
class Search {
 public:
  Search(const Chain& chain, const ReachLimb& limb, dvec3 target, std::span<const vec3> preferred,
         std::span<const vec3> start)
      : chain_(chain), limb_(limb), target_(target), angles_(start.begin(), start.end()) {
    for (std::size_t k = 0; k < limb.joints.size(); ++k)
      for (int axis = 0; axis < 3; ++axis) {
        const double low = limb.joints[k].least[axis], high = limb.joints[k].most[axis];
        angles_[k][axis] = std::clamp(angles_[k][axis], low, std::max(low, high));
        if (!(high > low)) continue;
        free_.push_back({k, axis, low, high, double(preferred[k][axis])});
        const double gap = std::min(kFromLimit, 0.25 * (high - low));
        at_.push_back(std::clamp(angles_[k][axis], low + gap, high - gap));
      }
  }

  Values& at() { return at_; }
  double low(std::size_t i) const { return free_[i].low; }
  double high(std::size_t i) const { return free_[i].high; }

  double value(const Values& x) {
    const dvec3 off = chain_.end(put(x)) - target_;
    double sum = 0.5 * glm::dot(off, off);
    for (std::size_t i = 0; i < x.size(); ++i)
      sum += 0.5 * rather(i) * (x[i] - free_[i].preferred) * (x[i] - free_[i].preferred);
    return sum;
  }

  Values gradient(const Values& x) {
    const dvec3 off = chain_.end(put(x), moves_) - target_;
    Values slope(x.size());
    for (std::size_t i = 0; i < x.size(); ++i)
      slope[i] =
          glm::dot(off, moves_[free_[i].joint][free_[i].axis]) + rather(i) * (x[i] - free_[i].preferred);
    return slope;
  }

  /// Row after row; symmetric.
  Values curvature(const Values& x, const Values& slope) {
    constexpr double kStep = 1e-6;
    const std::size_t n = x.size();
    Values h(n * n);
    for (std::size_t i = 0; i < n; ++i) {
      Values aside = x;
      aside[i] += kStep;
      const Values there = gradient(aside);
      for (std::size_t j = 0; j < n; ++j) h[i * n + j] = (there[j] - slope[j]) / kStep;
    }
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < i; ++j) h[i * n + j] = h[j * n + i] = 0.5 * (h[i * n + j] + h[j * n + i]);
    return h;
  }

  Reached result() {
    const dvec3 end = chain_.end(put(at_));
    Reached reached{{}, vec3(end), float(glm::distance(end, target_))};
    for (std::size_t k = 0; k < angles_.size(); ++k)
      reached.angles.push_back(glm::clamp(vec3(angles_[k]), limb_.joints[k].least, limb_.joints[k].most));
    return reached;
  }

 private:
  struct Free {
    std::size_t joint;
    int axis;
    double low, high, preferred;
  };
  double rather(std::size_t i) const { return kRather * double(limb_.joints[free_[i].joint].stiffness); }
  const std::vector<dvec3>& put(const Values& x) {
    for (std::size_t i = 0; i < x.size(); ++i) angles_[free_[i].joint][free_[i].axis] = x[i];
    return angles_;
  }

  const Chain& chain_;
  const ReachLimb& limb_;
  dvec3 target_;
  std::vector<dvec3> angles_;
  std::vector<Free> free_;
  Values at_;
  std::vector<dmat3> moves_;
};

// Cholesky. Rows and columns that are held keep their value. False: the matrix has no least value.
bool solve(Values h, double damping, const std::vector<char>& held, const Values& slope, Values& step) {
  const std::size_t n = slope.size();
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j)
      if (held[i] || held[j]) h[i * n + j] = i == j ? 1 : 0;
    h[i * n + i] += damping;
    step[i] = held[i] ? 0 : -slope[i];
  }
  for (std::size_t j = 0; j < n; ++j) {
    for (std::size_t k = 0; k < j; ++k) h[j * n + j] -= h[j * n + k] * h[j * n + k];
    if (h[j * n + j] <= 1e-14) return false;
    h[j * n + j] = std::sqrt(h[j * n + j]);
    for (std::size_t i = j + 1; i < n; ++i) {
      for (std::size_t k = 0; k < j; ++k) h[i * n + j] -= h[i * n + k] * h[j * n + k];
      h[i * n + j] /= h[j * n + j];
    }
  }
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t k = 0; k < i; ++k) step[i] -= h[i * n + k] * step[k];
    step[i] /= h[i * n + i];
  }
  for (std::size_t i = n; i-- > 0;) {
    for (std::size_t k = i + 1; k < n; ++k) step[i] -= h[k * n + i] * step[k];
    step[i] /= h[i * n + i];
  }
  return true;
}

// One step downhill, within the limits; false where there is none.
bool descend(Search& search, double& damping) {
  constexpr double kAtLimit = 1e-9, kMostDamping = 1e6;
  Values& x = search.at();
  const Values slope = search.gradient(x);
  std::vector<char> held(x.size());
  double steepest = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    held[i] = (x[i] <= search.low(i) + kAtLimit && slope[i] > 0) ||
              (x[i] >= search.high(i) - kAtLimit && slope[i] < 0);
    if (!held[i]) steepest = std::max(steepest, std::abs(slope[i]));
  }
  if (steepest < 1e-10) return false;
  const double before = search.value(x);
  const Values curvature = search.curvature(x, slope);
  for (; damping < kMostDamping; damping *= 8) {
    Values step(x.size());
    if (!solve(curvature, damping, held, slope, step)) continue;
    double longest = 0;
    for (const double s : step) longest = std::max(longest, std::abs(s));
    Values next = x;
    for (std::size_t i = 0; i < x.size(); ++i)
      next[i] =
          std::clamp(x[i] + step[i] * std::min(1.0, kLongestStep / longest), search.low(i), search.high(i));
    if (search.value(next) >= before) continue;
    x = std::move(next);
    damping = std::max(damping / 20, 1e-9);
    return true;
  }
  return false;
}

Reached searched(const Chain& chain, const ReachLimb& limb, vec3 target, std::span<const vec3> preferred,
                 std::span<const vec3> start) {
  Search search(chain, limb, dvec3(target), preferred, start);
  double damping = 1e-6;
  for (int step = 0; step < kMostSteps && descend(search, damping);) ++step;
  return search.result();
}

// The n-th of a row of numbers that fill 0 to 1 evenly (van der Corput).
float evenly(int n, int base) {
  float share = 1, sum = 0;
  for (; n > 0; n /= base) share /= float(base), sum += share * float(n % base);
  return sum;
}

// Angles spread over what the limits leave (Halton 1960): for every base another row.
std::vector<vec3> otherStart(const ReachLimb& limb, int n) {
  constexpr int kBases[] = {2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37};
  std::vector<vec3> start;
  std::size_t row = 0;
  for (const ReachJoint& joint : limb.joints) {
    vec3 angles = joint.least;
    for (int axis = 0; axis < 3; ++axis)
      if (joint.most[axis] > joint.least[axis])
        angles[axis] =
            glm::mix(joint.least[axis], joint.most[axis], evenly(n, kBases[row++ % std::size(kBases)]));
    start.push_back(angles);
  }
  return start;
}

}  // namespace

Reached reach(const Skeleton& skeleton, const Pose& pose, const ReachLimb& limb, vec3 target,
              std::span<const vec3> preferred, std::span<const vec3> start) {
  const Chain chain(skeleton, pose, limb);
  Reached best = searched(chain, limb, target, preferred, start);
  for (int n = 1; n <= kOtherStarts && best.miss > kThere; ++n) {
    Reached other = searched(chain, limb, target, preferred, otherStart(limb, n));
    if (other.miss <= kThere || other.miss < best.miss - kNearer) best = std::move(other);
  }
  return best;
}

vec3 endOf(const Skeleton& skeleton, const Pose& pose, const ReachLimb& limb, std::span<const vec3> angles) {
  const std::vector<dvec3> exact(angles.begin(), angles.end());
  return vec3(Chain(skeleton, pose, limb).end(exact));
}

}  // namespace vasa
