#include "surface/surface_mesh.h"

#include <doctest/doctest.h>

#include "support/networks.h"

using namespace vasa;

TEST_CASE("the one mesh of a network names the vessel of every vertex") {
  const Network network = test::windingNetwork(9, 3);
  std::vector<quat> frames(network.sectionCount());
  networkFrames(network, network.points(), restReferences(network), frames);
  const SurfaceMesh mesh = surfaceMesh(network, network.points(), frames, {6, 3});
  REQUIRE(mesh.positions.size() == mesh.vesselOfVertex.size());
  REQUIRE(mesh.positions.size() == mesh.normals.size());
  std::vector<int> seen(9);
  for (const std::uint32_t vessel : mesh.vesselOfVertex) ++seen.at(vessel);
  for (const int count : seen) CHECK(count > 0);
  for (const uvec3& t : mesh.triangles)
    for (int i = 0; i < 3; ++i) CHECK(t[i] < mesh.positions.size());
}
