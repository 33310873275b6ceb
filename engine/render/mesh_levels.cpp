#include "render/mesh_levels.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "body/body.h"
#include "math/aabb.h"

namespace vasa {
namespace {

constexpr float kFinestError = 0.0002f, kCoarsestError = 0.01f;  // [m]
constexpr float kWorthwhile = 0.8f;  // a level has at most this share of the triangles of the one before

// Reordered so that a vertex is shaded once for most of its triangles.
std::vector<uvec3> simplified(const TriangleMesh& mesh, const std::vector<uvec3>& from, float error) {
  if (from.empty()) return {};
  std::vector<uvec3> fewer(from.size());
  const std::size_t vertices = mesh.positions.size();
  const float* first = &mesh.positions[0].x;
  const float scale = meshopt_simplifyScale(first, vertices, sizeof(vec3));
  const std::size_t count = meshopt_simplify(&fewer[0].x, &from[0].x, 3 * from.size(), first, vertices,
                                             sizeof(vec3), 0, error / std::max(scale, error), 0, nullptr);
  fewer.resize(count / 3);
  if (!fewer.empty()) meshopt_optimizeVertexCache(&fewer[0].x, &fewer[0].x, count, vertices);
  return fewer;
}

}  // namespace

std::vector<MeshLevel> coarserLevels(const TriangleMesh& mesh) {
  std::vector<MeshLevel> levels;
  const std::vector<uvec3>* from = &mesh.triangles;
  float reached = 0;  // a level is made from the one before: errors add up
  for (float error = kFinestError; error <= kCoarsestError && !from->empty(); error *= 2) {
    std::vector<uvec3> fewer = simplified(mesh, *from, error - reached);
    if (fewer.empty() || float(fewer.size()) > kWorthwhile * float(from->size())) continue;
    levels.push_back({error, std::move(fewer)});
    from = &levels.back().triangles;
    reached = error;
  }
  return levels;
}

std::vector<JointBall> jointBalls(const SkinnedMesh& mesh) {
  std::map<std::uint32_t, Aabb> boxes;
  for (std::size_t i = 0; i < mesh.influences.size(); ++i) {
    const SkinInfluence& influence = mesh.influences[i];
    int heaviest = 0;
    for (int k = 1; k < 4; ++k)
      if (influence.weights[k] > influence.weights[heaviest]) heaviest = k;
    boxes[influence.joints[heaviest]].add(mesh.mesh.positions[i]);
  }
  std::vector<JointBall> balls;
  for (const auto& [joint, box] : boxes)
    balls.push_back({joint, box.centre(), glm::length(box.high - box.low) / 2});
  return balls;
}

float finestPixel(std::span<const JointBall> balls, std::span<const mat4> jointMatrices, const Camera& camera,
                  std::uint32_t pictureHeight) {
  if (camera.orthographicHeight > 0) return camera.orthographicHeight / float(pictureHeight);
  const vec3 forward = -cameraAxes(camera)[2];
  float nearest = camera.farDistance;
  for (const JointBall& ball : balls) {
    const vec3 centre = ball.joint < jointMatrices.size()
                            ? vec3(jointMatrices[ball.joint] * vec4(ball.centre, 1))
                            : ball.centre;
    const float depth = glm::dot(centre - camera.position, forward);
    if (depth + ball.radius > camera.nearDistance) nearest = std::min(nearest, depth - ball.radius);
  }
  const float depth = std::max(nearest, camera.nearDistance);
  return 2 * std::tan(camera.verticalAngle / 2) * depth / float(pictureHeight);
}

}  // namespace vasa
