#include "collide/closest_tubes.h"

#include <algorithm>
#include <array>
#include <limits>
#include <optional>

#include "math/segment_distance.h"

// A piece of a tube is its four control points, halved by de Casteljau. Around its chord c the piece lies within
// ¾ max(|e1|, |e2|) (curve/bounds.cpp), and its radius below its largest coefficient, so for two pieces
//   f >= |c_a - c_b| - deviation_a - deviation_b - r_a - r_b,
// while f at the chords' nearest parameters is an upper bound. The difference of the two shrinks fourfold with
// each halving of both pieces. Coordinates are taken relative to a's first point: the numbers are then as
// small as the tubes, and the subtraction of two floats in double precision is exact.
namespace vasa {
namespace {

struct Piece {
  std::array<dvec4, 4> b;
  double from = 0, to = 1;

  dvec3 point(int i) const { return dvec3(b[i]); }
  double deviation() const {
    const dvec3 e1 = point(1) - (2.0 * point(0) + point(3)) / 3.0, e2 = point(2) - (point(0) + 2.0 * point(3)) / 3.0;
    return 0.75 * std::sqrt(std::max(glm::dot(e1, e1), glm::dot(e2, e2)));
  }
  double radius() const { return std::max(std::max(b[0].w, b[1].w), std::max(b[2].w, b[3].w)); }
  double spread() const {
    return deviation() + radius() - std::min(std::min(b[0].w, b[1].w), std::min(b[2].w, b[3].w));
  }
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
  return s * s * s * whole.b[0] + 3 * s * s * t * whole.b[1] + 3 * s * t * t * whole.b[2] + t * t * t * whole.b[3];
}

struct Candidate {
  Piece a, b;
  double lower;
};

struct Search {
  Piece a, b;           // whole tubes
  double tolerance;
  bool asks;            // only whether f < limit
  double limit;
  double best = std::numeric_limits<double>::infinity();
  double bestS = 0, bestT = 0;
  std::vector<Candidate> heap = {};

  void tryValue(double s, double t) {
    const dvec4 p = at(a, s), q = at(b, t);
    const double f = glm::distance(dvec3(p), dvec3(q)) - p.w - q.w;
    if (f < best) best = f, bestS = s, bestT = t;
  }

  // A pair of pieces is dropped once it cannot hold a value that matters.
  double threshold() const { return std::min(best, asks ? limit : best) - tolerance; }

  void add(const Piece& pa, const Piece& pb) {
    const auto near = closestOnSegments(pa.point(0), pa.point(3), pb.point(0), pb.point(3));
    tryValue(pa.from + near.s * (pa.to - pa.from), pb.from + near.t * (pb.to - pb.from));
    const double lower = near.distance - pa.deviation() - pb.deviation() - pa.radius() - pb.radius();
    if (lower >= threshold()) return;
    heap.push_back({pa, pb, lower});
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
      if (next.a.spread() >= next.b.spread()) {
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
  Search search{pieceOf(a, origin), pieceOf(b, origin), tolerance, asks, limit};
  double size = 0;
  for (int i = 0; i < 4; ++i)
    for (int axis = 0; axis < 4; ++axis)
      size = std::max({size, std::abs(search.a.b[i][axis]), std::abs(search.b.b[i][axis])});
  search.tolerance = std::max(tolerance, 1e-7 * size * 1e-5);
  search.run();
  return search;
}

}  // namespace

bool tubesIntersect(const Bezier& a, const Bezier& b, double tolerance, double margin) {
  return searchOf(a, b, tolerance, true, margin).best < margin;
}

Contact closestOfTubes(const Bezier& a, const Bezier& b, double tolerance) {
  const Search search = searchOf(a, b, tolerance, false, 0);
  const dvec3 gap = dvec3(at(search.a, search.bestS)) - dvec3(at(search.b, search.bestT));
  const double distance = glm::length(gap);
  Contact contact{0, 1, float(search.bestS), float(search.bestT), float(search.best), {0, 0, 1}};
  if (distance > 0) contact.normal = vec3(gap / distance);
  return contact;
}

std::vector<TubePair> intersectingPairsByBruteForce(std::span<const Bezier> tubes, const Exclusions& exclusions,
                                                    double tolerance) {
  std::vector<Aabb> boxes;
  for (const Bezier& tube : tubes) boxes.push_back(tube.bounds());
  std::vector<TubePair> pairs;
  for (std::uint32_t i = 0; i < tubes.size(); ++i)
    for (std::uint32_t j = i + 1; j < tubes.size(); ++j)
      if (boxes[i].overlaps(boxes[j]) && !exclusions.contains(i, j) && tubesIntersect(tubes[i], tubes[j], tolerance))
        pairs.push_back({i, j});
  return pairs;
}

}  // namespace vasa
