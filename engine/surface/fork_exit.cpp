#include "surface/fork_exit.h"

#include <algorithm>
#include <cmath>

namespace vasa {
namespace {

constexpr int kRingProbes = 8;

struct Walker {
  const VesselLine& branch;
  bool last;
  float way(float from) const { return last ? branch.length() - from : from; }
  vec4 point(float from) const { return branch.point(way(from)); }
  vec3 outward(float from) const { return (last ? -1.0f : 1.0f) * branch.tangent(way(from)); }
};

// How deep the branch's ring reaches into the host [m]; negative: how far it stands off.
float ringDepth(const Walker& walker, float from, const VesselLine& host, float foot) {
  const vec4 point = walker.point(from);
  const vec3 outward = walker.outward(from), u = anyPerpendicular(outward), v = glm::cross(outward, u);
  float depth = -1e30f;
  for (int i = 0; i < kRingProbes; ++i) {
    const float angle = 2 * kPi * float(i) / kRingProbes;
    const vec3 probe = vec3(point) + point.w * (std::cos(angle) * u + std::sin(angle) * v);
    const VesselLine::Foot near = host.nearest(probe, foot, 4 * point.w + 1e-3f);
    depth = std::max(depth, near.radius - near.distance);
  }
  return depth;
}

}  // namespace

ForkExit findForkExit(const VesselLine& branch, bool last, const VesselLine& host, float hostWay,
                      float clearance, float longest) {
  const Walker walker{branch, last};
  ForkExit exit;
  const float end = 0.98f * branch.length();
  float foot = hostWay, best = 1e30f, limit = end;
  bool outside = false;
  std::vector<std::pair<float, float>> steps;  // ways along the branch and the host
  for (float from = 0; from < limit;) {
    const vec4 point = walker.point(from);
    const float step = std::max(0.15f * point.w, branch.length() / 4096);
    const VesselLine::Foot near = host.nearest(vec3(point), foot, 6 * step + 0.5f * host.point(foot).w);
    foot = near.way;
    steps.push_back({from, foot});
    if (near.distance < near.radius) {
      exit.cross = from;
      exit.foot = foot;
      outside = exit.found = exit.clear = false;
      best = 1e30f;
      limit = end;  // one that dips in again is followed on
    } else {
      if (!outside) limit = std::min(limit, exit.cross + 4 * point.w + 3 * near.radius);
      outside = true;
      const float depth = ringDepth(walker, from, host, foot);
      if (from > exit.cross + 0.25f * point.w && depth < best) {
        best = depth;
        exit.ring = from;
        exit.ringFoot = foot;
        exit.found = true;
        exit.clear = depth <= -clearance * point.w;
        if (exit.clear) break;
      }
    }
    from += step;
  }
  if (!exit.found || !outside) return {};
  exit.radius = walker.point(exit.ring).w;
  // A branch that creeps along the wall leaves it where it ends to: the hole stays near the ring.
  for (const auto& [from, beside] : steps)
    if (from > exit.cross && from <= exit.ring - longest * exit.radius) exit.cross = from, exit.foot = beside;
  const vec3 course = vec3(walker.point(exit.ring) - walker.point(exit.cross));
  exit.lean = glm::dot(course, host.tangent(exit.foot)) / std::max(glm::length(course), 1e-12f);
  return exit;
}

}  // namespace vasa
