#include "surface/surface_mesh.h"

#include <doctest/doctest.h>

#include "mesh/triangle_mesh.h"
#include "support/frames.h"
#include "support/manifold.h"
#include "support/networks.h"

using namespace vasa;

namespace {

SurfaceMesh surfaceOf(const Network& network, const SweepShape& shape) {
  return surfaceMesh(network, network.points(), test::framesOf(network), shape);
}

}  // namespace

TEST_CASE("a straight tube is closed, turned outwards and holds its volume") {
  const Network network = test::straightVessel(1, 0.1f, 0.1f, 4);
  const SurfaceMesh surface = surfaceOf(network, {16, 2});
  CHECK(test::openEdges(surface.triangles) == 0);
  CHECK(surface.triangles.size() == 4 * 2 * 2 * 16 + 2 * 5 * 16);
  const TriangleMesh mesh{surface.positions, surface.triangles};
  const double ring = 16 * 0.5 * 0.01 * std::sin(2 * kPi / 16);  // area of the 16-gon
  CHECK(mesh.volume() > ring);
  CHECK(mesh.volume() < kPi * (0.01 + 4.0 / 3 * 0.001));
  const std::vector<vec3> normals = vertexNormals(mesh);
  for (std::size_t i = 0; i < normals.size(); ++i) CHECK(glm::dot(normals[i], surface.normals[i]) > 0.85f);
}

TEST_CASE("neighbouring spans share their ring, bit for bit") {
  const Network network = test::windingNetwork(20, 11);
  const SweepTable table = makeSweepTable(network);
  const std::vector<quat> frames = test::framesOf(network);
  const PosedNetwork posed{table, network.points(), frames};
  for (const SweepShape shape : {SweepShape{3, 2}, SweepShape{7, 5}, SweepShape{16, 20}}) {
    std::vector<SurfacePoint> one(shape.sweepVertices()), next(one);
    for (std::uint32_t i = 0; i + 1 < table.sweeps.size(); ++i) {
      if (table.sweeps[i].to != 1 || table.sweeps[i].nextClass == shared::kNoSpan) continue;
      if (table.sweeps[i + 1].point != table.sweeps[i].point + 1 || table.sweeps[i + 1].from != 0) continue;
      tessellateSweep(posed, i, shape, one);
      tessellateSweep(posed, i + 1, shape, next);
      for (std::uint32_t k = 0; k < shape.around; ++k) {
        const SurfacePoint& last = one[shape.along * shape.around + k];
        CHECK(last.position == next[k].position);
        CHECK(last.normal == next[k].normal);
      }
    }
  }
}

TEST_CASE("every ring lies on its circle") {
  const Network network = test::windingNetwork(12, 2);
  const SweepTable table = makeSweepTable(network);
  const std::vector<quat> frames = test::framesOf(network);
  const PosedNetwork posed{table, network.points(), frames};
  const SweepShape shape{5, 4};
  std::vector<SurfacePoint> points(shape.sweepVertices());
  for (std::uint32_t i = 0; i < table.sweeps.size(); ++i) {
    tessellateSweep(posed, i, shape, points);
    const Vessel& vessel = network.vessels()[table.vesselOfSweep[i]];
    for (std::uint32_t ring = 0; ring <= shape.along; ++ring) {
      const float t = glm::mix(table.sweeps[i].from, table.sweeps[i].to, float(ring) / 4);
      const float u = float(table.sweeps[i].point - vessel.firstPoint) + t;
      const vec4 truth = evaluate(network.pointsOf(vessel), u);
      for (std::uint32_t k = 0; k < 5; ++k)
        CHECK(glm::distance(points[ring * 5 + k].position, vec3(truth)) ==
              doctest::Approx(truth.w).epsilon(1e-4));
    }
  }
}
