#include "convert/element.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstring>
#include <limits>

#include "curve/fit.h"
#include "support/tubes.h"

using namespace vasa;
using test::TubeEnds;

namespace {

float lengthOf(const ElementBranch& branch) {
  float length = 0;
  for (std::size_t i = 1; i < branch.sections.size(); ++i)
    length += glm::distance(vec3(branch.sections[i]), vec3(branch.sections[i - 1]));
  return length;
}

// What every skeleton promises, however bad the mesh was.
void checkPromises(const ElementSkeleton& skeleton) {
  std::vector<std::uint32_t> valence(skeleton.nodes.size(), 0);
  for (const ElementBranch& branch : skeleton.branches) {
    REQUIRE(branch.sections.size() >= 2);
    REQUIRE(branch.startNode < skeleton.nodes.size());
    REQUIRE(branch.endNode < skeleton.nodes.size());
    ++valence[branch.startNode], ++valence[branch.endNode];
    CHECK(vec3(branch.sections.front()) == skeleton.nodes[branch.startNode].position);
    CHECK(vec3(branch.sections.back()) == skeleton.nodes[branch.endNode].position);
    for (std::size_t i = 0; i < branch.sections.size(); ++i) {
      for (int k = 0; k < 4; ++k) CHECK(std::isfinite(branch.sections[i][k]));
      CHECK(branch.sections[i].w > 0);
      if (i > 0) CHECK(vec3(branch.sections[i]) != vec3(branch.sections[i - 1]));
    }
  }
  for (std::size_t i = 0; i < valence.size(); ++i) CHECK(valence[i] == skeleton.nodes[i].valence);
  CHECK(skeleton.componentsUsed <= skeleton.componentsTotal);
  CHECK(skeleton.method.empty() == skeleton.branches.empty());
}

const ElementOptions kDefault;

}  // namespace

TEST_CASE("a straight tube, open and closed, in order and shuffled: its axis, radius and whole length") {
  for (const TubeEnds ends : {TubeEnds::open, TubeEnds::flat})
    for (const bool mixed : {false, true})
      for (const bool rings : {false, true}) {
        TriangleMesh mesh = test::straightTube(0.1f, 0.005f, ends);
        if (mixed) mesh = test::shuffled(mesh, 5);
        ElementOptions options;
        options.useRings = rings;
        const ElementSkeleton skeleton = skeletonise(mesh, options);
        checkPromises(skeleton);
        REQUIRE(skeleton.branches.size() == 1);
        CHECK(skeleton.reason.empty());
        // A 16-gon's area is 0.974 of its circle's.
        for (const vec4& s : skeleton.branches[0].sections) {
          CHECK(glm::length(vec2(s)) < 5e-5f);
          CHECK(s.w == doctest::Approx(0.005 * std::sqrt(0.9745)).epsilon(0.01));
        }
        CHECK(lengthOf(skeleton.branches[0]) == doctest::Approx(0.1).epsilon(0.01));
      }
}

TEST_CASE("a bent and tapering tube") {
  const auto axis = [](float t) { return vec3(0.06f * std::sin(t * 2), 0.06f * std::cos(t * 2), 0.02f * t); };
  const auto radius = [](float t) { return 0.008f - 0.005f * t; };
  const ElementSkeleton skeleton = skeletonise(test::shuffled(test::tube(axis, radius, 60, 20), 9), kDefault);
  checkPromises(skeleton);
  REQUIRE(skeleton.branches.size() == 1);
  for (const vec4& s : skeleton.branches[0].sections) {
    float best = 1, expected = 0;
    for (int i = 0; i <= 400; ++i) {
      const float t = float(i) / 400, d = glm::distance(vec3(s), axis(t));
      if (d < best) best = d, expected = radius(t);
    }
    const float fromEnd = std::min(glm::distance(vec3(s), axis(0)), glm::distance(vec3(s), axis(1)));
    const bool end = fromEnd < s.w;
    CHECK(best < (end ? 0.2f * s.w : 4e-4f));
    CHECK(s.w == doctest::Approx(expected).epsilon(0.06));
  }
  CHECK(lengthOf(skeleton.branches[0]) == doctest::Approx(0.1217).epsilon(0.03));
}

TEST_CASE("a Y from a scan: three branches that meet") {
  const vec3 fork(0, 0.05f, 0);
  const auto y = test::isosurface(
      [&](vec3 p) {
        return std::min({test::capsuleDistance(p, {0, 0, 0}, fork, 0.008f),
                         test::capsuleDistance(p, fork, {0.04f, 0.1f, 0}, 0.006f),
                         test::capsuleDistance(p, fork, {-0.04f, 0.1f, 0}, 0.006f)});
      },
      vec3(-0.06f, -0.02f, -0.02f), vec3(0.06f, 0.12f, 0.02f), 0.0017f);
  const ElementSkeleton skeleton = skeletonise(y, kDefault);
  checkPromises(skeleton);
  REQUIRE(skeleton.branches.size() == 3);
  REQUIRE(skeleton.nodes.size() == 4);
  const auto node = std::find_if(skeleton.nodes.begin(), skeleton.nodes.end(),
                                 [](const ElementNode& n) { return n.valence == 3; });
  REQUIRE(node != skeleton.nodes.end());
  CHECK(glm::distance(node->position, fork) < 0.004f);
  for (const ElementBranch& branch : skeleton.branches) {
    std::vector<float> radii;
    for (const vec4& s : branch.sections) radii.push_back(s.w);
    std::nth_element(radii.begin(), radii.begin() + std::ptrdiff_t(radii.size() / 2), radii.end());
    const float radius = radii[radii.size() / 2];
    CHECK((std::abs(radius - 0.008f) < 4e-4f || std::abs(radius - 0.006f) < 4e-4f));
  }
}

TEST_CASE("a trunk that is cut a little beyond its last branch keeps its end") {
  for (const vec2 girth : {vec2(0.006f, 0.02f), vec2(0.012f, 0.04f)}) {
    const float radius = girth.x, stub = girth.y;
    CAPTURE(stub);
    const vec3 fork(0, 0.1f, 0);
    const auto trunk = test::isosurface(
        [&](vec3 p) {
          const float uncut = std::min(test::capsuleDistance(p, {0, -0.05f, 0}, {0, 0.2f, 0}, radius),
                                       test::capsuleDistance(p, fork, {0.05f, 0.14f, 0}, 0.004f));
          return std::max({uncut, p.y - (p.x < 0.015f ? fork.y + stub : 1), -p.y});
        },
        vec3(-0.02f, -0.01f, -0.02f), vec3(0.06f, 0.16f, 0.02f), 0.0013f);
    const ElementSkeleton skeleton = skeletonise(trunk, kDefault);
    checkPromises(skeleton);
    REQUIRE(skeleton.branches.size() == 3);
    const auto isEnd = [&](const ElementNode& node) {
      return node.valence == 1 && glm::distance(node.position, fork + vec3(0, stub, 0)) < radius;
    };
    CHECK(std::ranges::any_of(skeleton.nodes, isEnd));
  }
}

TEST_CASE("an arch of the aorta has three branches that leave it one after the other") {
  constexpr float kBend = 0.03f, kRadius = 0.009f;
  const auto arch = test::isosurface(
      [&](vec3 p) {
        const float ring = glm::length(vec2(glm::length(vec2(p)) - kBend, p.z)) - kRadius;
        float distance = p.y > 0 ? ring : 1;
        distance = std::min({distance, test::capsuleDistance(p, {-kBend, 0, 0}, {-kBend, -0.05f, 0}, kRadius),
                             test::capsuleDistance(p, {kBend, 0, 0}, {kBend, -0.1f, 0}, kRadius)});
        for (const float angle : {0.785f, 1.571f, 2.356f}) {
          const vec3 root = kBend * vec3(std::cos(angle), std::sin(angle), 0);
          distance = std::min(distance, test::capsuleDistance(p, root, root + vec3(0, 0.05f, 0), 0.004f));
        }
        return distance;
      },
      vec3(-0.05f, -0.12f, -0.015f), vec3(0.05f, 0.09f, 0.015f), 0.0013f);
  const ElementSkeleton skeleton = skeletonise(arch, kDefault);
  checkPromises(skeleton);
  CHECK(std::ranges::count(skeleton.nodes, 3u, &ElementNode::valence) == 3);
  CHECK(skeleton.branches.size() == 7);
}

TEST_CASE("a ring of vessels keeps its loop") {
  TriangleMesh torus =
      test::tube([](float t) { return 0.05f * vec3(std::cos(2 * kPi * t), std::sin(2 * kPi * t), 0); },
                 [](float) { return 0.006f; }, 64, 16, TubeEnds::open);
  for (uvec3& t : torus.triangles)
    for (int k = 0; k < 3; ++k) t[k] %= 64 * 16;
  const ElementSkeleton skeleton = skeletonise(torus, kDefault);
  checkPromises(skeleton);
  REQUIRE(!skeleton.branches.empty());
  float length = 0;
  for (const ElementBranch& branch : skeleton.branches) length += lengthOf(branch);
  CHECK(length == doctest::Approx(2 * kPi * 0.05).epsilon(0.06));
}

TEST_CASE("debris is told, two tubes give two pieces, tears do not fork") {
  TriangleMesh mesh = test::straightTube(0.1f, 0.005f);
  TriangleMesh far = test::straightTube(0.05f, 0.004f);
  for (vec3& p : far.positions) p.x += 0.1f;
  test::append(mesh, far);
  TriangleMesh speck = test::straightTube(0.0004f, 0.0001f);
  for (vec3& p : speck.positions) p.y += 0.1f;
  test::append(mesh, speck);
  std::mt19937 random(4);
  std::erase_if(mesh.triangles, [&](const uvec3&) { return random() % 25 == 0; });
  const ElementSkeleton skeleton = skeletonise(mesh, kDefault);
  checkPromises(skeleton);
  CHECK(skeleton.branches.size() == 2);
  CHECK(skeleton.componentsUsed == 2);
  CHECK(skeleton.reason.find("too small") != std::string::npos);
}

TEST_CASE("what is no tube gives no branch and a reason, and nothing crashes") {
  CHECK(skeletonise({}, kDefault).reason == "no triangles");
  TriangleMesh bad;
  bad.positions = {{0, 0, 0}, {1, 0, 0}, {std::numeric_limits<float>::quiet_NaN(), 0, 0}, {2, 0, 0}};
  bad.triangles = {{0, 1, 2}, {0, 0, 1}};
  CHECK(skeletonise(bad, kDefault).reason == "no usable triangle");
  bad.triangles = {{0, 1, 3}};  // a sliver without area
  const ElementSkeleton sliver = skeletonise(bad, kDefault);
  checkPromises(sliver);
  CHECK((!sliver.branches.empty() || !sliver.reason.empty()));
}

TEST_CASE("random soups: promises hold, and the answer is the same every time") {
  for (unsigned seed = 1; seed <= 30; ++seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> value(-0.05f, 0.05f);
    TriangleMesh soup = test::straightTube(0.1f, 0.005f);
    if (seed % 3 == 0) soup = {};
    const auto count = std::uint32_t(soup.positions.size());
    for (int i = 0; i < 40; ++i) soup.positions.push_back({value(random), value(random), value(random)});
    for (int i = 0; i < 60; ++i) {
      const auto pick = [&] { return std::uint32_t(random() % (count + 40)); };
      soup.triangles.push_back({pick(), pick(), pick()});
    }
    const auto fix = [&](uvec3& t) {
      for (int k = 0; k < 3; ++k) t[k] %= std::uint32_t(soup.positions.size());
    };
    for (uvec3& t : soup.triangles) fix(t);
    const ElementSkeleton a = skeletonise(soup, kDefault), b = skeletonise(soup, kDefault);
    checkPromises(a);
    REQUIRE(a.branches.size() == b.branches.size());
    for (std::size_t i = 0; i < a.branches.size(); ++i) {
      REQUIRE(a.branches[i].sections.size() == b.branches[i].sections.size());
      CHECK(std::memcmp(a.branches[i].sections.data(), b.branches[i].sections.data(),
                        a.branches[i].sections.size() * sizeof(vec4)) == 0);
    }
  }
}
