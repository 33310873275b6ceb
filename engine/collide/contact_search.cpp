#include "collide/contact_search.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "math/segment_distance.h"

// f(s, t) = |A(s) - B(t)| - r_a(s) - r_b(t). Newton on its parabola from above, |x| <= (|x|²/d + d) / 2 with
// d the present distance, which touches it to second order where the gap is at right angles to both curves,
// and is safe far away. Kept inside the unit square: a parameter at the edge that wants out stays there. A
// step that does not lower f is halved.
namespace vasa {
namespace {

constexpr std::size_t kPieces = 4;
constexpr int kSteps = 8;
constexpr double kEdge = 1e-12;  // a parameter as near to 0 or 1 is on the edge: rounding

struct Curve {
  std::array<dvec4, 4> b;

  Curve(const Bezier& tube, const dvec4& origin) {
    for (std::size_t k = 0; k < 4; ++k) b[k] = dvec4(tube.b[k]) - origin;
  }
  dvec4 at(double t) const {
    const double s = 1 - t;
    return s * s * s * b[0] + 3 * s * s * t * b[1] + 3 * s * t * t * b[2] + t * t * t * b[3];
  }
  dvec4 first(double t) const {
    const double s = 1 - t;
    return 3.0 * (s * s * (b[1] - b[0]) + 2 * s * t * (b[2] - b[1]) + t * t * (b[3] - b[2]));
  }
  dvec4 second(double t) const {
    return 6.0 * ((1 - t) * (b[0] - 2.0 * b[1] + b[2]) + t * (b[1] - 2.0 * b[2] + b[3]));
  }
};

struct State {
  double s, t, f;
  dvec3 gap;
};

State evaluate(const Curve& a, const Curve& b, double s, double t) {
  const dvec4 p = a.at(s), q = b.at(t);
  const dvec3 gap = dvec3(p) - dvec3(q);
  return {s, t, glm::length(gap) - p.w - q.w, gap};
}

// A curve's chords, each with a ball around it and its radii.
struct Chords {
  std::array<dvec4, kPieces + 1> ends;
  std::array<dvec4, kPieces> balls;
  double bulge;  // f of a piece is no farther below that of its chord, with any curve

  explicit Chords(const Curve& curve) {
    // A curve leaves a chord of 1/n of its parameters by |C''| / 8n², at most.
    const dvec4 bend0 = curve.b[0] - 2.0 * curve.b[1] + curve.b[2],
                bend1 = curve.b[1] - 2.0 * curve.b[2] + curve.b[3];
    const auto size = [](const dvec4& bend) { return glm::length(dvec3(bend)) + std::abs(bend.w); };
    bulge = 6 * std::max(size(bend0), size(bend1)) / (8.0 * kPieces * kPieces);
    for (std::size_t k = 0; k <= kPieces; ++k) ends[k] = curve.at(double(k) / kPieces);
    for (std::size_t k = 0; k < kPieces; ++k) {
      const dvec4 half = 0.5 * (ends[k + 1] - ends[k]);
      balls[k] = {dvec3(ends[k] + half), glm::length(dvec3(half)) + std::max(ends[k].w, ends[k + 1].w)};
    }
  }
};

// The chords of two curves, from each of which a search may start.
class ChordPairs {
 public:
  ChordPairs(const Curve& a, const Curve& b) : a_(&a), b_(&b), chordsA_(a), chordsB_(b) {
    for (std::size_t k = 0; k < least_.size(); ++k) {
      const dvec4 &p = chordsA_.balls[k / kPieces], &q = chordsB_.balls[k % kPieces];
      least_[k] = glm::distance(dvec3(p), dvec3(q)) - p.w - q.w;
    }
  }

  State nearest() const {
    Start best{std::numeric_limits<double>::infinity(), 0, 0};
    const auto look = [&](std::size_t k) {
      if (!(least_[k] < best.f)) return;
      if (const Start own = start(k); own.f < best.f) best = own;
    };
    look(std::size_t(std::ranges::min_element(least_) - least_.begin()));
    for (std::size_t k = 0; k < least_.size(); ++k) look(k);
    return evaluate(*a_, *b_, best.s, best.t);
  }

  // Pieces that may come nearer than a place which was found, and do not lie beside it: where tubes run along
  // one another, f has a minimum at each place where they come near.
  template <class Visit>
  void others(const State& found, const Visit& visit) const {
    constexpr double kBeside = 1.0 / kPieces;
    const double below = found.f + chordsA_.bulge + chordsB_.bulge;
    for (std::size_t k = 0; k < least_.size(); ++k) {
      if (!(least_[k] < below)) continue;
      const Start own = start(k);
      if (own.least < below && (std::abs(own.s - found.s) > kBeside || std::abs(own.t - found.t) > kBeside))
        visit(evaluate(*a_, *b_, own.s, own.t));
    }
  }

 private:
  struct Start {
    double f, s, t;
    double least = 0;  // what f cannot come below on the two chords
  };
  Start start(std::size_t k) const {
    const std::size_t i = k / kPieces, j = k % kPieces;
    const auto &p0 = chordsA_.ends[i], &p1 = chordsA_.ends[i + 1], &q0 = chordsB_.ends[j],
               &q1 = chordsB_.ends[j + 1];
    const auto near = closestOnSegments(dvec3(p0), dvec3(p1), dvec3(q0), dvec3(q1));
    return {near.distance - glm::mix(p0.w, p1.w, near.s) - glm::mix(q0.w, q1.w, near.t),
            (double(i) + near.s) / kPieces, (double(j) + near.t) / kPieces,
            near.distance - std::max(p0.w, p1.w) - std::max(q0.w, q1.w)};
  }

  const Curve *a_, *b_;
  Chords chordsA_, chordsB_;
  std::array<double, kPieces * kPieces> least_;  // what the f of two chords cannot come below
};

// The Newton direction at a state, before it is kept inside the square.
struct Direction {
  double ds, dt;
};

// How many such steps there are from a parameter to the edge.
double room(double parameter, double step) {
  if (step == 0) return std::numeric_limits<double>::infinity();
  return (step > 0 ? 1 - parameter : parameter) / std::abs(step);
}

Direction newton(const Curve& a, const Curve& b, const State& at) {
  const double distance = std::max(glm::length(at.gap), 1e-12);
  const dvec3 n = at.gap / distance;
  const dvec4 a1 = a.first(at.s), b1 = b.first(at.t), a2 = a.second(at.s), b2 = b.second(at.t);
  const dvec3 u(a1), v(b1);
  const double gs = glm::dot(n, u) - a1.w, gt = -glm::dot(n, v) - b1.w;
  const double uu = glm::dot(u, u) / distance, vv = glm::dot(v, v) / distance;
  const double ss = std::max(uu + glm::dot(n, dvec3(a2)) - a2.w, 0.1 * uu + 1e-300);
  const double tt = std::max(vv - glm::dot(n, dvec3(b2)) - b2.w, 0.1 * vv + 1e-300);
  double st = -glm::dot(u, v) / distance;
  if (st * st > 0.998 * ss * tt) st *= std::sqrt(0.998 * ss * tt) / std::abs(st);
  const bool holdS = (at.s <= 0 && gs > 0) || (at.s >= 1 && gs < 0),
             holdT = (at.t <= 0 && gt > 0) || (at.t >= 1 && gt < 0);
  if (holdS && holdT) return {0, 0};
  if (holdS) return {0, -gt / tt};
  if (holdT) return {-gs / ss, 0};
  const double determinant = ss * tt - st * st;
  const Direction both{-(gs * tt - gt * st) / determinant, -(gt * ss - gs * st) / determinant};
  if (room(at.s, both.ds) <= 0) return {0, -gt / tt};
  if (room(at.t, both.dt) <= 0) return {-gs / ss, 0};
  return both;
}

double onEdgeIfNear(double parameter) {
  return parameter < kEdge ? 0 : parameter > 1 - kEdge ? 1 : parameter;
}

State descend(const Curve& a, const Curve& b, State at) {
  for (int k = 0; k < kSteps; ++k) {
    const auto [ds, dt] = newton(a, b, at);
    if (std::abs(ds) + std::abs(dt) < 1e-9) break;
    double share = std::min({1.0, room(at.s, ds), room(at.t, dt)});
    State next = at;
    for (int halving = 0; halving < 6; ++halving, share *= 0.5) {
      next = evaluate(a, b, onEdgeIfNear(at.s + share * ds), onEdgeIfNear(at.t + share * dt));
      if (next.f < at.f) break;
    }
    if (!(next.f < at.f)) break;
    at = next;
  }
  return at;
}

Contact contactAt(const Curve& a, const Curve& b, const State& at) {
  Contact contact{0, 1, float(at.s), float(at.t), float(at.f), {}};
  const double distance = glm::length(at.gap);
  if (distance > 0) {
    contact.normal = vec3(at.gap / distance);
  } else {
    const dvec3 across = glm::cross(dvec3(a.first(at.s)), dvec3(b.first(at.t)));
    const double length = glm::length(across);
    contact.normal = length > 0 ? vec3(across / length) : vec3(0, 0, 1);
  }
  return contact;
}

}  // namespace

Contact nearestPlace(const Bezier& a, const Bezier& b) {
  const dvec4 origin(dvec3(a.b[0]), 0);
  const Curve ca(a, origin), cb(b, origin);
  const ChordPairs pairs(ca, cb);
  State best = descend(ca, cb, pairs.nearest());
  const State first = best;
  pairs.others(first, [&](const State& start) {
    if (const State other = descend(ca, cb, start); other.f < best.f) best = other;
  });
  return contactAt(ca, cb, best);
}

Contact nearestPlaceFrom(const Bezier& a, const Bezier& b, float s, float t) {
  const dvec4 origin(dvec3(a.b[0]), 0);
  const Curve ca(a, origin), cb(b, origin);
  return contactAt(ca, cb, descend(ca, cb, evaluate(ca, cb, s, t)));
}

}  // namespace vasa
