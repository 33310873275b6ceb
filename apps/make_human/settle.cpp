#include <algorithm>
#include <cmath>

#include "make_human/course.h"
#include "make_human/segment_grid.h"
#include "math/segment_distance.h"

namespace vasa::human {
namespace {

constexpr float kSearchMargin = 4e-3f;  // gaps below this may close within a round
constexpr float kWidestCoronary = 2.4e-3f;
constexpr float kStumpLength = 0.045f;  // of a great vessel's course that may lie in the heart
constexpr float kFinestNodes = 0.006f, kCoarsestNodes = 0.020f;  // [m] between the nodes of a displacement
constexpr float kRelaxation = 1.3f, kMemory = 0.975f;            // a displacement that nothing asks for fades
constexpr float kAnchorWeight = 30, kSolidWeight = 40, kPairWeight = 6;  // against the skin's 1
constexpr float kFarthest = 0.010f;                                      // [m] that a course is displaced

struct PointRef {
  std::uint32_t course, point;
};

struct Pair {
  PointRef a, b;  // segments, by their first points
  float need;
  float shareA;  // of the move that parts them
};

/// A point must keep to one side of a plane.
struct Wall {
  PointRef at;
  vec3 onWall, normal;
  float need, weight;
};

/// How a course is displaced: by a uniform cubic B-spline, so that it stays as smooth as it was.
struct Displacement {
  std::vector<vec3> origin;
  std::vector<std::uint32_t> first;  // of the four nodes that move each point
  std::vector<vec4> weights;
  std::vector<vec3> nodes;
  std::vector<vec4> wishes;  // a node: sum of weighted moves, sum of weights

  explicit Displacement(const Course& course) : origin(course.points) {
    float length = 0;
    std::vector<float> arcs(1, 0.0f);
    for (std::size_t i = 1; i < origin.size(); ++i)
      arcs.push_back(length += glm::distance(origin[i], origin[i - 1]));
    const int spans =
        std::max(1, int(std::lround(length / std::clamp(length / 7, kFinestNodes, kCoarsestNodes))));
    for (float arc : arcs) {
      const float u = arc / length * float(spans);
      const std::uint32_t span = std::min(std::uint32_t(u), std::uint32_t(spans - 1));
      const float t = u - float(span), s = 1 - t;
      first.push_back(span);
      weights.push_back(
          vec4(s * s * s, 3 * t * t * t - 6 * t * t + 4, 3 * s * s * s - 6 * s * s + 4, t * t * t) / 6.0f);
    }
    nodes.assign(std::size_t(spans) + 3, vec3(0));
    wishes.assign(nodes.size(), vec4(0));
  }

  void wish(std::size_t point, float weight, vec3 move) {
    for (int j = 0; j < 4; ++j)
      wishes[first[point] + std::uint32_t(j)] += weight * weights[point][j] * vec4(move, 1);
  }

  void follow(std::vector<vec3>& points) {
    for (std::size_t j = 0; j < nodes.size(); ++j) {
      nodes[j] *= kMemory;
      if (wishes[j].w > 0) nodes[j] += kRelaxation / wishes[j].w * vec3(wishes[j]);
      const float size = glm::length(nodes[j]);
      if (size > kFarthest) nodes[j] *= kFarthest / size;
      wishes[j] = vec4(0);
    }
    for (std::size_t k = 0; k < points.size(); ++k) {
      points[k] = origin[k];
      for (int j = 0; j < 4; ++j) points[k] += weights[k][j] * nodes[first[k] + std::uint32_t(j)];
    }
  }
};

class Settler {
 public:
  Settler(std::vector<Course>& courses, const Surroundings& around, const SettleOptions& options)
      : courses_(courses), around_(around), options_(options) {
    for (const Course& course : courses) displacements_.emplace_back(course);
  }

  void run() {
    for (int round = 0; round < options_.rounds; ++round) {
      measureArcs();
      findPairs();
      findWalls();
      for (int step = 0; step < options_.stepsPerRound; ++step) {
        for (const Pair& pair : pairs_) part(pair);
        for (const Wall& wall : walls_) keep(wall);
        for (std::size_t i = 0; i < courses_.size(); ++i) wishForAnchors(i);
        for (std::size_t i = 0; i < courses_.size(); ++i) displacements_[i].follow(courses_[i].points);
      }
    }
    for (std::size_t i = 0; i < courses_.size(); ++i) pin(i);
  }

 private:
  struct Reached {
    int course;
    float at, way;  // arc length on that course, and how far it is to there [m]
  };

  void measureArcs() {
    arcs_.clear();
    for (const Course& course : courses_) {
      std::vector<float>& arc = arcs_.emplace_back(1, 0.0f);
      for (std::size_t i = 1; i < course.points.size(); ++i)
        arc.push_back(arc.back() + glm::distance(course.points[i], course.points[i - 1]));
    }
  }

  float arcAt(int course, float at) const {
    const std::vector<float>& arc = arcs_[std::size_t(course)];
    const std::size_t i = std::min(std::size_t(at), arc.size() - 2);
    return glm::mix(arc[i], arc[i + 1], at - float(i));
  }

  /// The course itself and those it leads to over at most two forks.
  void reach(int course, float at, float way, int forks, std::vector<Reached>& out) const {
    out.push_back({course, at, way});
    if (forks == 0) return;
    const Course& c = courses_[std::size_t(course)];
    const float length = arcs_[std::size_t(course)].back();
    if (c.start.course >= 0)
      reach(c.start.course, arcAt(c.start.course, c.start.at), way + at, forks - 1, out);
    if (c.end.course >= 0)
      reach(c.end.course, arcAt(c.end.course, c.end.at), way + length - at, forks - 1, out);
  }

  /// The way along the vessels between two segments, where it is short.
  float wayBetween(PointRef a, PointRef b) {
    const auto half = [&](PointRef p) {
      return 0.5f * (arcs_[p.course][p.point + 1] - arcs_[p.course][p.point]);
    };
    fromA_.clear();
    fromB_.clear();
    reach(int(a.course), arcs_[a.course][a.point] + half(a), 0, 2, fromA_);
    reach(int(b.course), arcs_[b.course][b.point] + half(b), 0, 2, fromB_);
    float best = 1e9f;  // from middle to middle
    for (const Reached& p : fromA_)
      for (const Reached& q : fromB_)
        if (p.course == q.course) best = std::min(best, p.way + q.way + std::abs(p.at - q.at));
    return std::max(best - half(a) - half(b), 0.0f);
  }

  void findPairs() {
    SegmentGrid grid(0.012f);
    pairs_.clear();
    for (std::uint32_t i = 0; i < courses_.size(); ++i) {
      const Course& c = courses_[i];
      for (std::uint32_t k = 0; k + 1 < c.points.size(); ++k) {
        const float radius = std::max(c.radii[k], c.radii[k + 1]);
        for (std::uint32_t other : grid.near(c.points[k], c.points[k + 1], radius + kSearchMargin)) {
          const SegmentGrid::Segment& s = grid.segments()[other];
          const float need = radius + s.radius + options_.betweenVessels;
          if (closestOnSegments(c.points[k], c.points[k + 1], s.a, s.b).distance > need + kSearchMargin)
            continue;
          const PointRef a{i, k}, b{s.owner, std::uint32_t(s.at)};
          pairs_.push_back({a, b, std::min(need, options_.opening * wayBetween(a, b)), shareOf(a, b)});
        }
      }
      for (std::uint32_t k = 0; k + 1 < c.points.size(); ++k)
        grid.add({c.points[k], c.points[k + 1], std::max(c.radii[k], c.radii[k + 1]), i, float(k)});
    }
  }

  /// The wider vessel moves less. A branch does not move what it hangs on: they would drift along together.
  float shareOf(PointRef a, PointRef b) const {
    const Course &ca = courses_[a.course], &cb = courses_[b.course];
    const auto hangsOn = [](const Course& c, std::uint32_t host) {
      return c.start.course == int(host) || c.end.course == int(host);
    };
    if (hangsOn(ca, b.course)) return 1;
    if (hangsOn(cb, a.course)) return 0;
    const float ra = ca.radii[a.point], rb = cb.radii[b.point];
    return rb * rb / (ra * ra + rb * rb);
  }

  bool isStump(std::uint32_t course, std::uint32_t point) const {
    const Course& c = courses_[course];
    if (c.radii[point] < kWidestCoronary || arcs_[course][point] > kStumpLength) return false;
    if (c.start.course >= 0) return isStump(std::uint32_t(c.start.course), std::uint32_t(c.start.at));
    const auto place = around_.heart.at(c.points.front(), c.radii.front());
    return place.has_value();
  }

  void findWalls() {
    walls_.clear();
    for (std::uint32_t i = 0; i < courses_.size(); ++i) {
      const Course& c = courses_[i];
      for (std::uint32_t k = 0; k < c.points.size(); ++k) {
        const vec3 p = c.points[k];
        const float radius = c.radii[k];
        const auto addSolid = [&](const Solid& solid, float need) {
          if (const auto place = solid.at(p, need + kSearchMargin))
            walls_.push_back(
                {{i, k}, p - place->distance * place->outwards, place->outwards, need, kSolidWeight});
        };
        addSolid(around_.bones, radius + options_.fromBone);
        if (!isStump(i, k)) addSolid(around_.heart, radius + options_.fromHeart);
        const float depth = around_.depth(p), need = radius + c.belowSkin[k];
        if (depth > need + kSearchMargin) continue;
        const vec3 inwards = -glm::normalize(around_.skin.gradient(p));
        walls_.push_back({{i, k}, p - depth * inwards, inwards, need, 1});
      }
    }
  }

  void part(const Pair& pair) {
    const Course &a = courses_[pair.a.course], &b = courses_[pair.b.course];
    const vec3 a0 = a.points[pair.a.point], a1 = a.points[pair.a.point + 1];
    const vec3 b0 = b.points[pair.b.point], b1 = b.points[pair.b.point + 1];
    const SegmentClosest<float> closest = closestOnSegments(a0, a1, b0, b1);
    const float lack = pair.need - closest.distance;
    if (lack <= 0) return;
    vec3 away = glm::mix(a0, a1, closest.s) - glm::mix(b0, b1, closest.t);
    if (closest.distance > 1e-6f)
      away /= closest.distance;
    else
      away = anyPerpendicular(glm::normalize(a1 - a0));
    const auto wish = [](Displacement& d, std::uint32_t point, float t, vec3 move) {
      d.wish(point, kPairWeight * (1 - t), move);
      d.wish(point + 1, kPairWeight * t, move);
    };
    wish(displacements_[pair.a.course], pair.a.point, closest.s, pair.shareA * lack * away);
    wish(displacements_[pair.b.course], pair.b.point, closest.t, (pair.shareA - 1) * lack * away);
  }

  void keep(const Wall& wall) {
    const vec3 p = courses_[wall.at.course].points[wall.at.point];
    const float lack = wall.need - glm::dot(p - wall.onWall, wall.normal);
    if (lack > 0) displacements_[wall.at.course].wish(wall.at.point, wall.weight, lack * wall.normal);
  }

  void wishForAnchors(std::size_t i) {
    const Course& course = courses_[i];
    const auto wish = [&](const Course::Anchor& anchor, std::size_t point) {
      if (anchor.course < 0) return;
      const vec3 there = placeOn(courses_[std::size_t(anchor.course)], anchor.at);
      displacements_[i].wish(point, kAnchorWeight, there - course.points[point]);
    };
    wish(course.start, 0);
    wish(course.end, course.points.size() - 1);
  }

  /// Puts anchored ends onto their hosts; the course beside them goes along, less and less.
  void pin(std::size_t i) {
    Course& course = courses_[i];
    const std::size_t n = course.points.size();
    const auto carry = [&](const Course::Anchor& anchor, bool last) {
      if (anchor.course < 0) return;
      const vec3 move = placeOn(courses_[std::size_t(anchor.course)], anchor.at) -
                        (last ? course.points.back() : course.points.front());
      const std::size_t reach = std::min(std::size_t(10), n / 2);
      for (std::size_t k = 0; k < reach; ++k) {
        const float t = 1 - float(k) / float(reach);
        course.points[last ? n - 1 - k : k] += t * t * (3 - 2 * t) * move;
      }
    };
    carry(course.start, false);
    carry(course.end, true);
  }

  std::vector<Course>& courses_;
  const Surroundings& around_;
  const SettleOptions options_;
  std::vector<std::vector<float>> arcs_;
  std::vector<Pair> pairs_;
  std::vector<Wall> walls_;
  std::vector<Displacement> displacements_;
  std::vector<Reached> fromA_, fromB_;
};

}  // namespace

vec3 placeOn(const Course& course, float at) {
  const std::size_t i = std::min(std::size_t(at), course.points.size() - 2);
  return glm::mix(course.points[i], course.points[i + 1], at - float(i));
}

void settle(std::vector<Course>& courses, const Surroundings& around, const SettleOptions& options) {
  Settler(courses, around, options).run();
}

}  // namespace vasa::human
