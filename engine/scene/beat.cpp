#include "scene/beat.h"

#include <algorithm>
#include <cmath>

#include "body/mesh_role.h"

namespace vasa {
namespace {

constexpr float kBeatsPerSecond = 1.2f;
constexpr float kSystole = 0.35f;  // share of a beat
constexpr float kSqueeze = 0.08f;  // of the heart's size
constexpr float kHeld = 0.8f,
                kFree = 1.7f;  // vessels nearer than the first follow wholly, beyond the second not: radii

bool isHeart(const SkinnedMesh& mesh) {
  return roleNamed(mesh.name) == MeshRole::heart && !mesh.mesh.positions.empty();
}

// The joint that carries most of the mesh.
std::uint32_t carrier(const SkinnedMesh& mesh, const Body& body) {
  std::vector<float> weight(body.skeleton.joints.size(), 0.0f);
  for (const SkinInfluence& influence : mesh.influences)
    for (int k = 0; k < 4; ++k)
      weight[body.carrier(influence.joints[std::size_t(k)])] += influence.weights[k];
  return std::uint32_t(std::max_element(weight.begin(), weight.end()) - weight.begin());
}

}  // namespace

vec3 meshCentre(const SkinnedMesh& mesh) {
  glm::dvec3 sum(0);
  for (const vec3& p : mesh.mesh.positions) sum += glm::dvec3(p);
  return vec3(sum / double(std::max<std::size_t>(mesh.mesh.positions.size(), 1)));
}

HeartBeat::HeartBeat(const Scene& scene) {
  const auto heart = std::ranges::find_if(scene.body.meshes, isHeart);
  if (heart == scene.body.meshes.end()) return;
  joint_ = carrier(*heart, scene.body);
  centre_ = meshCentre(*heart);
  float radius = 0;
  for (const vec3& p : heart->mesh.positions) radius = std::max(radius, glm::distance(p, centre_));
  const auto points = scene.network.points();
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    const float away = (glm::distance(vec3(points[i]), centre_) / radius - kHeld) / (kFree - kHeld);
    if (away < 1) followers_.push_back({i, glm::smoothstep(0.0f, 1.0f, 1 - away)});
  }
}

float HeartBeat::scaleAt(float time) {
  const float phase = time * kBeatsPerSecond - std::floor(time * kBeatsPerSecond);
  if (phase >= kSystole) return 1;
  const float drawn = std::sin(kPi * phase / kSystole);
  return 1 - kSqueeze * drawn * drawn;
}

void HeartBeat::apply(float scale, std::span<const mat4> jointMatrices, std::span<vec4> points) const {
  if (followers_.empty() || scale == 1) return;
  const vec3 centre(jointMatrices[joint_] * vec4(centre_, 1));
  for (const Follower& follower : followers_) {
    vec4& point = points[follower.point];
    point = vec4(glm::mix(vec3(point), centre, follower.share * (1 - scale)), point.w);
  }
}

}  // namespace vasa
