#include "mesh/triangle_mesh.h"

namespace vasa {

Aabb TriangleMesh::bounds() const {
  Aabb box;
  for (const vec3& position : positions) box.add(position);
  return box;
}

double TriangleMesh::area() const {
  double sum = 0;
  for (const uvec3& t : triangles) {
    const dvec3 a(positions[t.x]), b(positions[t.y]), c(positions[t.z]);
    sum += 0.5 * glm::length(glm::cross(b - a, c - a));
  }
  return sum;
}

double TriangleMesh::volume() const {
  double sum = 0;
  for (const uvec3& t : triangles)
    sum += glm::dot(dvec3(positions[t.x]), glm::cross(dvec3(positions[t.y]), dvec3(positions[t.z])));
  return sum / 6;
}

std::vector<vec3> vertexNormals(const TriangleMesh& mesh) {
  std::vector<vec3> normals(mesh.positions.size(), vec3(0));
  for (const uvec3& t : mesh.triangles) {
    const vec3 weighted = mesh.areaNormal(t);
    for (int corner = 0; corner < 3; ++corner) normals[t[corner]] += weighted;
  }
  for (vec3& normal : normals) {
    const float length = glm::length(normal);
    normal = length > 0 ? normal / length : vec3(0, 0, 1);
  }
  return normals;
}

}  // namespace vasa
