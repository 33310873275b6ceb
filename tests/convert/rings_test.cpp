#include "convert/rings.h"

#include <doctest/doctest.h>

#include "support/tubes.h"

using namespace vasa;
using test::TubeEnds;

namespace {

std::optional<std::vector<vec4>> trace(const TriangleMesh& mesh) {
  const MeshEdges edges = buildEdges(mesh);
  return traceRings(mesh, edges, boundaryLoops(mesh, edges));
}

}  // namespace

TEST_CASE("a swept tube gives one section a ring, whatever the order of its vertices") {
  for (const TubeEnds ends : {TubeEnds::open, TubeEnds::flat})
    for (const unsigned seed : {0u, 3u}) {
      TriangleMesh mesh = test::straightTube(0.1f, 0.005f, ends);
      if (seed != 0) mesh = test::shuffled(mesh, seed);
      const auto sections = trace(mesh);
      REQUIRE(sections);
      REQUIRE(sections->size() == 41);
      for (const vec4& s : *sections) {
        CHECK(glm::length(vec2(s)) < 1e-6f);
        CHECK(s.w ==
              doctest::Approx(0.005 * std::sqrt(16 * std::sin(2 * double(kPi) / 16) / (2 * double(kPi)))));
      }
      CHECK(glm::distance(vec3(sections->front()), vec3(sections->back())) == doctest::Approx(0.1));
    }
}

TEST_CASE(
    "a slanted ring's area is taken as seen along the axis; a pointed end gets a section on its point") {
  TriangleMesh mesh = test::straightTube(0.1f, 0.005f);
  for (std::size_t i = 0; i < 41 * 16; ++i) mesh.positions[i].z += mesh.positions[i].x;  // 45 degrees
  mesh.positions.back().z += 0.006f;
  const auto sections = trace(mesh);
  REQUIRE(sections);
  CHECK(sections->size() == 42);
  CHECK((*sections)[20].w == doctest::Approx(0.004936).epsilon(1e-3));
  const vec4 tip = sections->front().z > 0.1f ? sections->front() : sections->back();
  CHECK(tip.z == doctest::Approx(0.1054));
  CHECK(tip.w < 0.003f);
}

TEST_CASE("no rings in a scan, a fork, a torn tube, a speck") {
  const auto scan = test::isosurface(
      [](vec3 p) {
        return test::capsuleDistance(p, {0, 0, 0}, {0, 0.05f, 0}, 0.006f);
      },
      vec3(-0.01f, -0.01f, -0.01f), vec3(0.01f, 0.06f, 0.01f), 0.002f);
  CHECK(!trace(scan));
  TriangleMesh torn = test::straightTube(0.1f, 0.005f);
  std::mt19937 random(2);
  std::erase_if(torn.triangles, [&](const uvec3&) { return random() % 10 == 0; });
  CHECK(!trace(torn));
  TriangleMesh speck;
  speck.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  speck.triangles = {{0, 1, 2}};
  CHECK(!trace(speck));
}
