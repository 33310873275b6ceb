#include "avoid/nearby_steps.h"

#include <doctest/doctest.h>

#include <random>
#include <vector>

using namespace vasa;

TEST_CASE("the longest step near a place is that of all places in a cube about it") {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> somewhere(-0.3f, 0.3f), length(0, 0.01f);
  std::vector<std::pair<vec3, float>> all;
  for (int k = 0; k < 500; ++k)
    all.emplace_back(vec3(somewhere(random), somewhere(random), somewhere(random)), length(random));
  constexpr float kNear = 0.045f, kLeast = 0.002f;
  NearbySteps steps(kNear);
  steps.set(kLeast, all.size(), [&](std::size_t k) { return all[k]; });
  for (int k = 0; k < 200; ++k) {
    const vec3 place(somewhere(random), somewhere(random), somewhere(random));
    float longest = kLeast;
    for (const auto& [at, step] : all)
      if (glm::all(glm::lessThan(glm::abs(at - place), vec3(kNear)))) longest = std::max(longest, step);
    CHECK(steps.longest(place, 1) == longest);
    const float enough = 0.5f * longest;
    CHECK(steps.longest(place, enough) >= std::max(enough, kLeast));
    CHECK(steps.longest(place, enough) <= longest);
  }
}
