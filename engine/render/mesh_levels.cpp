#include "render/mesh_levels.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "body/body.h"
#include "body/skinning.h"
#include "core/bytes.h"
#include "core/cancellation.h"
#include "core/hash.h"
#include "core/kept.h"
#include "core/parallel.h"
#include "math/aabb.h"
#include "mesh/components.h"
#include "mesh/weld.h"
#include "surface/octahedral.h"

namespace vasa {
namespace {

constexpr const char* kKind = "levels";
constexpr float kFinestError = 0.0002f, kCoarsestError = 0.01f;  // [m]
constexpr float kSqrt2 = 1.41421356f;
// Cosines of a corner's normal and its triangle's: below the first one they belong to different sides of an
// edge, and the corner's is turned to the second.
constexpr float kEdge = 0.7f, kBesideEdge = 0.95f;
// [rad] about the three axes of a joint alike. With 0.7, 0.96 and 1.2 the worst places of two bodies' skins
// in a bending motion lie 13, 9 and 8 mm off at some 2,600 triangles; more bends cost more triangles
// elsewhere.
constexpr float kBend = 0.96f;
constexpr float kAlone = 0.999f;     // weight of a joint that has a vertex to itself
constexpr float kWorthwhile = 0.8f;  // a level has at most this share of the triangles of the one before

// Where the mesh is with all joints but roots bent, or at rest where it does not bend: nor do bones, of which
// some vertices go with axial bones, beyond the joints.
std::vector<vec3> bentPositions(const SkinnedMesh& mesh, const Skeleton* skeleton) {
  const bool bends = std::ranges::any_of(mesh.influences, [](const SkinInfluence& influence) {
    return std::max({influence.weights.x, influence.weights.y, influence.weights.z, influence.weights.w}) <
           kAlone;
  });
  if (!skeleton || !bends) return mesh.mesh.positions;
  const auto isBone = [&](const SkinInfluence& influence) {
    return std::ranges::any_of(influence.joints,
                               [&](auto joint) { return joint >= skeleton->joints.size(); });
  };
  if (std::ranges::any_of(mesh.influences, isBone)) return mesh.mesh.positions;
  const quat bend = glm::angleAxis(kBend, glm::normalize(vec3(1)));
  std::vector<JointTransform> local;
  for (const auto& joint : skeleton->joints) {
    local.push_back(joint.rest);
    if (joint.parent.valid()) local.back().rotation = local.back().rotation * bend;
  }
  std::vector<vec3> bent;
  skinPositions(mesh, skinMatrices(*skeleton, poseFromLocal(*skeleton, local)), bent);
  return bent;
}

// Of all that says where a bent mesh is, beside the mesh itself.
std::uint64_t hashOfPose(const Skeleton& skeleton, std::uint64_t key) {
  for (const auto& joint : skeleton.joints)
    key = hashOf(std::span(&joint.inverseBind, 1),
                 hashOf(std::span(&joint.rest, 1), hashOf(std::span(&joint.parent, 1), key)));
  return hashOf(std::span(&skeleton.rootTransform, 1), key);
}

std::vector<uvec3> simplified(const TriangleMesh& mesh, std::span<const vec3> positions, float error) {
  std::vector<uvec3> fewer(mesh.triangles.size());
  const std::size_t vertices = positions.size();
  const float* first = &positions[0].x;
  const float scale = meshopt_simplifyScale(first, vertices, sizeof(vec3));
  const std::size_t count =
      meshopt_simplify(&fewer[0].x, &mesh.triangles[0].x, 3 * fewer.size(), first, vertices, sizeof(vec3), 0,
                       error / std::max(scale, error), 0, nullptr);
  fewer.resize(count / 3);
  if (!fewer.empty()) meshopt_optimizeVertexCache(&fewer[0].x, &fewer[0].x, count, vertices);
  return fewer;
}

// The normal of a large triangle's corner at a sharp edge would shade all of the triangle as if it were the
// edge.
vec3 cornerNormal(vec3 normal, vec3 face) {
  const float cosine = glm::dot(normal, face);
  if (cosine >= kEdge) return normal;
  const vec3 side = normal - cosine * face;
  const float length = glm::length(side);
  if (length < 1e-6f) return face;
  return kBesideEdge * face + std::sqrt(1 - kBesideEdge * kBesideEdge) / length * side;
}

// Vertices and their normals in the order in which triangles come upon them.
MeshLevel levelOf(const SkinnedMesh& mesh, const std::vector<uvec3>& triangles, float error) {
  MeshLevel level{error, {}, {}, {}};
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> places;  // by vertex and normal
  Checkpoints checkpoints;
  for (const uvec3& t : triangles) {
    checkpoints.pass();
    const vec3 area = mesh.mesh.areaNormal(t);
    const float size = glm::length(area);
    uvec3 own;
    for (int k = 0; k < 3; ++k) {
      const vec3 normal = size > 0 ? cornerNormal(mesh.normals[t[k]], area / size) : mesh.normals[t[k]];
      const auto [place, isNew] =
          places.try_emplace({t[k], packOctahedral(normal)}, std::uint32_t(level.vertices.size()));
      if (isNew) level.vertices.push_back(t[k]), level.normals.push_back(normal);
      own[k] = place->second;
    }
    level.triangles.push_back(own);
  }
  return level;
}

// All levels but the first, which is the mesh itself.
void save(const LevelledMesh& mesh, ByteWriter& out) {
  out.add(mesh.closed);
  out.add(std::uint32_t(mesh.levels.size()));
  for (const MeshLevel& level : std::span(mesh.levels).subspan(1)) {
    out.add(level.error);
    out.addAll(std::span(level.vertices));
    out.addAll(std::span(level.normals));
    out.addAll(std::span(level.triangles));
  }
}

std::optional<BodyLevels> restored(std::span<const SkinnedMesh> meshes, std::span<const std::byte> bytes) {
  BodyLevels all;
  ByteReader in(bytes);
  for (const SkinnedMesh& mesh : meshes) {
    LevelledMesh& own = all.emplace_back(oneLevel(mesh));
    std::uint32_t count = 0;
    if (!in.take(own.closed) || !in.take(count)) return {};
    for (std::uint32_t k = 1; k < count; ++k) {
      MeshLevel level{};
      if (!in.take(level.error) || !in.takeAll(level.vertices) || !in.takeAll(level.normals) ||
          !in.takeAll(level.triangles))
        return {};
      own.levels.push_back(std::move(level));
    }
  }
  return all;
}

}  // namespace

LevelledMesh oneLevel(const SkinnedMesh& mesh) {
  MeshLevel level{0, {}, mesh.normals, mesh.mesh.triangles};
  for (std::uint32_t i = 0; i < mesh.mesh.positions.size(); ++i) level.vertices.push_back(i);
  return {{level}};
}

LevelledMesh coarserLevels(const SkinnedMesh& mesh, const Skeleton* skeleton) {
  LevelledMesh result = oneLevel(mesh);
  if (mesh.mesh.triangles.empty()) return result;
  result.closed = isClosed(mesh.mesh);
  std::vector<MeshLevel>& levels = result.levels;
  const std::vector<vec3> bent = bentPositions(mesh, skeleton);
  // Each from the mesh itself, since errors of one level made from another add up.
  for (float error = kFinestError; error <= kCoarsestError; error *= kSqrt2) {
    checkpoint();
    const std::vector<uvec3> fewer = simplified(mesh.mesh, bent, error);
    if (fewer.empty() || float(fewer.size()) > kWorthwhile * float(levels.back().triangles.size())) continue;
    levels.push_back(levelOf(mesh, fewer, error));
  }
  return result;
}

// Closed: every edge is run along once each way.
bool isClosed(const TriangleMesh& mesh) {
  const TriangleMesh whole = weld(mesh, 0);  // seams of the normals are none of the surface
  std::vector<std::uint64_t> there, back;
  for (const uvec3& t : whole.triangles)
    for (int k = 0; k < 3; ++k) {
      const std::uint64_t from = t[k], to = t[(k + 1) % 3];
      there.push_back(from << 32 | to);
      back.push_back(to << 32 | from);
    }
  std::ranges::sort(there);
  std::ranges::sort(back);
  if (there.empty() || there != back || std::ranges::adjacent_find(there) != there.end()) return false;
  return std::ranges::all_of(splitComponents(whole),
                             [](const TriangleMesh& piece) { return piece.volume() > 0; });
}

BodyLevels bodyLevels(std::span<const SkinnedMesh> meshes, const Skeleton* skeleton) {
  std::uint64_t key = meshes.size();
  for (const SkinnedMesh& mesh : meshes) {
    key = hashOf(std::span(mesh.normals),
                 hashOf(std::span(mesh.mesh.triangles), hashOf(std::span(mesh.mesh.positions), key)));
    if (skeleton) key = hashOf(std::span(mesh.influences), key);
  }
  if (skeleton) key = hashOfPose(*skeleton, key);
  if (const auto kept = findKept(kKind, key))
    if (auto levels = restored(meshes, *kept)) return std::move(*levels);
  BodyLevels all(meshes.size());
  parallelFor(meshes.size(), 1, [&](std::size_t i) { all[i] = coarserLevels(meshes[i], skeleton); });
  ByteWriter out;
  for (const LevelledMesh& mesh : all) save(mesh, out);
  keep(kKind, key, out.bytes());
  return all;
}

std::vector<JointBall> jointBalls(const SkinnedMesh& mesh) {
  std::map<std::uint32_t, Aabb> boxes;
  for (std::size_t i = 0; i < mesh.influences.size(); ++i) {
    const SkinInfluence& influence = mesh.influences[i];
    boxes[influence.joints[influence.heaviest()]].add(mesh.mesh.positions[i]);
  }
  std::vector<JointBall> balls;
  for (const auto& [joint, box] : boxes)
    balls.push_back({joint, box.centre(), glm::length(box.high - box.low) / 2});
  return balls;
}

float nearestDepth(std::span<const JointBall> balls, std::span<const mat4> jointMatrices,
                   const Camera& camera) {
  const vec3 forward = -cameraAxes(camera)[2];
  float nearest = camera.farDistance;
  for (const JointBall& ball : balls) {
    const vec3 centre = ball.joint < jointMatrices.size()
                            ? vec3(jointMatrices[ball.joint] * vec4(ball.centre, 1))
                            : ball.centre;
    const float depth = glm::dot(centre - camera.position, forward);
    if (depth + ball.radius > camera.nearDistance) nearest = std::min(nearest, depth - ball.radius);
  }
  return nearest;
}

float pixelAt(float depth, const Camera& camera, std::uint32_t pictureHeight) {
  if (camera.orthographicHeight > 0) return camera.orthographicHeight / float(pictureHeight);
  return 2 * std::tan(camera.verticalAngle / 2) * std::max(depth, camera.nearDistance) / float(pictureHeight);
}

}  // namespace vasa
