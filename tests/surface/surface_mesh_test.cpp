#include "surface/surface_mesh.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <map>

#include "core/disjoint_sets.h"
#include "core/hash.h"
#include "core/parallel.h"
#include "network/builder.h"
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

TEST_CASE("of two vessels that go on in one another each has its wall up to where they meet") {
  const auto piece = [](float from, float to) {
    std::vector<vec4> points;
    for (int k = 0; k <= 8; ++k) points.emplace_back(0, glm::mix(from, to, float(k) / 8), 0, 0.004f);
    return points;
  };
  NetworkBuilder builder;
  const VesselId lower = builder.addVessel({"lower", "", VesselKind::artery}, piece(0, 0.1f));
  const VesselId upper = builder.addVessel({"upper", "", VesselKind::artery}, piece(0.1f, 0.2f));
  builder.joinEnds({{lower, true}, {upper, false}});
  const Network network = test::built(builder);
  const SurfaceMesh mesh = surfaceMesh(network, network.points(), test::framesOf(network), {8, 3});
  std::array<float, 2> highest{}, lowest{1, 1};
  for (const uvec3& t : mesh.triangles)
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t vessel = mesh.vesselOfVertex[t.x];
      highest[vessel] = std::max(highest[vessel], mesh.positions[t[k]].y);
      lowest[vessel] = std::min(lowest[vessel], mesh.positions[t[k]].y);
    }
  CHECK(highest[0] == doctest::Approx(0.1).epsilon(0.01));
  CHECK(lowest[1] == doctest::Approx(0.1).epsilon(0.01));
}

TEST_CASE(
    "each vessel's part of the mesh begins and ends with whole rings, or where three meet with a loop each") {
  const Network network = test::branchingNetwork(41, 2);
  const SurfaceMesh mesh = surfaceMesh(network, network.points(), test::framesOf(network), {8, 3});
  std::map<std::uint32_t, std::map<std::pair<std::uint32_t, std::uint32_t>, int>> edges;  // by vessel
  for (const uvec3& t : mesh.triangles) {
    if (t.x == t.y || t.y == t.z || t.z == t.x) continue;
    for (int k = 0; k < 3; ++k) {
      const auto [from, to] = std::minmax(t[k], t[(k + 1) % 3]);
      ++edges[mesh.vesselOfVertex[t.x]][{from, to}];
    }
  }
  std::map<std::uint32_t, int> vesselsAt;  // of a vertex that lies on a rim
  std::vector<std::vector<std::uint32_t>> rims;
  for (const auto& [vessel, own] : edges) {
    std::map<std::uint32_t, int> open;  // rims that a vertex lies on, twice
    DisjointSets loops(mesh.positions.size());
    for (const auto& [edge, count] : own)
      if (count == 1) ++open[edge.first], ++open[edge.second], loops.unite(edge.first, edge.second);
    std::map<std::uint32_t, std::vector<std::uint32_t>> byRoot;
    for (const auto& [vertex, count] : open) {
      CHECK(count == 2);
      ++vesselsAt[vertex];
      byRoot[loops.find(vertex)].push_back(vertex);
    }
    for (auto& [root, rim] : byRoot) rims.push_back(std::move(rim));
  }
  std::size_t whole = 0, meetings = 0;
  for (const std::vector<std::uint32_t>& rim : rims) {
    const auto three = std::ranges::count_if(rim, [&](std::uint32_t v) { return vesselsAt[v] == 3; });
    CHECK((three == 2 || (three == 0 && rim.size() == 8)));
    ++(three == 0 ? whole : meetings);
  }
  CHECK(whole > 41);
  CHECK(meetings > 0);
  CHECK(meetings % 3 == 0);
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
