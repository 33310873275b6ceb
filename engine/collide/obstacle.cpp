#include "collide/obstacle.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <map>

#include "collide/box_tree.h"
#include "collide/spatial_order.h"
#include "core/cancellation.h"
#include "core/ids.h"
#include "core/parallel.h"
#include "curve/bounds.h"
#include "math/closest_point.h"
#include "math/segment_triangle.h"

namespace vasa {
namespace {

constexpr int kMostTubePieces = 32;  // of one tube
constexpr std::uint32_t kTubesPerTask = 64;

vec3 unitOrZero(vec3 v) {
  const float length = glm::length(v);
  return length > 0 ? v / length : vec3(0);
}

float cornerAngle(vec3 at, vec3 b, vec3 c) {
  const vec3 u = unitOrZero(b - at), v = unitOrZero(c - at);
  return std::acos(glm::clamp(glm::dot(u, v), -1.0f, 1.0f));
}

// Eight boxes, one a lane; a lane without a box is empty.
struct TriangleBoxes {
  float low[3][kGroup];
  float high[3][kGroup];

  void set(std::uint32_t lane, const Aabb& box) {
    for (int axis = 0; axis < 3; ++axis) low[axis][lane] = box.low[axis], high[axis][lane] = box.high[axis];
  }
  Aabb whole() const {
    Aabb box;
    for (int axis = 0; axis < 3; ++axis) {
      box.low[axis] = *std::min_element(low[axis], low[axis] + kGroup);
      box.high[axis] = *std::max_element(high[axis], high[axis] + kGroup);
    }
    return box;
  }
};

// A point's nearest surface point among some triangles, with the sign.
struct Signed {
  float distance = std::numeric_limits<float>::infinity();  // negative inside
  std::uint32_t triangle = kNone;
  vec3 point{0}, normal{0, 0, 1};
};

}  // namespace

struct Obstacle::State {
  std::vector<uvec3> triangles;
  std::vector<std::array<std::uint32_t, 3>> across;  // neighbour over edge k (corners k, k + 1), or none
  std::vector<std::uint32_t> order;                  // slot -> triangle
  std::vector<std::uint32_t> levelStart{0};
  std::vector<TriangleBoxes> boxes;
  std::vector<vec3> positions, faceNormals, cornerNormals;
  std::vector<std::vector<ObstacleContact>> found;  // a task each
  std::vector<ObstacleContact> contacts;

  void joinEdges();
  void layOutTree(std::span<const vec3> rest);
  void fitBoxes();
  void fitNormals();
  void trianglesNear(const Aabb& box, std::vector<std::uint32_t>& near) const;
  Signed signedDistance(vec4 ball, std::span<const std::uint32_t> near) const;
  vec3 normalAt(std::uint32_t triangle, vec3 barycentric) const;
  void contactsOf(std::uint32_t tube, const Bezier& shape, float margin, float depth,
                  std::vector<std::uint32_t>& near, std::vector<ObstacleContact>& out) const;
};

void Obstacle::State::joinEdges() {
  across.assign(triangles.size(), {kNone, kNone, kNone});
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::pair<std::uint32_t, int>> open;
  Checkpoints checkpoints;
  for (std::uint32_t i = 0; i < triangles.size(); ++i)
    for (int k = 0; k < 3; ++k) {
      checkpoints.pass();
      const std::uint32_t a = triangles[i][k], b = triangles[i][(k + 1) % 3];
      const auto [at, fresh] = open.try_emplace(std::minmax(a, b), i, k);
      if (fresh) continue;
      across[i][std::size_t(k)] = at->second.first;
      across[at->second.first][std::size_t(at->second.second)] = i;
    }
}

void Obstacle::State::layOutTree(std::span<const vec3> rest) {
  std::vector<vec3> centres;
  for (const uvec3& t : triangles) centres.push_back((rest[t.x] + rest[t.y] + rest[t.z]) / 3.0f);
  order = spatialOrder(centres);
  for (std::uint32_t groups = (std::uint32_t(order.size()) + kGroup - 1) / kGroup; groups > 0;
       groups = groups > 1 ? (groups + kGroup - 1) / kGroup : 0)
    levelStart.push_back(levelStart.back() + groups);
  boxes.resize(levelStart.back());
}

void Obstacle::State::fitBoxes() {
  const std::uint32_t leaves = levelStart[1];
  parallelFor(leaves, 256, [this](std::size_t group) {
    for (std::uint32_t lane = 0; lane < kGroup; ++lane) {
      const std::size_t slot = group * kGroup + lane;
      Aabb box;  // empty lanes stay empty
      if (slot < order.size())
        for (int k = 0; k < 3; ++k) box.add(positions[triangles[order[slot]][k]]);
      boxes[group].set(lane, box);
    }
  });
  for (std::size_t level = 1; level + 1 < levelStart.size(); ++level)
    for (std::uint32_t group = levelStart[level]; group < levelStart[level + 1]; ++group)
      for (std::uint32_t lane = 0; lane < kGroup; ++lane) {
        const std::uint32_t child = levelStart[level - 1] + (group - levelStart[level]) * kGroup + lane;
        boxes[group].set(lane, child < levelStart[level] ? boxes[child].whole() : Aabb());
      }
}

void Obstacle::State::fitNormals() {
  faceNormals.resize(triangles.size());
  cornerNormals.assign(positions.size(), vec3(0));
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const uvec3& t = triangles[i];
    const vec3 &a = positions[t.x], &b = positions[t.y], &c = positions[t.z];
    const vec3 normal = faceNormals[i] = unitOrZero(glm::cross(b - a, c - a));
    cornerNormals[t.x] += cornerAngle(a, b, c) * normal;
    cornerNormals[t.y] += cornerAngle(b, c, a) * normal;
    cornerNormals[t.z] += cornerAngle(c, a, b) * normal;
  }
}

void Obstacle::State::trianglesNear(const Aabb& box, std::vector<std::uint32_t>& near) const {
  near.clear();
  struct TreeNode {
    std::uint32_t level, group;
  };
  std::array<TreeNode, 128> stack;  // eight a level at most, less the one taken
  std::size_t size = 0;
  stack[size++] = {std::uint32_t(levelStart.size()) - 2, 0};
  while (size > 0) {
    const auto [level, group] = stack[--size];
    const TriangleBoxes& lanes = boxes[levelStart[level] + group];
    for (std::uint32_t lane = 0; lane < kGroup; ++lane) {
      bool meets = true;
      for (int axis = 0; axis < 3; ++axis)
        meets &= lanes.low[axis][lane] <= box.high[axis] && box.low[axis] <= lanes.high[axis][lane];
      if (!meets) continue;
      if (level == 0) {
        near.push_back(order[group * kGroup + lane]);
      } else {
        stack[size++] = {level - 1, group * kGroup + lane};
      }
    }
  }
}

vec3 Obstacle::State::normalAt(std::uint32_t triangle, vec3 barycentric) const {
  constexpr float kAtEdge = 1e-6f;
  for (int k = 0; k < 3; ++k)
    if (barycentric[k] > 1 - kAtEdge) return unitOrZero(cornerNormals[triangles[triangle][k]]);
  for (int k = 0; k < 3; ++k)
    if (barycentric[(k + 2) % 3] < kAtEdge) {
      const std::uint32_t other = across[triangle][std::size_t(k)];
      return other == kNone ? faceNormals[triangle] : unitOrZero(faceNormals[triangle] + faceNormals[other]);
    }
  return faceNormals[triangle];
}

Signed Obstacle::State::signedDistance(vec4 ball, std::span<const std::uint32_t> near) const {
  constexpr float kOnSurface = 1e-3f;  // of a radius: closer, the direction from the surface is noise
  const vec3 p(ball);
  Signed best;
  vec3 weights(0);
  for (const std::uint32_t triangle : near) {
    const uvec3& t = triangles[triangle];
    const TrianglePoint q = closestOnTriangle(p, positions[t.x], positions[t.y], positions[t.z]);
    const float distance = glm::distance(p, q.point);
    if (distance < best.distance) best = {distance, triangle, q.point, {}}, weights = q.barycentric;
  }
  if (best.triangle == kNone) return best;
  const vec3 out = normalAt(best.triangle, weights), from = p - best.point;
  const bool inside = glm::dot(from, out) < 0;
  best.normal = best.distance > kOnSurface * ball.w ? (inside ? -from : from) / best.distance : out;
  if (inside) best.distance = -best.distance;
  return best;
}

void Obstacle::State::contactsOf(std::uint32_t tube, const Bezier& shape, float margin, float depth,
                                 std::vector<std::uint32_t>& near, std::vector<ObstacleContact>& out) const {
  const float largest = radiusBound(shape);
  Aabb box = shape.bounds();
  box.low -= vec3(margin + depth);
  box.high += vec3(margin + depth);
  trianglesNear(box, near);
  if (near.empty()) return;
  float length = 0;
  for (std::size_t k = 0; k < 3; ++k) length += glm::distance(vec3(shape.b[k]), vec3(shape.b[k + 1]));
  const int pieces =
      largest > 0 ? std::clamp(int(std::ceil(length / largest)), 1, kMostTubePieces) : kMostTubePieces;
  Signed end = signedDistance(shape.b[0], near);
  for (int piece = 0; piece < pieces; ++piece) {
    const float from = float(piece) / float(pieces), to = float(piece + 1) / float(pieces);
    const vec3 p(shape.at(from)), q(shape.at(to));
    SegmentTrianglePoint nearest;
    nearest.distance = std::numeric_limits<float>::infinity();
    for (const std::uint32_t triangle : near) {
      const uvec3& t = triangles[triangle];
      const auto at = closestOnSegmentTriangle(p, q, positions[t.x], positions[t.y], positions[t.z]);
      if (at.distance < nearest.distance) nearest = at;
    }
    const Signed start = end;
    end = signedDistance(shape.at(to), near);
    const float between = glm::mix(from, to, nearest.s);
    const std::pair<float, Signed> samples[] = {
        {from, start}, {between, signedDistance(shape.at(between), near)}, {to, end}};
    ObstacleContact deepest;
    deepest.f = std::numeric_limits<float>::infinity();
    for (const auto& [s, place] : samples) {
      const float f = place.distance - shape.at(s).w;
      if (f < deepest.f) deepest = {tube, place.triangle, s, place.point, f, place.normal};
    }
    if (deepest.f < margin) out.push_back(deepest);
  }
}

Obstacle::Obstacle(std::span<const vec3> rest, std::span<const uvec3> triangles)
    : state_(std::make_unique<State>()) {
  state_->triangles.assign(triangles.begin(), triangles.end());
  state_->joinEdges();
  state_->layOutTree(rest);
  update(rest);
}
Obstacle::~Obstacle() = default;
Obstacle::Obstacle(Obstacle&&) noexcept = default;

std::uint32_t Obstacle::triangleCount() const { return std::uint32_t(state_->triangles.size()); }

void Obstacle::distances(std::span<const vec3> points, float reach, std::vector<std::uint32_t>& near,
                         std::span<float> distances) const {
  Aabb box;
  for (const vec3& p : points) box.add(p, reach);
  state_->trianglesNear(box, near);
  // Balls around the triangles, as arrays of plain numbers: most of them are told too far in vector
  // registers.
  const std::size_t count = near.size();
  std::vector<float> x(count), y(count), z(count), radius(count), squared(count);
  for (std::size_t k = 0; k < count; ++k) {
    const uvec3& t = state_->triangles[near[k]];
    const vec3 &a = state_->positions[t.x], &b = state_->positions[t.y], &c = state_->positions[t.z];
    const vec3 centre = (a + b + c) / 3.0f;
    x[k] = centre.x, y[k] = centre.y, z[k] = centre.z;
    radius[k] = std::max({glm::distance(a, centre), glm::distance(b, centre), glm::distance(c, centre)});
  }
  std::vector<std::uint32_t> nearest;
  for (std::size_t p = 0; p < points.size(); ++p) {
    const vec3 point = points[p];
    float least = std::numeric_limits<float>::max();
    for (std::size_t k = 0; k < count; ++k) {
      const float dx = x[k] - point.x, dy = y[k] - point.y, dz = z[k] - point.z;
      squared[k] = dx * dx + dy * dy + dz * dz;
      least = squared[k] < least ? squared[k] : least;
    }
    const float most = std::sqrt(least) * 1.0001f;  // the nearest triangle is no further than this
    nearest.clear();
    for (std::size_t k = 0; k < count; ++k)
      if (squared[k] <= (most + radius[k]) * (most + radius[k])) nearest.push_back(near[k]);
    distances[p] = std::min(std::abs(state_->signedDistance(vec4(point, 0), nearest).distance), reach);
  }
}

void Obstacle::update(std::span<const vec3> positions) {
  state_->positions.assign(positions.begin(), positions.end());
  if (state_->triangles.empty()) return;
  state_->fitBoxes();
  state_->fitNormals();
}

std::span<const ObstacleContact> Obstacle::contacts(std::span<const Bezier> tubes, float margin,
                                                    float depth) {
  State& state = *state_;
  state.contacts.clear();
  if (state.triangles.empty()) return {};
  const std::size_t tasks = (tubes.size() + kTubesPerTask - 1) / kTubesPerTask;
  state.found.resize(std::max(state.found.size(), tasks));
  parallelFor(tasks, 1, [&](std::size_t task) {
    state.found[task].clear();
    std::vector<std::uint32_t> near;
    const std::size_t end = std::min(tubes.size(), (task + 1) * kTubesPerTask);
    for (std::size_t i = task * kTubesPerTask; i < end; ++i)
      state.contactsOf(std::uint32_t(i), tubes[i], margin, depth, near, state.found[task]);
  });
  for (std::size_t task = 0; task < tasks; ++task)
    state.contacts.insert(state.contacts.end(), state.found[task].begin(), state.found[task].end());
  return state.contacts;
}

}  // namespace vasa
