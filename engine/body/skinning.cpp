#include "body/skinning.h"

#include <cassert>

namespace vasa {
namespace {

mat4 blended(const SkinInfluence& influence, std::span<const mat4> matrices) {
  mat4 sum(0);
  for (int i = 0; i < 4; ++i)
    if (influence.weights[i] != 0) sum += influence.weights[i] * matrices[influence.joints[std::size_t(i)]];
  return sum;
}

}  // namespace

std::vector<mat4> skinMatrices(const Skeleton& skeleton, const Pose& pose) {
  assert(pose.world.size() == skeleton.joints.size());
  std::vector<mat4> matrices(pose.world.size());
  for (std::size_t i = 0; i < matrices.size(); ++i)
    matrices[i] = pose.world[i] * skeleton.joints[i].inverseBind;
  return matrices;
}

std::vector<mat4> skinMatrices(const Body& body, const Pose& pose) {
  std::vector<mat4> matrices = skinMatrices(body.skeleton, pose);
  for (const AxialBone& bone : body.axialBones) matrices.push_back(mat4(matrices[bone.carrier.value]));
  return matrices;
}

void skinVertices(const SkinnedMesh& mesh, const std::vector<mat4>& matrices, std::vector<vec3>& positions,
                  std::vector<vec3>& normals) {
  const std::size_t count = mesh.mesh.positions.size();
  assert(mesh.influences.size() == count && mesh.normals.size() == count);
  positions.resize(count);
  normals.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    const mat4 m = blended(mesh.influences[i], matrices);
    positions[i] = vec3(m * vec4(mesh.mesh.positions[i], 1));
    const vec3 normal = mat3(m) * mesh.normals[i];
    const float length = glm::length(normal);
    normals[i] = length > 0 ? normal / length : mesh.normals[i];
  }
}

vec3 skinnedPosition(const SkinnedMesh& mesh, std::span<const mat4> matrices, std::uint32_t vertex) {
  return vec3(blended(mesh.influences[vertex], matrices) * vec4(mesh.mesh.positions[vertex], 1));
}

void skinPositions(const SkinnedMesh& mesh, const std::vector<mat4>& matrices, std::vector<vec3>& positions) {
  const std::size_t count = mesh.mesh.positions.size();
  assert(mesh.influences.size() == count);
  positions.resize(count);
  for (std::uint32_t i = 0; i < count; ++i) positions[i] = skinnedPosition(mesh, matrices, i);
}

}  // namespace vasa
