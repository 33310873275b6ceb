#include "edit/graft_course.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "curve/fit.h"
#include "curve/frame.h"
#include "math/aabb.h"
#include "math/closest_point.h"
#include "math/segment_distance.h"
#include "network/kinks.h"

namespace vasa {
namespace {

constexpr int kPieces = 4;                      // straight ones of an obstacle's span
constexpr int kCourseRounds = 600, kLook = 20;  // all rounds; those between looks for who is near
constexpr float kReach = 0.02f;                 // [m] farther than the band moves between looks
// Times both radii: how far along the band it may still be inside its host's reach.
constexpr float kClear = 1.2f;
constexpr int kDirections = 16;  // tried around a host
// Of the straight way, by which first ways are bent aside in turn.
constexpr float kDetours[] = {0.15f, 0.3f, 0.6f};
constexpr int kDetourSides = 8;

struct Obstacle {
  vec3 a, b;
  float radiusA, radiusB;
  std::uint32_t vessel;
};

std::vector<Obstacle> obstaclesOf(const Draft& draft) {
  std::vector<Obstacle> all;
  for (std::uint32_t v = 0; v < draft.lines.size(); ++v) {
    const Draft::Line& line = draft.lines[v];
    if (line.gone) continue;
    const std::uint32_t pieces = spanCount(line.points) * kPieces;
    vec4 before = line.points.front();
    for (std::uint32_t k = 1; k <= pieces; ++k) {
      const vec4 next = evaluate(line.points, float(k) / kPieces);
      all.push_back({vec3(before), vec3(next), before.w, next.w, v});
      before = next;
    }
  }
  return all;
}

class Band {
 public:
  // @param bulge  [m] by which the first way's middle is off the straight line
  Band(const Draft& draft, const GraftTask& task, const std::vector<Obstacle>& obstacles, vec3 bulge)
      : draft_(draft), task_(task), obstacles_(obstacles) {
    hosts_[0] = hostAt(task.from), hosts_[1] = hostAt(task.to);
    step_ = std::max(task.radius, 0.002f);
    const vec3 first = task.via.empty() ? hosts_[1].centre : task.via.front(),
               last = task.via.empty() ? hosts_[0].centre : task.via.back();
    const vec3 tips[2] = {tipOf(hosts_[0], first), tipOf(hosts_[1], last)};
    add(hosts_[0].centre, true);
    lineTo(tips[0], false);
    for (const vec3& place : task.via) lineTo(place, true);
    lineTo(tips[1], false, bulge);
    lineTo(hosts_[1].centre, true);
  }

  void relax() {
    for (int round = 0; round < kCourseRounds; ++round) {
      if (round % kLook == 0) spread(), look();
      // First taut, to find its way; then stiff, which rounds its corners over some three diameters.
      if (round < kCourseRounds / 2)
        tighten(0.3f, 0);
      else
        tighten(0.01f, 0.1f);
      push();
    }
  }

  GraftCourse course() const {
    GraftCourse result;
    std::vector<vec4> samples;
    for (const Node& node : nodes_) samples.emplace_back(node.at, task_.radius);
    // Between its places a band is straight: a few more hold the spline there.
    result.points = fitSpline(samples, {{0.1f, 5e-5f, 4e-4f}, {0.01f, 1e-6f, 1e-4f}, 4096});
    for (vec4& p : result.points) p.w = task_.radius;
    return result;
  }

  // An end lies so deep in a vessel beside its host that no course gets clear of it. Of the other end's host
  // only where a course is sure to have left its reach, of which it takes an eighth for a step.
  bool endsInside() const {
    const float apart = glm::distance(hosts_[0].centre, hosts_[1].centre);
    for (int end = 0; end < 2; ++end) {
      const HostPlace &host = hosts_[end], &other = hosts_[1 - end];
      const bool left = 0.875f * apart - step_ > clearOf(other);
      for (const Obstacle& obstacle : obstacles_) {
        if (obstacle.vessel == host.vessel || (obstacle.vessel == other.vessel && !left)) continue;
        const float t = closestOnSegment(host.centre, obstacle.a, obstacle.b);
        const float lumen = std::lerp(obstacle.radiusA, obstacle.radiusB, t);
        if (glm::distance(host.centre, glm::mix(obstacle.a, obstacle.b, t)) < task_.radius + lumen)
          return true;
      }
    }
    return false;
  }

  std::vector<VesselId> inTheWay(std::span<const vec4> points) const {
    std::vector<VesselId> found;
    const std::uint32_t pieces = spanCount(points) * kPieces * 2;
    float along = 0;
    std::vector<std::pair<vec3, float>> places{{vec3(points.front()), 0.0f}};
    for (std::uint32_t k = 1; k <= pieces; ++k) {
      const vec3 at(evaluate(points, float(k) / (kPieces * 2)));
      along += glm::distance(at, places.back().first);
      places.emplace_back(at, along);
    }
    Aabb box;
    for (const auto& [at, way] : places) box.add(at, task_.radius);
    for (const Obstacle& obstacle : obstacles_) {
      if (apart(box, obstacle)) continue;
      for (std::size_t i = 0; i + 1 < places.size(); ++i) {
        if (std::ranges::find(found, VesselId{obstacle.vessel}) != found.end()) continue;
        if (ownHost(obstacle, places[i].second - step_, along - places[i + 1].second - step_)) continue;
        const SegmentPair near =
            closestSegments(places[i].first, places[i + 1].first, obstacle.a, obstacle.b);
        if (near.distance < task_.radius + std::lerp(obstacle.radiusA, obstacle.radiusB, near.t))
          found.push_back({obstacle.vessel});
      }
    }
    return found;
  }

 private:
  struct Node {
    vec3 at;
    bool fixed;
  };
  struct HostPlace {
    vec3 centre, tangent;
    float radius;
    std::uint32_t vessel;
  };
  struct SegmentPair {
    float s, t, distance;
    vec3 normal;  // from the obstacle to the band
  };

  static bool apart(const Aabb& box, const Obstacle& obstacle) {
    const vec3 low = glm::min(obstacle.a - obstacle.radiusA, obstacle.b - obstacle.radiusB);
    const vec3 high = glm::max(obstacle.a + obstacle.radiusA, obstacle.b + obstacle.radiusB);
    return glm::any(glm::lessThan(high, box.low)) || glm::any(glm::greaterThan(low, box.high));
  }
  HostPlace hostAt(Draft::Place place) const {
    const auto& points = draft_.line(place.vessel).points;
    const vec4 at = evaluate(points, place.parameter);
    return {vec3(at), unitTangent(points, place.parameter), at.w, place.vessel.value};
  }
  static SegmentPair closestSegments(vec3 a, vec3 b, vec3 c, vec3 d) {
    const auto near = closestOnSegments(a, b, c, d);
    const vec3 p = glm::mix(a, b, near.s), q = glm::mix(c, d, near.t), off = p - q;
    const float distance = glm::length(off);
    vec3 normal = distance > 1e-6f ? off / distance : glm::cross(b - a, d - c);
    if (!(distance > 1e-6f)) normal = glm::length(normal) > 0 ? glm::normalize(normal) : vec3(0, 0, 1);
    return {near.s, near.t, distance, normal};
  }
  // A segment, however it turns about its first end, lies clear of an obstacle: most do, and this is quickly
  // told.
  bool beyond(const Obstacle& obstacle, vec3 from, vec3 to) const {
    const vec3 off = from - 0.5f * (obstacle.a + obstacle.b);
    // The hundredth is for rounding.
    const float reach =
        1.01f * (0.5f * glm::distance(obstacle.a, obstacle.b) + std::max(obstacle.radiusA, obstacle.radiusB) +
                 task_.radius + kGraftGap + glm::distance(from, to));
    return glm::dot(off, off) > reach * reach;
  }
  float clearOf(const HostPlace& host) const { return kClear * (host.radius + task_.radius + kGraftGap); }
  bool ownHost(const Obstacle& obstacle, float fromStart, float fromEnd) const {
    return (obstacle.vessel == hosts_[0].vessel && fromStart < clearOf(hosts_[0])) ||
           (obstacle.vessel == hosts_[1].vessel && fromEnd < clearOf(hosts_[1]));
  }

  // Where the band stands clear of its host, on the side with most room; among equal ones towards the other
  // end.
  vec3 tipOf(const HostPlace& host, vec3 towards) const {
    const vec3 way = towards - host.centre;
    const vec3 ahead = glm::dot(way, host.tangent) < 0 ? -host.tangent : host.tangent;
    const vec3 across = way - glm::dot(way, host.tangent) * host.tangent;
    const vec3 wanted = glm::length(across) > 1e-6f ? glm::normalize(across) : anyPerpendicular(host.tangent);
    const vec3 other = glm::cross(host.tangent, wanted);
    vec3 best = host.centre;
    float bestScore = -1e9f;
    for (int k = 0; k < kDirections; ++k) {
      const float angle = 2 * kPi * float(k) / kDirections;
      const vec3 out = std::cos(angle) * wanted + std::sin(angle) * other;
      const vec3 tip = host.centre + clearOf(host) * (0.87f * out + 0.5f * ahead);
      float room = 2 * task_.radius;
      for (const Obstacle& obstacle : obstacles_) {
        if (obstacle.vessel == host.vessel) continue;
        const SegmentPair near = closestSegments(host.centre, tip, obstacle.a, obstacle.b);
        room = std::min(room,
                        near.distance - task_.radius - std::lerp(obstacle.radiusA, obstacle.radiusB, near.t));
      }
      const float score = room + 0.5f * task_.radius * std::cos(angle);
      if (score > bestScore + 1e-7f) bestScore = score, best = tip;
    }
    return best;
  }

  void add(vec3 at, bool fixed) { nodes_.push_back({at, fixed}); }
  void lineTo(vec3 to, bool fixed, vec3 bulge = vec3(0)) {
    const vec3 from = nodes_.back().at;
    const int parts = std::max(1, int(std::ceil(glm::distance(from, to) / step_)));
    for (int k = 1; k <= parts; ++k) {
      const float share = float(k) / float(parts);
      add(glm::mix(from, to, share) + (k < parts ? std::sin(kPi * share) : 0.0f) * bulge,
          fixed && k == parts);
    }
  }

  // Equal distances between fixed places.
  void spread() {
    std::vector<Node> old = std::move(nodes_);
    nodes_.clear();
    add(old.front().at, true);
    for (std::size_t begin = 0; begin + 1 < old.size();) {
      std::size_t end = begin + 1;
      std::vector<float> along{0, glm::distance(old[begin].at, old[end].at)};
      for (; !old[end].fixed; ++end)
        along.push_back(along.back() + glm::distance(old[end].at, old[end + 1].at));
      const int parts = std::max(2, int(std::ceil(along.back() / step_)));
      std::size_t i = 0;
      for (int k = 1; k < parts; ++k) {
        const float want = along.back() * float(k) / float(parts);
        while (i + 2 < along.size() && along[i + 1] < want) ++i;
        const float share = along[i + 1] > along[i] ? (want - along[i]) / (along[i + 1] - along[i]) : 0;
        add(glm::mix(old[begin + i].at, old[begin + i + 1].at, share), false);
      }
      add(old[end].at, true);
      begin = end;
    }
  }

  void look() {
    near_.clear();
    Aabb box;
    for (const Node& node : nodes_) box.add(node.at, task_.radius + kReach);
    for (const Obstacle& obstacle : obstacles_) {
      if (apart(box, obstacle)) continue;
      const float reach = task_.radius + std::max(obstacle.radiusA, obstacle.radiusB) + kReach;
      for (std::size_t i = 0; i + 1 < nodes_.size(); ++i)
        if (closestSegments(nodes_[i].at, nodes_[i + 1].at, obstacle.a, obstacle.b).distance < reach) {
          near_.push_back(&obstacle);
          break;
        }
    }
  }

  // Explicit steps of a string's and of a rod's energy; stable below 0.5 and 0.125.
  void tighten(float tension, float stiffness) {
    std::vector<vec3> bends(nodes_.size(), vec3(0));
    for (std::size_t i = 1; i + 1 < nodes_.size(); ++i)
      bends[i] = nodes_[i - 1].at + nodes_[i + 1].at - 2.0f * nodes_[i].at;
    for (std::size_t i = 1; i + 1 < nodes_.size(); ++i)
      if (!nodes_[i].fixed)
        nodes_[i].at +=
            0.5f * tension * bends[i] - stiffness * (bends[i - 1] + bends[i + 1] - 2.0f * bends[i]);
  }

  void push() {
    std::vector<float> along{0};
    for (std::size_t i = 0; i + 1 < nodes_.size(); ++i)
      along.push_back(along.back() + glm::distance(nodes_[i].at, nodes_[i + 1].at));
    for (std::size_t i = 0; i + 1 < nodes_.size(); ++i)
      for (const Obstacle* obstacle : near_) {
        if (beyond(*obstacle, nodes_[i].at, nodes_[i + 1].at)) continue;
        if (ownHost(*obstacle, along[i], along.back() - along[i + 1])) continue;
        const SegmentPair near = closestSegments(nodes_[i].at, nodes_[i + 1].at, obstacle->a, obstacle->b);
        const float lack = task_.radius + std::lerp(obstacle->radiusA, obstacle->radiusB, near.t) +
                           kGraftGap - near.distance;
        if (!(lack > 0)) continue;
        const float before = nodes_[i].fixed ? 0 : 1 - near.s, after = nodes_[i + 1].fixed ? 0 : near.s;
        const float weight = before * before + after * after;
        if (!(weight > 0.01f)) continue;
        nodes_[i].at += before / weight * 0.6f * lack * near.normal;
        nodes_[i + 1].at += after / weight * 0.6f * lack * near.normal;
      }
  }

  const Draft& draft_;
  const GraftTask& task_;
  const std::vector<Obstacle>& obstacles_;
  std::vector<const Obstacle*> near_;
  std::vector<Node> nodes_;
  HostPlace hosts_[2];
  float step_ = 0;
};

}  // namespace

GraftCourse leadGraft(const Draft& draft, const GraftTask& task) {
  const std::vector<Obstacle> obstacles = obstaclesOf(draft);
  const auto attempt = [&](vec3 bulge) {
    Band band(draft, task, obstacles, bulge);
    band.relax();
    GraftCourse course = band.course();
    course.inTheWay = band.inTheWay(course.points);
    return course;
  };
  const auto good = [](const GraftCourse& course) {
    if (!course.inTheWay.empty()) return false;
    for (std::uint32_t span = 0; span < spanCount(course.points); ++span)
      if (kinks(bezierOfSpan(course.points, span))) return false;
    return true;
  };
  GraftCourse straight = attempt(vec3(0));
  if (good(straight) || !task.via.empty()) return straight;
  if (Band(draft, task, obstacles, vec3(0)).endsInside()) return straight;  // as every other would be stuck
  const vec3 from(evaluate(draft.line(task.from.vessel).points, task.from.parameter)),
      to(evaluate(draft.line(task.to.vessel).points, task.to.parameter));
  const float length = glm::distance(from, to);
  const vec3 side = anyPerpendicular(length > 0 ? (to - from) / length : vec3(0, 1, 0)),
             other = length > 0 ? glm::cross((to - from) / length, side) : vec3(0, 0, 1);
  for (const float share : kDetours) {
    std::optional<GraftCourse> best;
    for (int k = 0; k < kDetourSides; ++k) {
      const float angle = 2 * kPi * float(k) / kDetourSides;
      GraftCourse course = attempt(share * length * (std::cos(angle) * side + std::sin(angle) * other));
      if (good(course) && (!best || lengthOf(course.points) < lengthOf(best->points)))
        best = std::move(course);
    }
    if (best) return std::move(*best);
  }
  return straight;
}

}  // namespace vasa
