#include "reference/visible.h"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <random>
#include <utility>
#include <vector>

#include "shared/tubes.h"

using namespace vasa;

namespace {

using Corners = std::array<glm::dvec2, 3>;

constexpr float kSnap = 1 / 256.0f;
constexpr vec2 kSize(8, 8);

double cross2(glm::dvec2 a, glm::dvec2 b) { return a.x * b.y - a.y * b.x; }

// y points down: a front's edges have their samples at negative areas.
bool coversFront(const Corners& t, glm::dvec2 sample) {
  for (int i = 0; i < 3; ++i)
    if (cross2(t[(i + 1) % 3] - t[i], sample - t[i]) > 0) return false;
  return cross2(t[1] - t[0], t[2] - t[0]) < 0;
}

// VkPhysicalDeviceLimits::standardSampleLocations, from the middle of a pixel.
std::vector<glm::dvec2> placesOf(std::uint32_t samples) {
  if (samples == 1) return {{0, 0}};
  return {{-0.125, -0.375}, {0.375, -0.125}, {-0.375, 0.125}, {0.125, 0.375}};
}

bool coversAny(const Corners& t, std::uint32_t samples) {
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 8; ++x)
      for (const glm::dvec2& place : placesOf(samples))
        if (coversFront(t, glm::dvec2(x, y) + place)) return true;
  return false;
}

bool seen(const Corners& t, vec2 size = kSize, std::uint32_t samples = 1) {
  return seenOfQuad(vec2(t[0]), vec2(t[1]), vec2(t[2]), vec2(t[2]), {size, kSnap, samples}) & 1u;
}

struct Chance {
  std::mt19937 engine{11};
  double operator()(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine);
  }
};

// Mostly thin and small, as a vessel's are that is seen from afar.
Corners someTriangle(Chance& chance) {
  const glm::dvec2 at(chance(1, 6), chance(1, 6)), edge(chance(-1, 1), chance(-1, 1));
  const glm::dvec2 third = chance(0, 1) * edge + chance(0, 0.3) * glm::dvec2(edge.y, -edge.x);
  return {at, at + edge, at + third};
}

}  // namespace

TEST_CASE("a triangle that covers a sample wherever its corners are moved to is seen") {
  for (const std::uint32_t samples : {1u, 4u}) {
    Chance chance;
    int covering = 0, missed = 0;
    for (int i = 0; i < 100'000; ++i) {
      Corners t = someTriangle(chance);
      for (glm::dvec2& p : t) p = glm::dvec2(vec2(p));
      Corners moved = t;
      for (glm::dvec2& p : moved)
        p += 0.99 * kSnap * glm::dvec2(chance(0, 1) < 0.5 ? -1 : 1, chance(0, 1) < 0.5 ? -1 : 1);
      if (!coversAny(moved, samples)) continue;
      ++covering;
      missed += !seen(t, kSize, samples);
    }
    CHECK(covering > 4'000);
    CHECK(missed == 0);
  }
}

TEST_CASE("both triangles of a quad are seen where they cover a sample, and few others") {
  for (const std::uint32_t samples : {1u, 4u}) {
    Chance chance;
    int covering = 0, drawn = 0, missed = 0;
    for (int i = 0; i < 100'000; ++i) {
      const Corners t = someTriangle(chance);
      const glm::dvec2 d = t[0] + (t[2] - t[1]) * chance(0.6, 1.4);
      const std::uint32_t bits =
          seenOfQuad(vec2(t[0]), vec2(t[1]), vec2(t[2]), vec2(d), {kSize, kSnap, samples});
      for (const auto& [bit, triangle] : {std::pair(1u, t), std::pair(2u, Corners{t[0], t[2], d})}) {
        const bool covers = coversAny(triangle, samples), isSeen = bits & bit;
        covering += covers;
        drawn += isSeen;
        missed += covers && !isSeen;
      }
    }
    CHECK(covering > 4'000);
    CHECK(missed == 0);
    CHECK(drawn < 1.4 * covering);
  }
}

TEST_CASE("what misses every sample by more than its corners may move is not seen") {
  for (const std::uint32_t samples : {1u, 4u}) {
    Chance chance;
    int covering = 0, drawn = 0;
    for (int i = 0; i < 100'000; ++i) {
      const Corners t = someTriangle(chance);
      covering += coversAny(t, samples);
      drawn += seen(t, kSize, samples);
    }
    CHECK(drawn >= covering);
    CHECK(drawn <
          1.25 * covering);  // few for nothing: most of these have edges a hundred times as long as a move
  }
  // A sliver whose upper corner is above a sample, then below it by half a move and by two and a half.
  const auto sliver = [](double below) {
    return Corners{{{2.6, 3 + below + 0.05}, {3.4, 3 + below + 0.05}, {3, 3 + below}}};
  };
  CHECK(coversFront(sliver(-0.02), {3, 3}));
  CHECK(seen(sliver(-0.02)));
  CHECK(seen(sliver(0.5 * kSnap)));
  CHECK_FALSE(seen(sliver(2.5 * kSnap)));
}

TEST_CASE("backs, what lies beside the picture, and what a corner before the near plane makes unknown") {
  const Corners front{{{2.5, 3.5}, {3.5, 3.5}, {3, 2.5}}}, back{{{3.5, 3.5}, {2.5, 3.5}, {3, 2.5}}};
  CHECK(seen(front));
  CHECK_FALSE(seen(back));
  CHECK(seen(front, {4, 4}));
  CHECK_FALSE(seen(front, {3, 8}));  // the last column is the one before its sample
  CHECK_FALSE(seen({{{-1.5, 3.5}, {-0.5, 3.5}, {-1, 2.5}}}));
  const vec2 behind(shared::kBehind);
  CHECK(seenOfQuad(behind, {1, 1}, {2, 2}, {3, 1}, {kSize, kSnap}) == 3);
  CHECK(seenOfQuad(vec2(front[0]), vec2(front[1]), vec2(front[2]), behind, {kSize, kSnap}) == 3);
}
