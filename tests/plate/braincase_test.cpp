#include "plate/braincase.h"

#include <doctest/doctest.h>

#include "mesh/triangle_mesh.h"

using namespace vasa;
using namespace vasa::plate;

namespace {

// A ball of 24 by 48 faces; none below the height `open`, as a share of its radius.
void addBall(TriangleMesh& mesh, vec3 centre, float radius, bool inwards, float open = -2) {
  constexpr std::uint32_t kBallRows = 24, kBallColumns = 48;
  const auto first = std::uint32_t(mesh.positions.size());
  for (std::uint32_t row = 0; row <= kBallRows; ++row)
    for (std::uint32_t column = 0; column < kBallColumns; ++column) {
      const float down = kPi * float(row) / kBallRows, around = 2 * kPi * float(column) / kBallColumns;
      mesh.positions.push_back(centre + radius * vec3(std::sin(down) * std::sin(around), std::cos(down),
                                                      std::sin(down) * std::cos(around)));
    }
  const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    if (mesh.positions[a].y < centre.y + open * radius) return;
    mesh.triangles.push_back(inwards ? uvec3(a, c, b) : uvec3(a, b, c));
  };
  for (std::uint32_t row = 0; row < kBallRows; ++row)
    for (std::uint32_t column = 0; column < kBallColumns; ++column) {
      const std::uint32_t a = first + row * kBallColumns + column,
                          b = first + row * kBallColumns + (column + 1) % kBallColumns;
      add(a, a + kBallColumns, b);
      add(b, a + kBallColumns, b + kBallColumns);
    }
}

// A shell of 9 to 10 cm with a hole below, and a jaw under it in front: a thick ball with a canal.
TriangleMesh skull() {
  TriangleMesh mesh;
  addBall(mesh, vec3(0), 0.1f, false, -0.9f);
  addBall(mesh, vec3(0), 0.09f, true, -0.9f);
  addBall(mesh, vec3(0, -0.12f, 0.08f), 0.03f, false);
  addBall(mesh, vec3(0, -0.12f, 0.08f), 0.01f, true);
  return mesh;
}

}  // namespace

TEST_CASE("a braincase holds what lies in its hollow, down to its hole") {
  const TriangleMesh mesh = skull();
  const Braincase braincase(mesh.positions, mesh.triangles);
  for (const vec3& inside :
       {vec3(0), vec3(0.08f, 0, 0), vec3(-0.05f, -0.05f, 0.04f), vec3(0, 0.085f, 0), vec3(0, -0.05f, -0.06f)})
    CHECK(braincase.holds(inside));
  for (const vec3& outside : {vec3(0, 0.12f, 0), vec3(0.2f, 0, 0), vec3(0, -0.13f, 0), vec3(0.5f)})
    CHECK_FALSE(braincase.holds(outside));
}

TEST_CASE("a canal of the jaw is enclosed, and not of the braincase") {
  const TriangleMesh mesh = skull();
  CHECK_FALSE(Braincase(mesh.positions, mesh.triangles).holds(vec3(0, -0.12f, 0.08f)));
  TriangleMesh jaw;
  addBall(jaw, vec3(0), 0.03f, false);
  addBall(jaw, vec3(0), 0.01f, true);
  CHECK(Braincase(jaw.positions, jaw.triangles).holds(vec3(0)));
}

TEST_CASE("bones without a hollow hold nothing, nor do no bones") {
  TriangleMesh solid;
  addBall(solid, vec3(0), 0.1f, false);
  CHECK_FALSE(Braincase(solid.positions, solid.triangles).holds(vec3(0)));
  CHECK_FALSE(Braincase({}, {}).holds(vec3(0)));
}
