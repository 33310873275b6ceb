#include "body/skin_shell.h"

#include <cmath>

#include "body/skin_field.h"
#include "body/skinning.h"

namespace vasa {

float windingNumber(const TriangleMesh& mesh, vec3 p) {
  double sum = 0;
  for (const uvec3 t : mesh.triangles) {
    const vec3 a = mesh.positions[t.x] - p, b = mesh.positions[t.y] - p, c = mesh.positions[t.z] - p;
    const float la = glm::length(a), lb = glm::length(b), lc = glm::length(c);
    const float denominator = la * lb * lc + glm::dot(a, b) * lc + glm::dot(b, c) * la + glm::dot(c, a) * lb;
    sum += 2 * std::atan2(glm::dot(a, glm::cross(b, c)), denominator);
  }
  return float(std::abs(sum) / (4 * kPi));
}

TriangleMesh skinAtRest(const Body& body) {
  const SkinnedMesh* skin = skinOf(body);
  if (!skin) return {};
  TriangleMesh mesh = skin->mesh;
  skinPositions(*skin, skinMatrices(body.skeleton, restPose(body.skeleton)), mesh.positions);
  return mesh;
}

SkinShell::SkinShell(TriangleMesh mesh) : mesh_(std::move(mesh)), tree_(mesh_) {}

SkinShell::Place SkinShell::look(vec3 p) const {
  const auto nearest = tree_.nearest(p);
  Place place{nearest.point, vec3(0), nearest.distance};
  if (nearest.triangle >= mesh_.triangles.size()) return place;
  const uvec3 t = mesh_.triangles[nearest.triangle];
  const vec3 a = mesh_.positions[t.x], b = mesh_.positions[t.y], c = mesh_.positions[t.z];
  const vec3 normal = glm::cross(b - a, c - a);
  const float size = glm::length(normal);
  place.normal = size > 0 ? normal / size : vec3(0);
  const bool seemsInside = glm::dot(p - nearest.point, place.normal) <= 0;
  if (!seemsInside && windingNumber(mesh_, p) < 0.5f) place.depth = -nearest.distance;
  return place;
}

}  // namespace vasa
