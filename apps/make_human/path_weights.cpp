#include "make_human/path_weights.h"

#include <algorithm>

#include "math/closest_point.h"

namespace vasa::human {
namespace {

constexpr float kLeastWeight = 0.02f;

}  // namespace

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

PathPosition upPath(const std::vector<int>& path, const Rig& rig, vec3 p) {
  const RigPoint &first = rig.points[std::size_t(path.front())], &last = rig.points[std::size_t(path.back())];
  const vec3 up = glm::normalize(rig.points[std::size_t(last.towards)].position - first.position);
  PathPosition result{glm::dot(p - first.position, up), {}};
  for (const int joint : path)
    result.joints.push_back(glm::dot(rig.points[std::size_t(joint)].position - first.position, up));
  return result;
}

void addPathWeights(const std::vector<int>& path, const Rig& rig, const PathPosition& position, float share,
                    Weights& weights) {
  float left = share;
  for (std::size_t i = path.size(); i-- > 0;) {
    const RigPoint& joint = rig.points[std::size_t(path[i])];
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

}  // namespace vasa::human
