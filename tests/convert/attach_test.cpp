#include "convert/attach.h"

#include <doctest/doctest.h>

#include "convert/sources.h"

using namespace vasa;
using namespace vasa::test;

namespace {

struct Scene {
  StrandGraph graph;
  std::vector<SourceElement> elements;
  std::uint32_t add(const char* label, vec3 a, vec3 b, float radius, VesselKind kind = VesselKind::artery) {
    elements.push_back(source(label, {}, kind));
    return graph.add(
        {sectionsBetween(a, b, radius, std::min(0.002f, radius)), std::uint32_t(elements.size() - 1), kind});
  }
  AttachReport attach(const AttachOptions& options = {}) {
    return attachEnds(graph, elements, 1.7f, options);
  }
  std::uint32_t jointOf(std::uint32_t strand, bool last) const { return graph.jointAt({strand, last}); }
};

}  // namespace

TEST_CASE("an end on a vessel's wall is led to its centre line") {
  Scene scene;
  const auto trunk = scene.add("trunk", {0, 0, 0}, {0, 0.2f, 0}, 0.005f);
  const auto branch = scene.add("branch", {0.0052f, 0.1f, 0}, {0.05f, 0.1f, 0}, 0.002f);
  const auto report = scene.attach();
  CHECK(report.endToSide == 1);
  CHECK(report.endToEnd == 0);
  CHECK(report.gaps.empty());
  const auto joint = scene.jointOf(branch, false);
  REQUIRE(joint != kNone);
  CHECK(scene.graph.joints[joint].host == trunk);
  CHECK(glm::distance(vec3(scene.graph.strands[branch].sections.front()), vec3(0, 0.1f, 0)) < 5e-4f);
  CHECK(scene.jointOf(branch, true) == kNone);
}

TEST_CASE("an end beside its host joins it where their surfaces share a rim, not what is far from there") {
  const auto joins = [](float hostAt, bool shared) {
    Scene scene;
    const auto trunk = scene.add("trunk", {hostAt, 0, 0}, {hostAt, 0.2f, 0}, 0.005f);
    const auto branch = scene.add("branch", {0.008f, 0.1f, 0}, {0.008f, 0.15f, 0}, 0.001f);
    const auto ring = [](float from, float to) {
      return tubeBetween({0.008f, from, 0}, {0.008f, to, 0}, 0.001f, TubeEnds::open, 10);
    };
    if (shared) scene.elements[trunk].element.mesh = ring(0.09f, 0.1f);
    scene.elements[branch].element.mesh = ring(0.1f, 0.15f);
    CHECK(scene.attach().gaps.empty());
    const auto joint = scene.jointOf(branch, false);
    return joint != kNone && scene.graph.joints[joint].host == trunk;
  };
  CHECK(joins(0, true));
  CHECK_FALSE(joins(0, false));
  CHECK_FALSE(joins(-0.1f, true));
}

TEST_CASE("a twig that crosses a branch's foot does not take it from the trunk whose rim it shares") {
  Scene scene;
  const auto trunk = scene.add("trunk", {0, 0, 0}, {0, 0.2f, 0}, 0.005f);
  const auto branch = scene.add("branch", {0.008f, 0.1f, 0}, {0.05f, 0.1f, 0}, 0.002f);
  scene.add("twig", {0.008f, 0.1f, -0.02f}, {0.008f, 0.1f, 0.02f}, 0.0015f);
  const auto ring = [](float from, float to) {
    return tubeBetween({from, 0.1f, 0}, {to, 0.1f, 0}, 0.002f, TubeEnds::open, 10);
  };
  scene.elements[trunk].element.mesh = ring(0.006f, 0.007f);
  scene.elements[branch].element.mesh = ring(0.007f, 0.05f);
  scene.attach();
  const auto joint = scene.jointOf(branch, false);
  REQUIRE(joint != kNone);
  CHECK(scene.graph.joints[joint].host == trunk);
}

TEST_CASE("a rim joins two elements once: the host's own end goes on to what it ends at") {
  Scene scene;
  const auto host = scene.add("host", {0, 0, 0}, {0, 0.05f, 0}, 0.002f);
  const auto branch = scene.add("branch", {0.0018f, 0.0467f, 0}, {0.04f, 0.0467f, 0}, 0.0015f);
  const auto parent = scene.add("parent", {-0.05f, 0.0545f, 0}, {0.05f, 0.0545f, 0}, 0.004f);
  const auto ring = [](float from, float to) {
    return tubeBetween({from, 0.0467f, 0}, {to, 0.0467f, 0}, 0.0015f, TubeEnds::open, 10);
  };
  scene.elements[host].element.mesh = ring(0.001f, 0.002f);
  scene.elements[branch].element.mesh = ring(0.002f, 0.04f);
  scene.attach();
  const auto own = scene.jointOf(branch, false), top = scene.jointOf(host, true);
  REQUIRE(own != kNone);
  REQUIRE(top != kNone);
  CHECK(scene.graph.joints[own].host == host);
  CHECK(scene.graph.joints[top].host == parent);
}

TEST_CASE("surfaces that hang together where neither vessel ends are joined by a short one") {
  for (const bool shared : {true, false}) {
    Scene scene;
    const auto thick = scene.add("thick", {0, 0, 0}, {0, 0.2f, 0}, 0.005f);
    const auto thin = scene.add("thin", {0.009f, 0.01f, 0}, {0.009f, 0.19f, 0}, 0.003f);
    const auto ring = [](float from, float to) {
      return tubeBetween({from, 0.1f, 0}, {to, 0.1f, 0}, 0.002f, TubeEnds::open, 10);
    };
    scene.elements[thick].element.mesh = ring(0.005f, shared ? 0.0055f : 0.0051f);
    scene.elements[thin].element.mesh = ring(0.0055f, 0.006f);
    const auto report = scene.attach();
    CHECK(report.endToSide == (shared ? 2 : 0));
    REQUIRE(scene.graph.strands.size() == (shared ? 3u : 2u));
    if (!shared) continue;
    CHECK(scene.graph.strands[2].element == thin);
    CHECK(scene.graph.joints[scene.jointOf(2, false)].host == thin);
    CHECK(scene.graph.joints[scene.jointOf(2, true)].host == thick);
  }
}

TEST_CASE("an end that runs through its host is cut back; a slanted one keeps its slant") {
  Scene scene;
  scene.add("trunk", {0, 0, 0}, {0, 0.2f, 0}, 0.005f);
  const auto through = scene.add("through", {-0.004f, 0.1f, 0}, {0.05f, 0.1f, 0}, 0.002f);
  const auto slanted = scene.add("slanted", {0.006f, 0.046f, 0}, {0.05f, 0.09f, 0}, 0.002f);
  CHECK(scene.attach().endToSide == 2);
  const auto& sections = scene.graph.strands[through].sections;
  CHECK(std::abs(sections.front().x) < 5e-4f);
  for (std::size_t i = 1; i < sections.size(); ++i) CHECK(sections[i].x > sections[i - 1].x);
  // Its own line comes to the trunk's axis there.
  CHECK(scene.graph.strands[slanted].sections.front().y == doctest::Approx(0.04).epsilon(0.01));
}

TEST_CASE("arteries do not join veins, nor ends what is far away") {
  Scene scene;
  scene.add("trunk", {0, 0, 0}, {0, 0.2f, 0}, 0.005f, VesselKind::vein);
  const auto artery = scene.add("artery", {0.005f, 0.1f, 0}, {0.05f, 0.1f, 0}, 0.002f);
  const auto far = scene.add("far", {0.025f, 0.05f, 0}, {0.05f, 0.05f, 0}, 0.002f, VesselKind::vein);
  scene.attach();
  CHECK(scene.jointOf(artery, false) == kNone);
  CHECK(scene.jointOf(far, false) == kNone);
}

TEST_CASE("elements of no known kind join where they touch, across a gap only by name: one may be a vein") {
  Scene scene;
  scene.add("trunk", {0, 0, 0}, {0, 0.2f, 0}, 0.005f, VesselKind::other);
  const auto touching = scene.add("a", {0.0052f, 0.1f, 0}, {0.05f, 0.1f, 0}, 0.002f, VesselKind::other);
  const auto apart = scene.add("b", {0.0105f, 0.05f, 0}, {0.05f, 0.05f, 0}, 0.002f, VesselKind::other);
  const auto first = scene.add("left carotid 1", {0.2f, 0, 0}, {0.2f, 0.05f, 0}, 0.004f, VesselKind::other);
  scene.add("left carotid 2", {0.2f, 0.058f, 0}, {0.2f, 0.1f, 0}, 0.004f, VesselKind::other);
  scene.attach();
  CHECK(scene.jointOf(touching, false) != kNone);
  CHECK(scene.jointOf(apart, false) == kNone);
  CHECK(scene.jointOf(first, true) != kNone);
}

TEST_CASE("ends that face one another meet halfway, overlapping ones are cut back") {
  Scene scene;
  const auto a = scene.add("a", {0, 0, 0}, {0, 0.05f, 0}, 0.004f),
             b = scene.add("b", {0, 0.052f, 0}, {0, 0.1f, 0}, 0.004f);
  const auto c = scene.add("c", {0, 0.097f, 0}, {0, 0.15f, 0}, 0.004f);
  const auto report = scene.attach();
  CHECK(report.endToEnd == 2);
  CHECK(scene.jointOf(a, true) == scene.jointOf(b, false));
  CHECK(scene.graph.strands[a].sections.back().y == doctest::Approx(0.051f));
  CHECK(scene.jointOf(b, true) == scene.jointOf(c, false));
  for (const std::uint32_t strand : {a, b, c}) {
    const auto& sections = scene.graph.strands[strand].sections;
    for (std::size_t i = 1; i < sections.size(); ++i) CHECK(sections[i].y > sections[i - 1].y);
  }
}

TEST_CASE("three ends meet in one joint, as the aorta and the common iliacs") {
  Scene scene;
  const auto aorta = scene.add("aorta", {0, 0.2f, 0}, {0, 0, 0}, 0.008f);
  const auto left = scene.add("left", {0.004f, -0.002f, 0}, {0.05f, -0.06f, 0}, 0.005f);
  const auto right = scene.add("right", {-0.004f, -0.002f, 0}, {-0.05f, -0.06f, 0}, 0.005f);
  scene.attach();
  const auto joint = scene.jointOf(aorta, true);
  REQUIRE(joint != kNone);
  CHECK(scene.jointOf(left, false) == joint);
  CHECK(scene.jointOf(right, false) == joint);
}

TEST_CASE("a long gap is bridged only where the names continue, and is told") {
  for (const bool sameName : {true, false}) {
    Scene scene;
    const auto low = scene.add("left common carotid artery", {0, 0, 0}, {0, 0.1f, 0}, 0.003f);
    const auto high = scene.add(sameName ? "left internal carotid artery" : "left vertebral artery",
                                {0.01f, 0.16f, 0}, {0.012f, 0.25f, 0}, 0.002f);
    const auto report = scene.attach();
    CHECK((scene.jointOf(low, true) != kNone) == sameName);
    CHECK((scene.jointOf(high, false) != kNone) == sameName);
    REQUIRE(report.gaps.size() == std::size_t(sameName));
    if (!sameName) continue;
    CHECK(report.gaps[0].bridge);
    CHECK(report.gaps[0].length == doctest::Approx(0.0608f).epsilon(0.01));
    CHECK(scene.attach({.bridges = false}).gaps.empty());
  }
}

TEST_CASE("a twig does not turn back onto its own trunk") {
  Scene scene;
  const auto trunk = scene.add("trunk", {0, 0, 0}, {0, 0.2f, 0}, 0.005f);
  Sections hook;
  for (int i = 0; i <= 20; ++i) {
    const float angle = kPi * float(i) / 20;
    hook.push_back(vec4(0.005f + 0.02f * std::sin(angle), 0.1f - 0.004f * std::cos(angle), 0, 0.001f));
  }
  scene.elements.push_back(source("twig", {}));
  const auto twig = scene.graph.add({hook, 1, VesselKind::artery});
  scene.attach();
  CHECK((scene.jointOf(twig, false) == kNone) != (scene.jointOf(twig, true) == kNone));
  CHECK(scene.graph.strands[trunk].startJoint == kNone);
}

TEST_CASE("the lungs' arteries and the aorta's do not join") {
  Scene scene;
  scene.add("arch of aorta", {0, 0, 0}, {0, 0.2f, 0}, 0.01f);
  const auto lung = scene.add("left pulmonary artery", {0.01f, 0.1f, 0}, {0.1f, 0.1f, 0}, 0.006f);
  scene.attach();
  CHECK(scene.jointOf(lung, false) == kNone);
}
