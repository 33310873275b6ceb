#include "convert/reeb.h"

#include <doctest/doctest.h>

#include "mesh/level_set.h"
#include "support/tubes.h"

using namespace vasa;

namespace {

AxisGraph graphOfHeight(const TriangleMesh& mesh, int axis, float step) {
  std::vector<float> height;
  for (const vec3& p : mesh.positions) height.push_back(p[axis]);
  return reebGraph(mesh, buildEdges(mesh), height, step);
}

}  // namespace

TEST_CASE("a tube is one chain of round contours") {
  const AxisGraph graph = graphOfHeight(test::straightTube(0.1f, 0.01f), 2, 0.0041f);
  REQUIRE(graph.chains.size() == 1);
  CHECK(graph.nodes.size() == 2);
  CHECK(graph.chains[0].points.size() == 24);
  for (const vec4& p : graph.chains[0].points) {
    CHECK(glm::length(vec2(p)) < 1e-5f);
    CHECK(p.w == doctest::Approx(0.01).epsilon(0.01));
  }
}

TEST_CASE("a torus seen from the side has a loop, a Y has a fork") {
  const auto ring =
      test::tube([](float t) { return 0.05f * vec3(std::cos(2 * kPi * t), std::sin(2 * kPi * t), 0); },
                 [](float) { return 0.01f; }, 64, 16, test::TubeEnds::open);
  TriangleMesh torus = ring;  // the last ring is the first one
  for (uvec3& t : torus.triangles)
    for (int k = 0; k < 3; ++k) t[k] %= 64 * 16;
  const AxisGraph loop = graphOfHeight(torus, 0, 0.004f);
  CHECK(loop.chains.size() == 4);  // tip, two ways round, tip
  CHECK(loop.nodes.size() == 4);

  const auto y = test::isosurface(
      [](vec3 p) {
        return std::min({test::capsuleDistance(p, {0, 0, 0}, {0, 0.05f, 0}, 0.008f),
                         test::capsuleDistance(p, {0, 0.05f, 0}, {0.03f, 0.09f, 0}, 0.006f),
                         test::capsuleDistance(p, {0, 0.05f, 0}, {-0.03f, 0.09f, 0}, 0.006f)});
      },
      vec3(-0.05f, -0.02f, -0.02f), vec3(0.05f, 0.11f, 0.02f), 0.003f);
  const AxisGraph fork = graphOfHeight(y, 1, 0.003f);
  CHECK(fork.chains.size() == 3);
  CHECK(fork.nodes.size() == 4);
}
