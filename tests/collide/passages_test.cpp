#include "collide/passages.h"

#include <doctest/doctest.h>

#include <numbers>

#include "collide/random_tubes.h"
#include "core/parallel.h"

using namespace vasa;
using glm::dvec3;

namespace {

std::vector<Passage> passagesOf(std::span<const Bezier> before, std::span<const Bezier> after,
                                const Exclusions& exclusions) {
  PassageSearch search(before, exclusions);
  const std::span<const Passage> found = search.find(before, after);
  return {found.begin(), found.end()};
}

std::vector<Passage> passagesOf(std::span<const Bezier> before, std::span<const Bezier> after) {
  return passagesOf(before, after, Exclusions(std::uint32_t(before.size())));
}

std::vector<Bezier> moved(std::vector<Bezier> tubes, std::size_t which, vec3 by) {
  for (vec4& point : tubes[which].b) point += vec4(by, 0);
  return tubes;
}

Bezier between(const Bezier& before, const Bezier& after, float share) {
  Bezier tube;
  for (std::size_t k = 0; k < 4; ++k) tube.b[k] = glm::mix(before.b[k], after.b[k], share);
  return tube;
}

// The Gauss integral of two curves, by 16 chords each: the solid angles of all pairs (Klenin, Langowski
// 2000). It goes over into another steadily while curves move, and jumps by one where they pass through one
// another.
double linking(const Bezier& a, const Bezier& b) {
  constexpr int kChords = 16;
  const auto asine = [](double x) { return std::asin(std::clamp(x, -1.0, 1.0)); };
  double sum = 0;
  for (int k = 0; k < kChords; ++k)
    for (int l = 0; l < kChords; ++l) {
      const dvec3 p1(vec3(a.at(float(k) / kChords))), p2(vec3(a.at(float(k + 1) / kChords))),
          p3(vec3(b.at(float(l) / kChords))), p4(vec3(b.at(float(l + 1) / kChords)));
      const dvec3 n1 = glm::normalize(glm::cross(p3 - p1, p4 - p1)),
                  n2 = glm::normalize(glm::cross(p4 - p1, p4 - p2)),
                  n3 = glm::normalize(glm::cross(p4 - p2, p3 - p2)),
                  n4 = glm::normalize(glm::cross(p3 - p2, p3 - p1));
      const double angle = asine(glm::dot(n1, n2)) + asine(glm::dot(n2, n3)) + asine(glm::dot(n3, n4)) +
                           asine(glm::dot(n4, n1));
      const double side = glm::dot(glm::cross(p4 - p3, p2 - p1), p3 - p1);
      sum += side > 0 ? angle : -angle;
    }
  return sum / (4 * std::numbers::pi);
}

}  // namespace

TEST_CASE("a line that goes down through another passes it once, at the place and the time") {
  const std::vector<Bezier> before{test::straight({-1, 0, 0}, {1, 0, 0}, 0.01f),
                                   test::straight({0.5f, 1, -1}, {0.5f, 1, 3}, 0.01f)};
  const std::vector<Passage> found = passagesOf(before, moved(before, 1, {0, -4, 0}));
  REQUIRE(found.size() == 1);
  CHECK(found[0].i == 0);
  CHECK(found[0].j == 1);
  CHECK(found[0].s == doctest::Approx(0.75));
  CHECK(found[0].t == doctest::Approx(0.25));
  CHECK(found[0].time == doctest::Approx(0.25));
  CHECK(passagesOf(before, moved(before, 1, {0, -0.9f, 0})).empty());  // comes near and no farther
  CHECK(passagesOf(before, moved(before, 1, {0, 0, 4})).empty());      // beside it
  CHECK(passagesOf(before, moved(before, 1, {1, -4, 0})).size() == 1);
  CHECK(passagesOf(before, moved(before, 1, {4, -4, 0})).empty());  // around its end
  const TubePair pair{0, 1};
  CHECK(passagesOf(before, moved(before, 1, {0, -4, 0}), Exclusions(2, std::span(&pair, 1))).empty());
}

TEST_CASE("what turns together passes nothing, however far it goes") {
  const std::vector<Bezier> before = test::randomTubes(200, 7, 0.1f, 0.03f, 0.002f);
  for (const float degrees : {10.0f, 90.0f, 170.0f}) {
    CAPTURE(degrees);
    const quat turn = glm::angleAxis(glm::radians(degrees), glm::normalize(vec3(1, 2, -1)));
    std::vector<Bezier> after = before;
    for (Bezier& tube : after)
      for (vec4& point : tube.b) point = vec4(turn * vec3(point) + vec3(0.3f, 0, 1), point.w);
    CHECK(passagesOf(before, after).empty());
  }
}

TEST_CASE("a bow goes through a line where both its legs do, or around it") {
  Bezier bow{{vec4(-1, 1, 0, 0.01f), vec4(-1, -2, 0, 0.01f), vec4(1, -2, 0, 0.01f), vec4(1, 1, 0, 0.01f)}};
  const std::vector<Bezier> before{test::straight({0, -0.5f, -3}, {0, -0.5f, 3}, 0.01f), bow};
  CHECK(passagesOf(before, moved(before, 1, {0, -1, 0})).empty());  // its foot is below the line already
  CHECK(passagesOf(before, moved(before, 1, {0, 1, 0})).size() == 1);
  CHECK(passagesOf(before, moved(before, 1, {3, 0, 0})).size() == 1);  // one leg
  const std::vector<Bezier> above = moved(before, 1, {-3, 0, 0});
  CHECK(passagesOf(above, moved(above, 1, {6, 0, 0})).size() == 2);  // both, one after the other
}

TEST_CASE("passages are where the Gauss integral of two moving curves jumps") {
  constexpr int kTimes = 200;
  const std::vector<Bezier> before = test::randomTubes(900, 3, 0.02f, 0.05f, 0.001f),
                            after = test::randomTubes(900, 4, 0.02f, 0.05f, 0.001f);
  int passages = 0, compared = 0;
  for (std::size_t k = 0; k + 1 < before.size(); k += 2) {
    CAPTURE(k);
    const std::vector<Passage> found =
        passagesOf(std::span(before).subspan(k, 2), std::span(after).subspan(k, 2));
    // Close to an end the integral goes over in a short while, and two passages of opposite sign at once do
    // not show.
    const auto isPlain = [&](const Passage& passage) {
      return std::min({passage.s, passage.t, 1 - passage.s, 1 - passage.t}) > 0.1f &&
             std::ranges::count_if(found, [&](const Passage& other) {
               return std::abs(other.time - passage.time) < 3.0f / kTimes;
             }) == 1;
    };
    if (!std::ranges::all_of(found, isPlain)) continue;
    std::vector<float> jumps;
    double last = linking(before[k], before[k + 1]);
    for (int time = 1; time <= kTimes; ++time) {
      const float share = float(time) / kTimes;
      const double now =
          linking(between(before[k], after[k], share), between(before[k + 1], after[k + 1], share));
      if (std::abs(now - last) > 0.5) jumps.push_back(share);
      last = now;
    }
    CHECK(jumps.size() == found.size());
    for (std::size_t p = 0; p < std::min(jumps.size(), found.size()); ++p)
      CHECK(std::abs(jumps[p] - found[p].time) < 4.0f / kTimes);  // chords stray
    ++compared;
    passages += int(found.size());
  }
  CHECK(compared > 200);
  CHECK(passages > 30);
}

TEST_CASE("the tree leaves out nothing, on any number of threads") {
  const std::vector<Bezier> before = test::randomTubes(300, 5, 0.1f, 0.03f, 0.001f);
  std::vector<Bezier> after = test::randomTubes(300, 6, 0.1f, 0.03f, 0.001f);
  for (std::size_t tube = 0; tube < after.size(); ++tube)
    after[tube] = between(before[tube], after[tube], 0.3f);
  std::size_t onePairAtATime = 0;
  for (std::size_t i = 0; i < before.size(); ++i)
    for (std::size_t j = i + 1; j < before.size(); ++j)
      onePairAtATime += passagesOf(std::array{before[i], before[j]}, std::array{after[i], after[j]}).size();
  const unsigned threads = threadCount();
  for (const unsigned count : {1u, 3u}) {
    setThreadCount(count);
    const std::vector<Passage> found = passagesOf(before, after);
    CHECK(found.size() == onePairAtATime);
    CHECK(std::ranges::is_sorted(found, {}, [](const Passage& p) { return std::pair(p.i, p.j); }));
  }
  setThreadCount(threads);
  CHECK(onePairAtATime > 100);
}
