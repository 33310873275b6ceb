#include "render/mesh_set.h"

#include <algorithm>
#include <cassert>

#include "core/parallel.h"
#include "gpu/transfer.h"
#include "render/picture.h"
#include "scene/beat.h"
#include "shared/draw.h"
#include "shared/skin.h"
#include "surface/octahedral.h"

namespace vasa {
namespace {

constexpr float kOrganOpacity = 0.3f;  // of one whose material tells none

shared::SkinVertex restVertex(const SkinnedMesh& mesh, std::uint32_t i, vec3 normal) {
  const vec3 position = mesh.mesh.positions[i];
  const SkinInfluence& influence = mesh.influences[i];
  const auto& j = influence.joints;
  return {position.x,
          position.y,
          position.z,
          packOctahedral(normal),
          j[0] | std::uint32_t(j[1]) << 16,
          j[2] | std::uint32_t(j[3]) << 16,
          influence.weights};
}

// Bones, heart and skin have colours of their own, teeth and cartilage among the bones, too; any other mesh
// keeps its material's, an organ where that is more than the white of a file that tells none.
bool isPlain(const SkinnedMesh& mesh) { return vec3(mesh.colour) == vec3(1); }

std::uint32_t meshColour(const SkinnedMesh& mesh, MeshRole role) {
  const bool own = role == MeshRole::other || (role == MeshRole::organs && !isPlain(mesh));
  vec4 colour = own ? srgbColour(mesh.colour) : colourOf(role);
  if (role == MeshRole::bones && mesh.name == "cartilage") colour = {0.84f, 0.86f, 0.82f, 1};
  if (role == MeshRole::bones && mesh.name == "teeth") colour = {0.97f, 0.95f, 0.90f, 1};
  return packColour(vec4(vec3(colour), 0)) | (shared::kMeshKind + std::uint32_t(role)) << 24;
}

}  // namespace

MeshSet::MeshSet(gpu::Device& device, std::span<const SkinnedMesh> meshes, const BodyLevels& levels)
    : MeshSet(device, std::make_shared<const AtRest>(atRest(device, meshes, levels))) {}

MeshSet::MeshSet(gpu::Device& device, std::shared_ptr<const AtRest> rest)
    : rest_(std::move(rest)),
      posed_(device, {.name = "posed mesh vertices",
                      .bytes = rest_->vertexCount * sizeof(shared::TubeVertex),
                      .moreUsage = VK_BUFFER_USAGE_VERTEX_BUFFER_BIT}) {}

MeshSet::AtRest MeshSet::atRest(gpu::Device& device, std::span<const SkinnedMesh> meshes,
                                const BodyLevels& levels) {
  AtRest rest;
  assert(levels.size() == meshes.size());
  std::vector<std::uint32_t> colours;
  std::size_t triangleCount = 0;
  for (std::size_t k = 0; k < meshes.size(); ++k) {
    const SkinnedMesh& mesh = meshes[k];
    assert(mesh.normals.size() == mesh.mesh.positions.size() &&
           mesh.influences.size() == mesh.normals.size());
    const MeshRole role = roleNamed(mesh.name);
    Part& part = rest.parts.emplace_back(Part{.role = role,
                                              .opacity = mesh.colour.a < 1 ? mesh.colour.a : kOrganOpacity,
                                              .levels = {},
                                              .closed = levels[k].closed,
                                              .balls = {}});
    for (const MeshLevel& level : levels[k].levels) {
      part.levels.push_back({level.error, std::uint32_t(3 * triangleCount),
                             std::uint32_t(3 * level.triangles.size()), std::uint32_t(rest.vertexCount),
                             std::uint32_t(level.vertices.size()), true});
      rest.vertexCount += level.vertices.size();
      triangleCount += level.triangles.size();
    }
    if (role == MeshRole::heart && rest.heart.part >= meshes.size()) rest.heart = {k, meshCentre(mesh)};
    colours.push_back(meshColour(mesh, role));
  }
  std::vector<shared::SkinVertex> vertices(rest.vertexCount);
  std::vector<uvec3> triangles(triangleCount);
  std::vector<std::uint32_t> jointCounts(meshes.size());
  parallelFor(meshes.size(), 1, [&](std::size_t k) {
    const SkinnedMesh& mesh = meshes[k];
    rest.parts[k].balls = jointBalls(mesh);
    for (const SkinInfluence& influence : mesh.influences)
      for (const std::uint16_t joint : influence.joints)
        jointCounts[k] = std::max(jointCounts[k], joint + 1u);
    for (std::size_t l = 0; l < levels[k].levels.size(); ++l) {
      const MeshLevel& level = levels[k].levels[l];
      const Level& at = rest.parts[k].levels[l];
      std::ranges::copy(level.triangles, triangles.begin() + at.firstIndex / 3);
      for (std::size_t i = 0; i < level.vertices.size(); ++i)
        vertices[at.firstVertex + i] = restVertex(mesh, level.vertices[i], level.normals[i]);
    }
  });
  for (const std::uint32_t count : jointCounts) rest.jointCount = std::max(rest.jointCount, count);
  rest.vertices =
      gpu::makeBuffer(device, "mesh vertices at rest", std::span<const shared::SkinVertex>(vertices));
  rest.indices = gpu::makeBuffer(device, "mesh indices", std::span<const uvec3>(triangles));
  rest.colours = gpu::makeBuffer(device, "mesh colours", std::span<const std::uint32_t>(colours));
  return rest;
}

void MeshSet::levelsFor(const Look& look, std::span<const mat4> jointMatrices, const Camera& camera,
                        std::uint32_t pictureHeight, float pixels, std::vector<Level>& chosen) const {
  chosen.clear();
  for (const Part& part : rest_->parts) {
    if (opacityOf(part.role, look) <= 0) {
      chosen.emplace_back();
      continue;
    }
    const float depth = nearestDepth(part.balls, jointMatrices, camera);
    const float error = pixels * pixelAt(depth, camera, pictureHeight);
    std::size_t level = 0;
    while (level + 1 < part.levels.size() && part.levels[level + 1].error <= error) ++level;
    chosen.push_back(part.levels[level]);
    chosen.back().depth = depth;
    chosen.back().bothSides = !part.closed || camera.cut || depth <= camera.nearDistance;
  }
}

}  // namespace vasa
