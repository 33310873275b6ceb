#include "collide/closest_tubes.h"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>
#include <vector>

#include "math/segment_distance.h"

// A piece of a tube is its four control points, halved by de Casteljau. Its curve lies within d = ¾ max(|e1|,
// |e2|) of its chord, point by point (curve/bounds.cpp), and its radius no more than the same bound of the
// radius coefficients above the straight line between its end radii. So, with the chords' points P(s), Q(t)
// and linear radii p(s), q(t),
//   f >= min g - d_a - d_b - e_a - e_b,   g(s, t) = |P(s) - Q(t)| - p(s) - q(t).
// g is convex: any tangent plane lies below it, and the plane's least value over the unit square is a lower
// bound, close to the minimum where the tangent point is close to the minimum's. A few Newton steps take it
// there. The whole error is thus of second order: it shrinks fourfold with each halving. f itself at those
// parameters is an upper bound. Coordinates are taken relative to a's first point: the numbers are then as
// small as the tubes, and the subtraction of two floats in double precision is exact.
namespace vasa {
namespace {

struct Piece {
  std::array<dvec4, 4> b;
  double from = 0, to = 1;

  dvec3 point(int i) const { return dvec3(b[i]); }
  double deviation() const {
    const dvec3 e1 = point(1) - (2.0 * point(0) + point(3)) / 3.0,
                e2 = point(2) - (point(0) + 2.0 * point(3)) / 3.0;
    return 0.75 * std::sqrt(std::max(glm::dot(e1, e1), glm::dot(e2, e2)));
  }
  /// How much higher than the straight line between its ends the radius may be.
  double radiusExcess() const {
    const double e1 = b[1].w - (2 * b[0].w + b[3].w) / 3, e2 = b[2].w - (b[0].w + 2 * b[3].w) / 3;
    return 0.75 * std::max({e1, e2, 0.0});
  }
  double slack() const { return deviation() + radiusExcess(); }
  double leastRadius() const { return std::min(std::min(b[0].w, b[1].w), std::min(b[2].w, b[3].w)); }
  double length() const { return glm::distance(point(0), point(3)); }
  std::pair<Piece, Piece> halves() const {
    const dvec4 p01 = 0.5 * (b[0] + b[1]), p12 = 0.5 * (b[1] + b[2]), p23 = 0.5 * (b[2] + b[3]);
    const dvec4 p012 = 0.5 * (p01 + p12), p123 = 0.5 * (p12 + p23), middle = 0.5 * (p012 + p123);
    const double half = 0.5 * (from + to);
    return {{{b[0], p01, p012, middle}, from, half}, {{middle, p123, p23, b[3]}, half, to}};
  }
};

Piece pieceOf(const Bezier& tube, const dvec4& origin) {
  Piece piece;
  for (int i = 0; i < 4; ++i) piece.b[i] = dvec4(tube.b[i]) - origin;
  return piece;
}

dvec4 at(const Piece& whole, double t) {
  const double s = 1 - t;
  return s * s * s * whole.b[0] + 3 * s * s * t * whole.b[1] + 3 * s * t * t * whole.b[2] +
         t * t * t * whole.b[3];
}

// g of two chords with linear radii, at (s, t), and the tangent plane there.
struct Cones {
  dvec3 w, u, v;
  double radii, du, dv;  // radii at s = t = 0, growth along s and t

  Cones(const Piece& a, const Piece& b)
      : w(a.point(0) - b.point(0)),
        u(a.point(3) - a.point(0)),
        v(b.point(3) - b.point(0)),
        radii(a.b[0].w + b.b[0].w),
        du(a.b[3].w - a.b[0].w),
        dv(b.b[3].w - b.b[0].w) {}

  struct Tangent {
    double lower;   // least value of the tangent plane over the unit square
    double value;   // g
    double ds, dt;  // its slopes
    dvec3 normal;
    double distance;
  };
  Tangent tangent(double s, double t) const {
    const dvec3 gap = w + s * u - t * v;
    const double distance = glm::length(gap);
    const dvec3 normal = distance > 0 ? gap / distance : dvec3(0);
    const double value = distance - radii - s * du - t * dv;
    const double ds = glm::dot(normal, u) - du, dt = -glm::dot(normal, v) - dv;
    const double lower = value + std::min(-s * ds, (1 - s) * ds) + std::min(-t * dt, (1 - t) * dt);
    return {lower, value, ds, dt, normal, distance};
  }
  // One Newton step, kept inside the square; where g is flat in a direction it goes to the end that is
  // downhill.
  void step(const Tangent& at, double& s, double& t) const {
    const double nu = glm::dot(at.normal, u), nv = glm::dot(at.normal, v);
    const double least = 1e-12 * (glm::dot(u, u) + glm::dot(v, v)) + 1e-300;
    const double uu = glm::dot(u, u) - nu * nu + least, vv = glm::dot(v, v) - nv * nv + least;
    const double uv = -(glm::dot(u, v) - nu * nv), gs = at.ds * at.distance, gt = at.dt * at.distance;
    const double determinant = std::max(uu * vv - uv * uv, 1e-24 * uu * vv);
    const double s0 = s, t0 = t;
    s = glm::clamp(s0 - (gs * vv - gt * uv) / determinant, 0.0, 1.0);
    t = glm::clamp(t0 - (gt + uv * (s - s0)) / vv, 0.0, 1.0);
    s = glm::clamp(s0 - (gs + uv * (t - t0)) / uu, 0.0, 1.0);
  }
};

struct Candidate {
  Piece a, b;
  double lower;
};

constexpr int kNewtonSteps = 6;
constexpr std::size_t kMostlyEnough = 256;  // candidates

struct Search {
  Piece a, b;  // whole tubes
  double tolerance;
  bool asks;  // only whether f < limit
  double limit;
  std::vector<Candidate>& heap;
  double best = std::numeric_limits<double>::infinity();
  double bestS = 0, bestT = 0;

  void tryValue(double s, double t) {
    const dvec4 p = at(a, s), q = at(b, t);
    const double f = glm::distance(dvec3(p), dvec3(q)) - p.w - q.w;
    if (f < best) best = f, bestS = s, bestT = t;
  }

  // A pair of pieces is dropped once it cannot hold a value that matters.
  double threshold() const { return std::min(best, asks ? limit : best) - tolerance; }

  void add(const Piece& pa, const Piece& pb) {
    const double slack = pa.slack() + pb.slack();
    const auto near = closestOnSegments(pa.point(0), pa.point(3), pb.point(0), pb.point(3));
    const Cones cones(pa, pb);
    double s = near.s, t = near.t, lower = -std::numeric_limits<double>::infinity();
    for (int k = 0; k < kNewtonSteps; ++k) {
      const auto tangent = cones.tangent(s, t);
      lower = std::max(lower, tangent.lower);
      if (tangent.value - lower <= 0.25 * std::max(slack, tolerance) || lower - slack >= threshold()) break;
      cones.step(tangent, s, t);
    }
    tryValue(pa.from + s * (pa.to - pa.from), pb.from + t * (pb.to - pb.from));
    if (lower - slack >= threshold()) return;
    heap.push_back({pa, pb, lower - slack});
    std::push_heap(heap.begin(), heap.end(), later);
  }
  static bool later(const Candidate& x, const Candidate& y) { return x.lower > y.lower; }

  void run() {
    add(a, b);
    while (!heap.empty()) {
      if (asks && best < limit) return;
      std::pop_heap(heap.begin(), heap.end(), later);
      const Candidate next = heap.back();
      heap.pop_back();
      if (next.lower >= threshold()) return;
      // The one that spoils the bound more; of two straight ones, the longer.
      const double excess = next.a.slack() - next.b.slack();
      if (excess > 0 || (excess == 0 && next.a.length() >= next.b.length())) {
        const auto [low, high] = next.a.halves();
        add(low, next.b);
        add(high, next.b);
      } else {
        const auto [low, high] = next.b.halves();
        add(next.a, low);
        add(next.a, high);
      }
    }
  }
};

Search searchOf(const Bezier& a, const Bezier& b, double tolerance, bool asks, double limit) {
  const dvec4 origin(dvec3(a.b[0]), 0);
  static thread_local std::vector<Candidate> heap;  // kept, so that a search allocates nothing
  heap.clear();
  heap.reserve(kMostlyEnough);
  Search search{pieceOf(a, origin), pieceOf(b, origin), tolerance, asks, limit, heap};
  double size = 0;
  for (int i = 0; i < 4; ++i)
    for (int axis = 0; axis < 4; ++axis)
      size = std::max({size, std::abs(search.a.b[i][axis]), std::abs(search.b.b[i][axis])});
  search.tolerance = std::max(tolerance, 1e-12 * size);  // below it, double precision itself gives out
  search.run();
  return search;
}

Contact contactOf(const Search& search) {
  const dvec3 gap = dvec3(at(search.a, search.bestS)) - dvec3(at(search.b, search.bestT));
  const double distance = glm::length(gap);
  Contact contact{0, 1, float(search.bestS), float(search.bestT), float(search.best), {0, 0, 1}};
  if (distance > 0) contact.normal = vec3(gap / distance);
  return contact;
}

}  // namespace

bool tubesIntersect(const Bezier& a, const Bezier& b, double tolerance, double margin) {
  return searchOf(a, b, tolerance, true, margin).best < margin;
}

Contact closestOfTubes(const Bezier& a, const Bezier& b, double tolerance) {
  return contactOf(searchOf(a, b, tolerance, false, 0));
}

}  // namespace vasa
