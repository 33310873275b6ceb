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
std::vector<Capillary> treeOf(const GrowthScene& scene, std::uint32_t bed, BedSide side,
                              std::uint32_t levels = kLevels) {
  const auto& system = scene.tables.system[scene.beds[bed].system];
  std::vector<Capillary> tree;
  for (std::uint32_t k = 0; k < scene.tables.symbol[system.axiom].treeSize[levels]; ++k)
    tree.push_back(capillaryAt(scene, bed, side, levels, k));
  return tree;
}

// Every tree.
template <class Visit>
void forEachTree(const test::GrownNetwork& grown, const Visit& visit) {
  for (std::uint32_t bed = 0; bed < grown.beds.beds.size(); ++bed)
    for (const BedSide side : kBedSides)
      if (grown.beds.beds[bed].stem[std::size_t(side)].from != shared::kNoStem) visit(bed, side);
}

float distanceToCurve(const Bezier& curve, vec3 p) {
  float best = 1e9f;
  for (int i = 0; i <= 2000; ++i) best = std::min(best, glm::distance(vec3(curve.at(float(i) / 2000)), p));
  return best;
}

}  // namespace

TEST_CASE(
    "a stem begins on the axis of its vessel, or where that of the bed before ends, and goes straight on") {
  const test::GrownNetwork grown(test::windingNetwork(12, 3));
  const PosedNetwork posed = grown.posed();
  const GrowthScene scene = grown.scene(posed);
  std::size_t roots = 0, chained = 0;
  forEachTree(grown, [&](std::uint32_t bed, BedSide side) {
    const shared::GrowthStem& stem = scene.beds[bed].stem[std::size_t(side)];
    const Bezier curve = capillaryAt(scene, bed, side, 1, 0).curve;
    if (stem.from == shared::kFromVessel) {
      const Section section = sectionOn(posed, scene.spans[stem.span], stem.t);
      CHECK(glm::distance(vec3(curve.b[0]), section.centre) <= 1e-6f);
      ++roots;
    } else {
      const Bezier before = capillaryAt(scene, stem.from, side, 1, 0).curve;
      CHECK(glm::distance(curve.b[0], vec4(vec3(before.b[3]), stem.radius)) <= 1e-6f);
      const vec3 end = glm::normalize(vec3(before.derivative(1))),
                 way = glm::normalize(vec3(curve.b[3] - curve.b[0]));
      CHECK(glm::dot(glm::normalize(vec3(curve.derivative(0))), end) >= glm::dot(way, end) - 1e-5f);
      ++chained;
    }
  });
  CHECK(roots > 100);
  CHECK(chained > 20);
}

TEST_CASE("a branch begins on its parent's axis, no thicker than it, and leaves it smoothly at the end") {
  const test::GrownNetwork grown(test::windingNetwork(6, 9));
  const PosedNetwork posed = grown.posed();
  const GrowthScene scene = grown.scene(posed);
  const std::vector<Capillary> tree = treeOf(scene, 2, BedSide::artery);  // an oak
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

TEST_CASE("a sparse tree has every second of the last curves, and these cover as much") {
  const test::GrownNetwork grown(test::windingNetwork(6, 9));
  const PosedNetwork posed = grown.posed();
  const GrowthScene scene = grown.scene(posed);
  std::size_t trees = 0;
  forEachTree(grown, [&](std::uint32_t bed, BedSide side) {
    const std::uint32_t system = scene.beds[bed].system;
    const std::vector<Capillary> whole = treeOf(scene, bed, side);
    const auto area = [](const Capillary& one) {
      return double(one.curve.b[0].w + one.curve.b[3].w) *
             glm::distance(vec3(one.curve.b[0]), vec3(one.curve.b[3]));
    };
    double all = 0, some = 0;
    for (const Capillary& one : whole) all += area(one);
    const std::uint32_t size = grown.rules.treeSize(system, kLevels, true);
    for (std::uint32_t k = 0; k < size; ++k) {
      const Capillary one = capillaryAt(scene, bed, side, kLevels, k, true);
      some += area(one);
      const auto same = std::ranges::find_if(whole, [&](const Capillary& other) {
        return vec3(other.curve.b[1]) == vec3(one.curve.b[1]) && other.generation == one.generation;
      });
      REQUIRE(same != whole.end());
      CHECK((one.generation + 1 == kLevels) == (one.curve.b[0].w > same->curve.b[0].w));
    }
    CHECK(size < 0.8 * double(whole.size()));
    CHECK(some == doctest::Approx(all).epsilon(0.3));
    ++trees;
  });
  CHECK(trees > 20);
}

TEST_CASE("Murray's law in the grown curves: r³ before a branching is the sum of r³ after it") {
  const test::GrownNetwork grown(test::windingNetwork(6, 9));
  const PosedNetwork posed = grown.posed();
  const GrowthScene scene = grown.scene(posed);
  std::size_t branchings = 0;
  forEachTree(grown, [&](std::uint32_t bed, BedSide side) {
    const std::vector<Capillary> tree = treeOf(scene, bed, side, 2);
    const auto cube = [](float r) { return double(r) * r * r; };
    double sum = 0;
    bool split = false;
    const auto& stem = grown.rules.tables.symbol[tree[0].symbol];
    for (std::size_t i = 1; i < tree.size(); ++i) {
      sum += cube(tree[i].curve.b[0].w);
      split = split || grown.rules.tables.child[stem.firstChild + i - 1].at == 1;
    }
    const double own = cube(scene.beds[bed].stem[std::size_t(side)].own);
    if (!split) sum += own * cube(stem.taper);
    CHECK(sum == doctest::Approx(own).epsilon(1e-4));
    ++branchings;
  });
  CHECK(branchings > 50);
}

TEST_CASE("curves get thinner on their way, and everything is finite") {
  const test::GrownNetwork grown(test::windingNetwork(10, 5));
  const PosedNetwork posed = grown.posed();
  const GrowthScene scene = grown.scene(posed);
  forEachTree(grown, [&](std::uint32_t bed, BedSide side) {
    for (const Capillary& capillary : treeOf(scene, bed, side, 4)) {
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
    forEachTree(grown, [&](std::uint32_t bed, BedSide side) {
      for (const Capillary& capillary : treeOf(scene, bed, side))
        hash = hashOf(std::span<const vec4>(capillary.curve.b), hash);
    });
    return hash;
  };
  CHECK(hashOfAll(grown.scene(posed)) == hashOfAll(again.scene(other)));
  CHECK(hashOfAll(grown.scene(posed, 1)) != hashOfAll(grown.scene(posed, 2)));
  CHECK(capillaryAt(grown.scene(posed), 2, BedSide::artery, 3, 1).curve.b !=
        capillaryAt(grown.scene(posed), 2, BedSide::vein, 3, 1).curve.b);
  // What deeper generations add leaves those before the last where they are.
  CHECK(capillaryAt(grown.scene(posed), 2, BedSide::artery, 3, 1).curve.b ==
        capillaryAt(grown.scene(posed), 2, BedSide::artery, 4, 1).curve.b);
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
  forEachTree(grown, [&](std::uint32_t bed, BedSide side) {
    const auto before = treeOf(grown.scene(posed), bed, side), then = treeOf(moved.scene(after), bed, side);
    for (std::size_t i = 0; i < before.size(); ++i)
      for (std::size_t k = 0; k < 4; ++k)
        worst =
            std::max(worst, glm::distance(turn * vec3(before[i].curve.b[k]) + way, vec3(then[i].curve.b[k])));
  });
  CHECK(worst < 2e-4f);
}

TEST_CASE(
    "every last curve of an artery's tree ends where one of the vein's does, and both have the bed's colour") {
  const test::GrownNetwork grown(test::windingNetwork(12, 3));
  const PosedNetwork posed = grown.posed();
  const GrowthScene scene = grown.scene(posed);
  std::size_t met = 0;
  for (std::uint32_t bed = 0; bed < grown.beds.beds.size(); ++bed)
    for (const std::uint32_t levels : {2u, 3u}) {
      if (scene.beds[bed].stem[1].from == shared::kNoStem) continue;
      const auto artery = treeOf(scene, bed, BedSide::artery, levels),
                 vein = treeOf(scene, bed, BedSide::vein, levels);
      for (std::size_t k = 0; k < artery.size(); ++k) {
        CHECK(artery[k].leaf == vein[k].leaf);
        if (!artery[k].leaf) continue;
        CHECK(vec3(artery[k].curve.b[3]) == vec3(vein[k].curve.b[3]));
        CHECK(artery[k].lastPhase == 1);
        CHECK(vein[k].lastPhase == 1);
        ++met;
      }
    }
  CHECK(met > 500);
}

TEST_CASE("branches fill their bed: every eighth of its box has ends, and no end lies beyond it") {
  test::GrownNetwork grown(test::windingNetwork(12, 3));
  for (shared::GrowthBed& bed : grown.beds.beds) {
    bed.system = 0;
    for (vec4& wall : bed.wall) wall = vec4(0);
  }
  const PosedNetwork posed = grown.posed();
  const GrowthScene scene = grown.scene(posed);
  for (std::uint32_t number = 0; number < grown.beds.beds.size(); number += 5) {
    const shared::GrowthBed& bed = scene.beds[number];
    const Section section = sectionOn(posed, scene.spans[bed.span], bed.t);
    const mat3 inverse = glm::transpose(mat3(section.frame.u, section.frame.v, section.frame.tangent));
    std::array<int, 8> ends{};
    for (const Capillary& curve : treeOf(scene, number, BedSide::artery, 5)) {
      if (!curve.leaf) continue;
      const vec3 p = inverse * (vec3(curve.curve.b[3]) - section.centre) - bed.centre;
      std::size_t corner = 0;
      for (int a = 0; a < 3; ++a) {
        const float own = glm::dot(vec3(bed.side[a]), p) / bed.side[a].w - bed.middle[a];
        CHECK(std::abs(own) <= 1);
        corner += own > 0 ? 1u << a : 0u;
      }
      ++ends[corner];
    }
    for (const int count : ends) CHECK(count > 0);
  }
}

TEST_CASE("no curve that begins in a bed's room crosses its walls") {
  test::GrownNetwork grown(test::windingNetwork(12, 3));
  for (shared::GrowthBed& bed : grown.beds.beds) {
    bed.wall[1] = vec4(0, 1, 0, 0.004f);
    bed.wall[3] = vec4(glm::normalize(vec3(1, -1, 1)), 0.006f);
    for (shared::GrowthStem& stem : bed.stem) stem.end = vec3(0);
  }
  const PosedNetwork posed = grown.posed();
  const GrowthScene scene = grown.scene(posed);
  float over = -1;
  forEachTree(grown, [&](std::uint32_t number, BedSide side) {
    const shared::GrowthBed& bed = scene.beds[number];
    const Section section = sectionOn(posed, scene.spans[bed.span], bed.t);
    const mat3 axes(section.frame.u, section.frame.v, section.frame.tangent);
    const vec3 centre = section.centre + axes * bed.centre;
    for (const Capillary& capillary : treeOf(scene, number, side))
      for (std::size_t i = 1; i < 4 && capillary.generation > 0; ++i)
        for (const vec4& wall : bed.wall)
          over = std::max(over, glm::dot(axes * vec3(wall), vec3(capillary.curve.b[i]) - centre) - wall.w);
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
