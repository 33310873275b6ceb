#include "make_human/skin.h"

#include <algorithm>
#include <cmath>

#include "make_human/polygonise.h"
#include "math/closest_point.h"

namespace vasa::human {
namespace {

constexpr float kCoarseCell = 0.030f;
constexpr int kSmoothingRounds = 6;
constexpr float kLeastWeight = 0.02f;

using Weights = std::vector<float>;  // one a joint

/// How far along the path p lies, and how far along each joint is.
struct PathPosition {
  float along = 0;
  std::vector<float> joints;
};

PathPosition alongPath(const std::vector<int>& path, const Rig& rig, vec3 p) {
  PathPosition result;
  float nearest = 1e9f, length = 0;
  for (std::size_t i = 0; i < path.size(); ++i) {
    const vec3 a = rig.points[std::size_t(path[i])].position;
    const bool last = i + 1 == path.size();
    const int next = last ? rig.points[std::size_t(path[i])].towards : path[i + 1];
    const vec3 b = rig.points[std::size_t(next)].position;
    const float t = closestOnSegment(p, a, b), distance = glm::distance(p, glm::mix(a, b, t));
    if (distance < nearest) nearest = distance, result.along = length + t * glm::distance(a, b);
    if (i == 0 && t == 0) result.along = std::min(result.along, glm::dot(p - a, glm::normalize(b - a)));
    result.joints.push_back(length);
    length += glm::distance(a, b);
  }
  return result;
}

void addPathWeights(const Part& part, const Rig& rig, vec3 p, float share, Weights& weights) {
  const PathPosition position = alongPath(part.path, rig, p);
  float left = share;
  for (std::size_t i = part.path.size(); i-- > 0;) {
    const RigPoint& joint = rig.points[std::size_t(part.path[i])];
    float passed = 1;
    if (i > 0) {
      const float t =
          std::clamp(0.5f + 0.5f * (position.along - position.joints[i]) / joint.skinBlend, 0.0f, 1.0f);
      passed = t * t * (3 - 2 * t);
    }
    weights[std::size_t(joint.joint)] += passed * left;
    left *= 1 - passed;
  }
}

Weights weightsAt(const Shape& shape, const Rig& rig, vec3 p) {
  std::vector<float> distances;
  float nearest = 1;
  for (const Part& part : shape.parts) {
    distances.push_back(part.carve ? 1.0f : part.distance(p));
    nearest = std::min(nearest, distances.back());
  }
  Weights weights(rig.joints.size(), 0);
  float total = 0;
  for (std::size_t i = 0; i < distances.size(); ++i) {
    const float range = std::max(0.35f * shape.parts[i].blend, 1e-3f);
    const float share = std::exp(-(distances[i] - nearest) / range);
    if (shape.parts[i].carve || share < 1e-3f) continue;
    addPathWeights(shape.parts[i], rig, p, share, weights);
    total += share;
  }
  for (float& weight : weights) weight /= total;
  return weights;
}

void smooth(std::vector<Weights>& weights, const TriangleMesh& mesh) {
  std::vector<Weights> next(weights.size(), Weights(weights[0].size(), 0));
  std::vector<float> counts(weights.size(), 0);
  for (const uvec3& t : mesh.triangles)
    for (int i = 0; i < 3; ++i) {
      const Weights& neighbour = weights[t[(i + 1) % 3]];
      Weights& sum = next[t[i]];
      for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += neighbour[k];
      ++counts[t[i]];
    }
  for (std::size_t i = 0; i < weights.size(); ++i)
    for (std::size_t k = 0; k < weights[i].size(); ++k)
      weights[i][k] = 0.5f * weights[i][k] + 0.5f * next[i][k] / counts[i];
}

SkinInfluence strongest(const Weights& weights) {
  std::vector<std::uint16_t> order(weights.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = std::uint16_t(i);
  std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return weights[a] > weights[b]; });
  SkinInfluence influence;
  float total = 0;
  for (int i = 0; i < 4; ++i)
    if (weights[order[std::size_t(i)]] >= kLeastWeight) total += weights[order[std::size_t(i)]];
  for (int i = 0; i < 4; ++i) {
    const float weight = weights[order[std::size_t(i)]];
    if (weight < kLeastWeight) break;
    influence.joints[std::size_t(i)] = order[std::size_t(i)];
    influence.weights[i] = weight / total;
  }
  influence.weights.x = 1 - influence.weights.y - influence.weights.z - influence.weights.w;
  return influence;
}

}  // namespace

SkinnedMesh makeSkin(const Shape& shape, const Rig& rig) {
  SkinnedMesh skin;
  skin.name = "skin";
  skin.colour = {0.85f, 0.62f, 0.52f, 0.32f};
  skin.mesh = polygonise({[&](vec3 p) { return shape.distance(p); },
                          [&](vec3 p, float reach) { return shape.cellSize(p, reach); }, shape.bounds()},
                         kCoarseCell);
  std::vector<Weights> weights;
  for (vec3 p : skin.mesh.positions) {
    skin.normals.push_back(glm::normalize(shape.gradient(p)));
    weights.push_back(weightsAt(shape, rig, p));
  }
  for (int round = 0; round < kSmoothingRounds; ++round) smooth(weights, skin.mesh);
  for (const Weights& w : weights) skin.influences.push_back(strongest(w));
  return skin;
}

}  // namespace vasa::human
