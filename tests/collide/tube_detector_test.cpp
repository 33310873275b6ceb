#include "collide/tube_detector.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <fstream>

#include "brute_force.h"
#include "collide/closest_tubes.h"
#include "core/hash.h"
#include "core/parallel.h"
#include "random_tubes.h"
#include "support/shared_data.h"
#include "support/tube_network.h"

using namespace vasa;

namespace {

using Pairs = std::vector<TubePair>;

Pairs detect(TubeDetector& detector, std::span<const Bezier> tubes, float margin = 0) {
  detector.update(tubes, margin);
  const auto pairs = detector.detect();
  return {pairs.begin(), pairs.end()};
}

// Pairs that are in one list only must be undecidable: |f - margin| < 1e-7.
void checkEqualButForTies(const Pairs& found, const Pairs& truth, std::span<const Bezier> tubes,
                          double margin = 0) {
  Pairs odd;
  std::set_symmetric_difference(found.begin(), found.end(), truth.begin(), truth.end(),
                                std::back_inserter(odd));
  for (const TubePair& pair : odd)
    CHECK(std::abs(closestOfTubes(tubes[pair.i], tubes[pair.j], 1e-9).f - margin) < 1e-7);
  CHECK(odd.size() <= truth.size() / 20);
}

Pairs readPairs(const std::filesystem::path& path) {
  Pairs pairs;
  std::ifstream file(path);
  TubePair pair;
  for (double f; file >> pair.i >> pair.j >> f;) pairs.push_back(pair);
  return pairs;
}

}  // namespace

TEST_CASE("the published pairs of the 4,030 tubes, both poses, plain and vector arithmetic") {
  VASA_REQUIRE_SHARED_DATA(data);
  const auto list = readTubeList(data / "collision" / "tubes_4030.txt");
  REQUIRE(list.ok());
  const Exclusions exclusions(4030, list->excluded);
  for (const bool scalar : {false, true}) {
    TubeDetector detector(list->poses[0], exclusions, {.scalar = scalar});
    for (std::size_t pose : {0u, 1u}) {
      const Pairs truth = readPairs(data / "collision" / ("pairs_4030_pose" + std::to_string(pose) + ".txt"));
      REQUIRE(truth.size() > 500);
      checkEqualButForTies(detect(detector, list->poses[pose]), truth, list->poses[pose]);
    }
  }
}

TEST_CASE("made-up networks of every size agree with all against all") {
  for (const std::uint32_t tubes : {2u, 3u, 8u, 9u, 17u, 64u, 65u, 300u, 1500u})
    for (const std::uint32_t seed : {1u, 2u}) {
      const TubeList list = test::makeTubeNetwork(tubes, seed);
      const Exclusions exclusions(tubes, list.excluded);
      TubeDetector fast(list.poses[0], exclusions), plain(list.poses[0], exclusions, {.scalar = true});
      // In the last but one a third of the tubes has stayed where it was, in the last all have.
      std::vector<Bezier> partly = list.poses[0];
      for (std::size_t k = 0; k < partly.size(); k += 3) partly[k] = list.poses[1][k];
      for (const auto& pose : {list.poses[0], list.poses[1], partly, partly}) {
        const Pairs found = detect(fast, pose);
        checkEqualButForTies(found, test::intersectingPairsByBruteForce(pose, exclusions, 1e-9), pose);
        CHECK(found == detect(plain, pose));
      }
    }
}

TEST_CASE("a crowd without exclusions, at any scale and place, with and without a margin") {
  for (const float scale : {1e-3f, 1.0f, 1e3f})
    for (const float margin : {0.0f, 0.002f}) {
      auto tubes = test::randomTubes(400, 9, 0.3f, 0.08f, 0.006f);
      for (Bezier& tube : tubes)
        for (vec4& p : tube.b) p = scale * (p + vec4(0.7f, -0.7f, 0.2f, 0));
      const Exclusions none(400);
      const double tolerance = 5e-8 * std::max(scale, 1.0f);
      TubeDetector detector(tubes, none, {.tolerance = tolerance});
      const Pairs found = detect(detector, tubes, scale * margin);
      Pairs truth;
      for (std::uint32_t i = 0; i < 400; ++i)
        for (std::uint32_t j = i + 1; j < 400; ++j)
          if (tubesIntersect(tubes[i], tubes[j], tolerance, double(scale * margin))) truth.push_back({i, j});
      CHECK(truth.size() > 100);
      CHECK(found == truth);
    }
}

TEST_CASE("the same pairs for 1, 2 and 8 threads") {
  const TubeList list = test::makeTubeNetwork(6000, 3);
  const Exclusions exclusions(6000, list.excluded);
  LargeVector<Bezier> shape;
  for (const float share : {0.0f, 0.35f, 1.0f}) {
    list.blend(share, shape);
    std::uint64_t first = 0;
    for (const unsigned threads : {1u, 2u, 8u}) {
      setThreadCount(threads);
      TubeDetector detector(list.poses[0], exclusions);
      LargeVector<Bezier> before = shape;  // a fifth has not yet come to its place
      for (std::size_t k = 0; k < before.size(); k += 5) before[k] = list.poses[0][k];
      detect(detector, before);
      const Pairs pairs = detect(detector, shape);
      CHECK(pairs.size() > 100);
      CHECK(std::ranges::equal(detector.detect(), pairs));  // once more
      const std::uint64_t hash = hashOf<TubePair>(pairs);
      if (threads == 1) first = hash;
      CHECK(hash == first);
    }
  }
  setThreadCount(0);
}

TEST_CASE(
    "pairs and places are those of a detector that sees the shape for the first time, whatever stayed where it was") {
  auto tubes = test::randomTubes(400, 9, 0.3f, 0.08f, 0.006f);
  const Exclusions none(400);
  TubeDetector detector(tubes, none);
  for (int round = 0; round < 8; ++round) {
    const float margin = round == 4 || round == 5 ? 0.002f : 0;
    const bool moves = round % 2 == 1;
    for (std::size_t i = 0; moves && i < tubes.size(); i += 5)
      for (vec4& p : tubes[i].b) p += vec4(0.001f, 0.002f, 0, 0);
    TubeDetector fresh(tubes, none);
    const Pairs pairs = detect(detector, tubes, margin);
    CHECK(detect(fresh, tubes, margin) == pairs);
    CHECK(std::ranges::count(detector.moved(), 1) == (round == 0 ? 400 : moves ? 80 : 0));
    // Nobody asks for these places: the next round's are made anew.
    if (round == 6) continue;
    const auto found = detector.contacts(), truth = fresh.contacts();
    REQUIRE(found.size() == pairs.size());
    REQUIRE(truth.size() == pairs.size());
    CHECK(pairs.size() > 100);
    CHECK(std::ranges::equal(std::as_bytes(found), std::as_bytes(truth)));
  }
}

TEST_CASE("degenerate tubes: points, copies, needles, giants") {
  std::vector<Bezier> tubes = test::randomTubes(100, 4, 0.2f, 0.05f, 0.003f);
  for (std::size_t i = 0; i < 20; ++i)
    for (vec4& p : tubes[i].b) p = tubes[i].b[0];
  for (std::size_t i = 20; i < 40; ++i) tubes[i] = tubes[i + 20];
  for (std::size_t i = 60; i < 70; ++i)
    for (vec4& p : tubes[i].b) p.w = 1e-30f;
  for (vec4& p : tubes[70].b) p.w = 50;
  const Exclusions none(100);
  TubeDetector fast(tubes, none), plain(tubes, none, {.scalar = true});
  const Pairs found = detect(fast, tubes);
  checkEqualButForTies(found, test::intersectingPairsByBruteForce(tubes, none, 1e-9), tubes);
  CHECK(found == detect(plain, tubes));
  CHECK(std::count_if(found.begin(), found.end(), [](TubePair p) { return p.i == 70 || p.j == 70; }) == 99);
}

TEST_CASE("tubes far outside the grid, all in one plane, or far away from where they were at rest") {
  const auto rest = test::randomTubes(2000, 6, 0.3f, 0.05f, 0.003f);
  const Exclusions none(2000);
  TubeDetector fast(rest, none), plain(rest, none, {.scalar = true});
  std::vector<Bezier> scattered = rest, flat = rest, moved = rest;
  for (std::size_t i = 0; i < rest.size(); ++i)
    for (std::size_t k = 0; k < 4; ++k) {
      if (i % 997 == 0) scattered[i].b[k] += vec4(1e3f, -1e3f, 0, 0);
      flat[i].b[k].z = 0.7f;
      moved[i].b[k] += vec4(-40, 0, 40, 0);
    }
  for (const auto& tubes : {scattered, flat, moved}) {
    const Pairs found = detect(fast, tubes);
    CHECK(found.size() > 100);
    checkEqualButForTies(found, test::intersectingPairsByBruteForce(tubes, none, 1e-9), tubes);
    CHECK(found == detect(plain, tubes));
  }
}

TEST_CASE("a tube that is excluded with most others") {
  const auto tubes = test::randomTubes(300, 8, 0.2f, 0.08f, 0.006f);
  std::vector<TubePair> pairs;
  for (std::uint32_t j = 1; j < 300; ++j)
    if (j % 7) pairs.push_back({0, j});
  const Exclusions hub(300, pairs);
  TubeDetector detector(tubes, hub);
  checkEqualButForTies(detect(detector, tubes), test::intersectingPairsByBruteForce(tubes, hub, 1e-9), tubes);
}

TEST_CASE("none and one") {
  const Exclusions nothing(0), single(1);
  TubeDetector none({}, nothing);
  CHECK(detect(none, {}).empty());
  const auto tube = test::randomTubes(1, 1, 1, 1, 1);
  TubeDetector one(tube, single);
  CHECK(detect(one, tube).empty());
}
