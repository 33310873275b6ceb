#include "body/skin_shell.h"

#include <cmath>

#include "body/skin_field.h"
#include "body/skinning.h"

namespace vasa {

TriangleMesh meshAtRest(const Body& body, const SkinnedMesh& skinned) {
  TriangleMesh mesh = skinned.mesh;
  skinPositions(skinned, skinMatrices(body, restPose(body.skeleton)), mesh.positions);
  return mesh;
}

TriangleMesh skinAtRest(const Body& body) {
  const SkinnedMesh* skin = skinOf(body);
  return skin ? meshAtRest(body, *skin) : TriangleMesh{};
}

SkinShell::SkinShell(TriangleMesh mesh)
    : mesh_(std::move(mesh)), tree_(mesh_), winding_(mesh_.positions, mesh_.triangles) {}

bool SkinShell::contains(vec3 p) const { return std::abs(winding_.at(p)) >= 0.5f; }

SkinShell::Place SkinShell::look(vec3 p) const {
  const auto nearest = tree_.nearest(p);
  Place place{.nearest = nearest.point, .triangle = nearest.triangle, .depth = nearest.distance};
  if (nearest.triangle >= mesh_.triangles.size()) return place;
  const vec3 normal = mesh_.areaNormal(mesh_.triangles[nearest.triangle]);
  const float size = glm::length(normal);
  place.normal = size > 0 ? normal / size : vec3(0);
  const bool seemsInside = glm::dot(p - nearest.point, place.normal) <= 0;
  if (!seemsInside && !contains(p)) place.depth = -nearest.distance;
  return place;
}

std::optional<vec3> SkinShell::facing(vec3 p, vec3 normal, float cosine, float within) const {
  const auto near = tree_.nearest(p, within);
  if (near.triangle >= mesh_.triangles.size()) return std::nullopt;
  const vec3 area = mesh_.areaNormal(mesh_.triangles[near.triangle]);
  const float size = glm::length(area);
  if (!(size > 0) || glm::dot(area / size, normal) < cosine) return std::nullopt;
  return near.point;
}

}  // namespace vasa
