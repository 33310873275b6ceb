#include "convert/bridge.h"

#include <doctest/doctest.h>

#include "support/tubes.h"

using namespace vasa;

namespace {

// Straight branches from a to b, sections every 2 mm, each its own piece.
ElementSkeleton skeletonOf(const std::vector<std::pair<vec4, vec4>>& lines) {
  ElementSkeleton skeleton;
  for (const auto& [a, b] : lines) {
    ElementBranch branch;
    const int count = int(glm::distance(vec3(a), vec3(b)) / 0.002f);
    for (int i = 0; i <= count; ++i) branch.sections.push_back(glm::mix(a, b, float(i) / float(count)));
    branch.startNode = std::uint32_t(skeleton.nodes.size());
    branch.endNode = branch.startNode + 1;
    skeleton.nodes.push_back({vec3(a), 1});
    skeleton.nodes.push_back({vec3(b), 1});
    skeleton.branches.push_back(std::move(branch));
  }
  return skeleton;
}

}  // namespace

TEST_CASE("ends that face one another are joined, whichever way round the branches run") {
  for (const bool turned : {false, true}) {
    const vec4 a(0, 0, 0, 0.003f), b(0.05f, 0, 0, 0.003f), c(0.056f, 0, 0, 0.003f), d(0.1f, 0, 0, 0.002f);
    ElementSkeleton skeleton = skeletonOf({{a, b}, turned ? std::pair{d, c} : std::pair{c, d}});
    CHECK(bridgeGaps(skeleton, 3, 0) == 1);
    dropUnusedNodes(skeleton);
    REQUIRE(skeleton.branches.size() == 1);
    REQUIRE(skeleton.nodes.size() == 2);
    const ElementBranch& branch = skeleton.branches[0];
    CHECK(vec3(branch.sections.front()) == skeleton.nodes[branch.startNode].position);
    CHECK(vec3(branch.sections.back()) == skeleton.nodes[branch.endNode].position);
    for (std::size_t i = 1; i < branch.sections.size(); ++i)
      CHECK(branch.sections[i].x > branch.sections[i - 1].x);
  }
}

TEST_CASE("ends too far, side by side, of unlike thickness or of one piece are not joined") {
  const vec4 a(0, 0, 0, 0.003f), b(0.05f, 0, 0, 0.003f);
  ElementSkeleton far = skeletonOf({{a, b}, {vec4(0.07f, 0, 0, 0.003f), vec4(0.1f, 0, 0, 0.003f)}});
  CHECK(bridgeGaps(far, 3, 0) == 0);
  ElementSkeleton beside = skeletonOf({{a, b}, {vec4(0.05f, 0.006f, 0, 0.003f), vec4(0, 0.006f, 0, 0.003f)}});
  CHECK(bridgeGaps(beside, 3, 0) == 0);
  ElementSkeleton unlike = skeletonOf({{a, b}, {vec4(0.055f, 0, 0, 0.001f), vec4(0.1f, 0, 0, 0.001f)}});
  CHECK(bridgeGaps(unlike, 3, 0) == 0);
  ElementSkeleton one = skeletonOf({{a, b}});
  CHECK(bridgeGaps(one, 100, 0) == 0);
}

TEST_CASE("a tube cut in two with a gap comes back as one branch") {
  TriangleMesh mesh = test::shuffled(test::straightTube(0.05f, 0.004f), 1);
  TriangleMesh rest = test::shuffled(test::straightTube(0.05f, 0.004f), 2);
  for (vec3& p : rest.positions) p.z += 0.056f;
  test::append(mesh, rest);
  const ElementSkeleton skeleton = skeletonise(mesh, {});
  REQUIRE(skeleton.branches.size() == 1);
  CHECK(skeleton.componentsUsed == 2);
  CHECK(skeleton.reason == "1 gaps bridged");
}
