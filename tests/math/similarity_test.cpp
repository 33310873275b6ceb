#include "math/similarity.h"

#include <doctest/doctest.h>

#include <random>
#include <vector>

using namespace vasa;

TEST_CASE("a similarity is found again from places and where it takes them") {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> unit(-1, 1);
  for (int round = 0; round < 50; ++round) {
    const Similarity told{1 + 0.5f * unit(random),
                          glm::normalize(quat{unit(random), unit(random), unit(random), unit(random)}),
                          vec3{unit(random), 3, unit(random)}};
    std::vector<std::pair<vec3, vec3>> pairs;
    for (int i = 0; i < 3 + round % 4; ++i) {
      const vec3 p{unit(random), unit(random), 2 * unit(random)};
      pairs.push_back({p, told(p)});
    }
    const Similarity found = fitSimilarity(pairs, false);
    for (const auto& [from, to] : pairs) CHECK(glm::distance(found(from), to) < 1e-4f);
    CHECK(found.scale == doctest::Approx(told.scale).epsilon(1e-4));
    CHECK(fitSimilarity(pairs, true).scale == 1);
  }
}

TEST_CASE("one pair moves, two turn by the shortest way and scale") {
  const std::vector<std::pair<vec3, vec3>> one{{{1, 0, 0}, {1, 2, 0}}};
  CHECK(glm::distance(fitSimilarity(one, false)(vec3(5, 5, 5)), vec3(5, 7, 5)) < 1e-5f);
  const std::vector<std::pair<vec3, vec3>> two{{{0, 0, 0}, {1, 1, 1}}, {{1, 0, 0}, {1, 3, 1}}};
  const Similarity fit = fitSimilarity(two, false);
  CHECK(fit.scale == doctest::Approx(2));
  CHECK(glm::distance(fit(vec3(0, 0, 1)), vec3(1, 1, 3)) < 1e-4f);  // what is aside of the turn stays there
  CHECK(fitSimilarity({}, false)(vec3(1, 2, 3)) == vec3(1, 2, 3));
}
