#include "convert/wall_sides.h"

#include <doctest/doctest.h>

#include "convert/sources.h"
#include "mesh/winding_number.h"

using namespace vasa;
using namespace vasa::test;

TEST_CASE("walls look away from their axes, whatever way each piece looked") {
  TriangleMesh mesh = tubeBetween({0, 0, 0}, {0, 0.1f, 0}, 0.004f, TubeEnds::open);
  const std::uint32_t first = std::uint32_t(mesh.positions.size());
  const TriangleMesh other = tubeBetween({0, 0.11f, 0}, {0.05f, 0.2f, 0}, 0.004f, TubeEnds::open);
  mesh.positions.insert(mesh.positions.end(), other.positions.begin(), other.positions.end());
  for (const uvec3& t : other.triangles)
    mesh.triangles.push_back(uvec3(t.x, t.z, t.y) + first);  // inside out
  std::swap(mesh.triangles[40].y, mesh.triangles[40].z);     // and one triangle in the other one's midst
  std::vector<vec3> axes;
  for (int i = 0; i <= 40; ++i) axes.push_back({0, 0.0025f * float(i), 0});
  for (int i = 0; i <= 40; ++i)
    axes.push_back(glm::mix(vec3(0, 0.11f, 0), vec3(0.05f, 0.2f, 0), float(i) / 40));
  turnOutward(mesh, axes);
  const WindingNumber winding(mesh.positions, mesh.triangles);
  CHECK(winding.at({0, 0.05f, 0}) > 0.9f);
  CHECK(winding.at({0.025f, 0.155f, 0}) > 0.9f);
  CHECK(std::abs(winding.at({0.03f, 0.05f, 0})) < 0.05f);
}

TEST_CASE("a mesh without triangles stays one") {
  TriangleMesh none;
  turnOutward(none, std::vector<vec3>{vec3(0)});
  CHECK(none.triangles.empty());
}
