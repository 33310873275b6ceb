#include "convert/strokes.h"

#include <doctest/doctest.h>

#include "convert/sources.h"

using namespace vasa;
using namespace vasa::test;

namespace {

struct SkeletonMaker {
  ElementSkeleton skeleton;
  std::uint32_t node(vec3 p) {
    skeleton.nodes.push_back({p, 0});
    return std::uint32_t(skeleton.nodes.size() - 1);
  }
  void branch(std::uint32_t a, std::uint32_t b, float radius) {
    skeleton.branches.push_back(
        {sectionsBetween(skeleton.nodes[a].position, skeleton.nodes[b].position, radius), a, b});
    ++skeleton.nodes[a].valence, ++skeleton.nodes[b].valence;
  }
};

}  // namespace

TEST_CASE("a trunk with two twigs is one strand with two side branches") {
  SkeletonMaker maker;
  const auto a = maker.node({0, 0, 0}), f1 = maker.node({0, 0.05f, 0}), f2 = maker.node({0, 0.1f, 0});
  const auto b = maker.node({0, 0.15f, 0}), t1 = maker.node({0.03f, 0.06f, 0}),
             t2 = maker.node({-0.03f, 0.12f, 0});
  maker.branch(f2, f1, 0.003f), maker.branch(a, f1, 0.003f), maker.branch(b, f2, 0.003f);
  maker.branch(t1, f1, 0.001f), maker.branch(f2, t2, 0.001f);
  StrandGraph graph;
  const auto strands = addSkeleton(graph, maker.skeleton, 7, VesselKind::vein);
  REQUIRE(strands.size() == 3);
  CHECK(lengthOf(graph.strands[strands[0]].sections) == doctest::Approx(0.15f));
  CHECK(graph.strands[strands[0]].element == 7);
  CHECK(graph.strands[strands[0]].kind == VesselKind::vein);
  REQUIRE(graph.joints.size() == 2);
  for (const Joint& joint : graph.joints) {
    CHECK(joint.host == strands[0]);
    CHECK(joint.ends.size() == 1);
  }
}

TEST_CASE("branches that all turn sharply just meet") {
  SkeletonMaker maker;
  const auto centre = maker.node({0, 0, 0});
  for (int k = 0; k < 3; ++k)  // three legs of a tripod, 60 degrees between them
    maker.branch(
        centre,
        maker.node({0.05f * std::cos(2.0944f * float(k)), -0.07f, 0.05f * std::sin(2.0944f * float(k))}),
        0.002f);
  StrandGraph graph;
  CHECK(addSkeleton(graph, maker.skeleton, 0, VesselKind::artery).size() == 3);
  REQUIRE(graph.joints.size() == 1);
  CHECK(!graph.joints[0].host);
  CHECK(graph.joints[0].ends.size() == 3);
}

TEST_CASE("a ring with a stem: no strand hangs on itself, nothing is lost") {
  SkeletonMaker maker;
  const auto stem = maker.node({0, -0.05f, 0}), fork = maker.node({0, 0, 0});
  const auto left = maker.node({-0.03f, 0.03f, 0}), top = maker.node({0, 0.06f, 0}),
             right = maker.node({0.03f, 0.03f, 0});
  maker.branch(stem, fork, 0.002f), maker.branch(fork, left, 0.002f), maker.branch(left, top, 0.002f);
  maker.branch(top, right, 0.002f), maker.branch(right, fork, 0.002f);
  StrandGraph graph;
  float length = 0;
  for (const auto strand : addSkeleton(graph, maker.skeleton, 0, VesselKind::artery))
    length += lengthOf(graph.strands[strand].sections);
  float expected = 0;
  for (const auto& branch : maker.skeleton.branches) expected += lengthOf(branch.sections);
  CHECK(length == doctest::Approx(expected));
  for (const Joint& joint : graph.joints)
    for (const StrandEnd& end : joint.ends) CHECK(joint.host != end.strand);
}

TEST_CASE("a closed ring alone becomes one strand whose ends meet") {
  SkeletonMaker maker;
  std::uint32_t corners[4];
  for (int k = 0; k < 4; ++k)
    corners[k] = maker.node({0.03f * std::cos(1.5708f * float(k)), 0.03f * std::sin(1.5708f * float(k)), 0});
  for (int k = 0; k < 4; ++k) maker.branch(corners[k], corners[(k + 1) % 4], 0.002f);
  StrandGraph graph;
  REQUIRE(addSkeleton(graph, maker.skeleton, 0, VesselKind::artery).size() == 1);
  REQUIRE(graph.joints.size() == 1);
  CHECK(graph.joints[0].ends.size() == 2);
  CHECK(!graph.joints[0].host);
}
