#include "surface/surface_mesh.h"

#include <doctest/doctest.h>

#include "core/hash.h"
#include "core/parallel.h"
#include "support/frames.h"
#include "support/manifold.h"
#include "support/networks.h"

using namespace vasa;

TEST_CASE("the one mesh of a network names the vessel of every vertex") {
  const Network network = test::windingNetwork(9, 3);
  const SurfaceMesh mesh = surfaceMesh(network, network.points(), test::framesOf(network), {6, 3});
  REQUIRE(mesh.positions.size() == mesh.vesselOfVertex.size());
  REQUIRE(mesh.positions.size() == mesh.normals.size());
  std::vector<int> seen(9);
  for (const std::uint32_t vessel : mesh.vesselOfVertex) ++seen.at(vessel);
  for (const int count : seen) CHECK(count > 0);
  for (const uvec3& t : mesh.triangles)
    for (int i = 0; i < 3; ++i) CHECK(t[i] < mesh.positions.size());
}

TEST_CASE("the surface of branching networks is closed at all extremes of m and n, whatever the threads") {
  for (const std::uint32_t seed : {1u, 2u, 3u}) {
    const Network network = test::branchingNetwork(41, seed);
    const std::vector<quat> frames = test::framesOf(network);
    for (const SweepShape shape :
         {SweepShape{3, 2}, SweepShape{4, 5}, SweepShape{5, 3}, SweepShape{16, 2}, SweepShape{8, 20}}) {
      setThreadCount(1);
      const SurfaceMesh one = surfaceMesh(network, network.points(), frames, shape);
      setThreadCount(3);
      const SurfaceMesh three = surfaceMesh(network, network.points(), frames, shape);
      setThreadCount(0);
      CHECK(hashOf(std::span(one.positions)) == hashOf(std::span(three.positions)));
      CHECK(hashOf(std::span(one.triangles)) == hashOf(std::span(three.triangles)));
      CHECK(test::openEdges(one.triangles) == 0);
      CHECK(test::openEdges(test::weldedByBits(one.positions, one.triangles)) == 0);
    }
  }
}
