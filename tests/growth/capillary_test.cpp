#include "growth/capillary.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <glm/gtc/quaternion.hpp>
#include <map>

#include "core/hash.h"
#include "support/growth.h"
#include "support/networks.h"

using namespace vasa;

namespace {

constexpr std::uint32_t kLevels = 3;

// All curves of one tree, in the order of their numbers.
std::vector<Capillary> treeOf(const GrowthScene& scene, Sprout sprout, std::uint32_t levels = kLevels) {
  const auto& system = scene.tables.system[scene.sites[sprout.span].system & 0xffu];
  std::vector<Capillary> tree;
  for (std::uint32_t k = 0; k < scene.tables.symbol[system.axiom].treeSize[levels]; ++k)
    tree.push_back(capillaryAt(scene, sprout, levels, k));
  return tree;
}

// Every sprout of a network, those at free ends too.
template <class Visit>
void forEachSprout(const test::GrownNetwork& grown, const Visit& visit) {
  for (std::uint32_t span = 0; span < grown.sites.sites.size(); ++span) {
    for (std::uint32_t k = 0; k < grown.sites.sites[span].sprouts; ++k) visit(Sprout{span, k});
    const std::uint32_t tips = grown.rules.tables.system[grown.sites.sites[span].system & 0xffu].tips;
    for (std::uint32_t end = 0; end < 2; ++end)
      for (std::uint32_t k = 0; (grown.sites.freeEnds[span] >> end & 1u) && k < tips; ++k)
        visit(Sprout{span, shared::kTipSprout | (end ? shared::kLastSprout : 0) | k});
  }
}

float distanceToCurve(const Bezier& curve, vec3 p) {
  float best = 1e9f;
  for (int i = 0; i <= 2000; ++i) best = std::min(best, glm::distance(vec3(curve.at(float(i) / 2000)), p));
  return best;
}

}  // namespace

TEST_CASE("a tree begins inside of its vessel, so that no gap shows at the root") {
  const test::GrownNetwork grown(test::windingNetwork(12, 3));
  const PosedNetwork posed = grown.posed();
  const GrowthScene scene = grown.scene(posed);
  std::size_t roots = 0;
  forEachSprout(grown, [&](Sprout sprout) {
    const Section section = rootSection(scene, sprout);
    const vec4 root = capillaryAt(scene, sprout, 1, 0).curve.b[0];
    const vec3 arm = vec3(root) - section.centre;
    CHECK(std::abs(glm::dot(arm, section.frame.tangent)) <= 1e-6f);  // in the section's plane
    CHECK(glm::length(arm) <=
          0.5f * section.radius + 1e-6f);  // half way to the wall: inside of three quads, too
    if (sprout.number & shared::kTipSprout) CHECK(glm::length(arm) == 0);
    CHECK(root.w <= section.radius);
    ++roots;
  });
  CHECK(roots > 200);
}

TEST_CASE("a branch begins on its parent's axis, no thicker than it, and leaves it smoothly at the end") {
  const test::GrownNetwork grown(test::windingNetwork(6, 9));
  const PosedNetwork posed = grown.posed();
  const GrowthScene scene = grown.scene(posed);
  const std::vector<Capillary> tree = treeOf(scene, {2, 1});  // an oak
  REQUIRE(tree.size() == grown.rules.treeSize(0, kLevels));
  std::map<std::uint32_t, std::size_t> generations;
  for (std::size_t i = 0; i < tree.size(); ++i) {
    ++generations[tree[i].generation];
    if (tree[i].generation == 0) continue;
    std::size_t parent = i;  // stem first: the nearest earlier curve of the generation before
    while (tree[parent].generation + 1 != tree[i].generation) --parent;
    const vec4 start = tree[i].curve.b[0];
    const float scale = glm::length(vec3(tree[parent].curve.b[3] - tree[parent].curve.b[0]));
    CHECK(distanceToCurve(tree[parent].curve, vec3(start)) <= 1e-3f * scale);
    CHECK(start.w < tree[parent].curve.b[0].w);
    CHECK(tree[i].phase > tree[parent].phase);
  }
  CHECK(generations == std::map<std::uint32_t, std::size_t>{{0, 1}, {1, 4}, {2, 4 + 2 * 3}});
}

TEST_CASE("Murray's law in the grown curves: r³ before a branching is the sum of r³ after it") {
  const test::GrownNetwork grown(test::windingNetwork(6, 9));
  const PosedNetwork posed = grown.posed();
  const GrowthScene scene = grown.scene(posed);
  std::size_t branchings = 0;
  forEachSprout(grown, [&](Sprout sprout) {
    const std::vector<Capillary> tree = treeOf(scene, sprout, 2);
    const auto cube = [](float r) { return double(r) * r * r; };
    double sum = 0;
    bool split = false;
    const auto& stem = grown.rules.tables.symbol[tree[0].symbol];
    for (std::size_t i = 1; i < tree.size(); ++i) {
      sum += cube(tree[i].curve.b[0].w);
      split = split || grown.rules.tables.child[stem.firstChild + i - 1].at == 1;
    }
    if (!split) sum += cube(tree[0].curve.b[3].w);
    CHECK(sum == doctest::Approx(cube(tree[0].curve.b[0].w)).epsilon(1e-4));
    ++branchings;
  });
  CHECK(branchings > 100);
}

TEST_CASE("curves get thinner on their way, and everything is finite") {
  const test::GrownNetwork grown(test::windingNetwork(10, 5));
  const PosedNetwork posed = grown.posed();
  const GrowthScene scene = grown.scene(posed);
  forEachSprout(grown, [&](Sprout sprout) {
    for (const Capillary& capillary : treeOf(scene, sprout, 4)) {
      for (int i = 0; i < 4; ++i)
        REQUIRE(std::isfinite(glm::dot(capillary.curve.b[std::size_t(i)], vec4(1))));
      for (std::size_t i = 1; i < 4; ++i) CHECK(capillary.curve.b[i].w <= capillary.curve.b[i - 1].w);
      CHECK(capillary.curve.b[3].w > 0);
      CHECK(capillary.phase < 1);
    }
  });
}

TEST_CASE("an address gives the same curve again, other seeds and addresses give others") {
  const test::GrownNetwork grown(test::windingNetwork(8, 4)), again(test::windingNetwork(8, 4));
  const PosedNetwork posed = grown.posed(), other = again.posed();
  const auto hashOfAll = [&](const GrowthScene& scene) {
    std::uint64_t hash = 0;
    forEachSprout(grown, [&](Sprout sprout) {
      for (const Capillary& capillary : treeOf(scene, sprout))
        hash = hashOf(std::span<const vec4>(capillary.curve.b), hash);
    });
    return hash;
  };
  CHECK(hashOfAll(grown.scene(posed)) == hashOfAll(again.scene(other)));
  CHECK(hashOfAll(grown.scene(posed, 1)) != hashOfAll(grown.scene(posed, 2)));
  CHECK(capillaryAt(grown.scene(posed), {2, 0}, 3, 0).curve.b !=
        capillaryAt(grown.scene(posed), {2, 1}, 3, 0).curve.b);
  // What deeper generations add leaves the others where they are.
  CHECK(capillaryAt(grown.scene(posed), {2, 0}, 2, 1).curve.b ==
        capillaryAt(grown.scene(posed), {2, 0}, 3, 1).curve.b);
}

TEST_CASE("a vessel that is moved takes its capillaries along rigidly") {
  test::GrownNetwork grown(test::windingNetwork(8, 11));
  const PosedNetwork posed = grown.posed();
  const quat turn = glm::angleAxis(0.9f, glm::normalize(vec3(1, 2, -1)));
  const vec3 way(0.3f, -0.1f, 0.7f);
  test::GrownNetwork moved(test::windingNetwork(8, 11));
  for (vec4& p : moved.points) p = vec4(turn * vec3(p) + way, p.w);
  std::vector<vec3> references = restReferences(grown.network);
  for (vec3& reference : references) reference = turn * reference;
  networkFrames(moved.network, moved.points, references, moved.frames);
  const PosedNetwork after = moved.posed();
  float worst = 0;
  forEachSprout(grown, [&](Sprout sprout) {
    const auto before = treeOf(grown.scene(posed), sprout), then = treeOf(moved.scene(after), sprout);
    for (std::size_t i = 0; i < before.size(); ++i)
      for (std::size_t k = 0; k < 4; ++k)
        worst =
            std::max(worst, glm::distance(turn * vec3(before[i].curve.b[k]) + way, vec3(then[i].curve.b[k])));
  });
  CHECK(worst < 2e-4f);
}

TEST_CASE("a vessel that grows wider has thicker and longer capillaries") {
  test::GrownNetwork grown(test::straightVessel(1, 0.004f, 0.004f, 4)),
      wider(test::straightVessel(1, 0.006f, 0.006f, 4));
  const PosedNetwork a = grown.posed(), b = wider.posed();
  const auto narrow = capillaryAt(grown.scene(a), {1, 0}, 1, 0).curve,
             wide = capillaryAt(wider.scene(b), {1, 0}, 1, 0).curve;
  CHECK(wide.b[0].w / narrow.b[0].w == doctest::Approx(1.5f));
  CHECK(glm::distance(vec3(wide.b[0]), vec3(wide.b[1])) ==
        doctest::Approx(1.5f * glm::distance(vec3(narrow.b[0]), vec3(narrow.b[1]))).epsilon(1e-4));
}

TEST_CASE(
    "the last curves of a tree run into the ends of its partner's curves before the last, and change colour on their way") {
  test::GrownNetwork grown(test::windingNetwork(12, 3));
  for (std::uint32_t span = 0; span + 1 < grown.sites.sites.size(); span += 2) {
    grown.sites.sites[span].partner = span + 1;
    grown.sites.sites[span + 1].partner = span;
    for (const std::uint32_t one : {span, span + 1}) grown.sites.sites[one].sprouts = 5;
  }
  grown.joinLevels = kLevels;
  const PosedNetwork posed = grown.posed();
  const GrowthScene scene = grown.scene(posed);
  std::size_t joined = 0;
  for (std::uint32_t k = 0; k < 5; ++k) {
    std::vector<vec3> ends;  // of the partner's curves that have branches
    for (std::uint32_t other = 0; other < 5; ++other)
      for (const Capillary& curve : treeOf(scene, {3, other}))
        if (!curve.leaf) ends.emplace_back(curve.curve.b[3]);
    for (const Capillary& curve : treeOf(scene, {2, k})) {
      CHECK(curve.joined == curve.leaf);
      if (!curve.joined) continue;
      ++joined;
      CHECK(std::ranges::find(ends, vec3(curve.curve.b[3])) != ends.end());
      CHECK(curve.farPhase > 0);
    }
    // Fewer generations end freely, as a picture from afar shows them.
    for (const Capillary& curve : treeOf(scene, {2, k}, kLevels - 1)) CHECK(!curve.joined);
  }
  CHECK(joined > 20);
}

TEST_CASE("no curve leaves the ball and the walls of its site") {
  test::GrownNetwork grown(test::windingNetwork(12, 3));
  for (shared::GrowthSite& site : grown.sites.sites) {
    site.reach = 0.03f;
    site.wall[1] = vec4(0, 1, 0, 0.004f);
  }
  const PosedNetwork posed = grown.posed();
  const GrowthScene scene = grown.scene(posed);
  float over = -1;
  forEachSprout(grown, [&](Sprout sprout) {
    const Section section = rootSection(scene, sprout);
    for (const Capillary& capillary : treeOf(scene, sprout))
      for (std::size_t i = 1; i < 4; ++i) {
        const vec3 arm = vec3(capillary.curve.b[i]) - section.centre;
        over = std::max({over, glm::length(arm) - 0.03f, glm::dot(arm, section.frame.v) - 0.004f});
      }
  });
  CHECK(over < 1e-5f);
}

TEST_CASE("what grows does not depend on how forks cut a network's tubes") {
  const Network network = test::branchingNetwork(21, 2);
  const auto spans = wholeSpans(network);
  const SweepTable table = makeSweepTable(network);
  CHECK(spans.size() == table.spanCount);
  CHECK(spans.size() != table.sweeps.size());
  for (const shared::SweepRecord& span : spans) {
    CHECK(span.from == 0);
    CHECK(span.to == 1);
  }
}
