#include "surface/visible.h"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <random>

#include "shared/tubes.h"

using namespace vasa;

namespace {

using Corners = std::array<glm::dvec2, 3>;

constexpr float kSnap = 1 / 256.0f;
constexpr vec2 kSamples(8, 8);

double cross2(glm::dvec2 a, glm::dvec2 b) { return a.x * b.y - a.y * b.x; }

// y points down: a front's edges have their samples at negative areas.
bool coversFront(const Corners& t, glm::dvec2 sample) {
  for (int i = 0; i < 3; ++i)
    if (cross2(t[(i + 1) % 3] - t[i], sample - t[i]) > 0) return false;
  return cross2(t[1] - t[0], t[2] - t[0]) < 0;
}

bool coversAny(const Corners& t) {
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 8; ++x)
      if (coversFront(t, {x, y})) return true;
  return false;
}

bool seen(const Corners& t, vec2 samples = kSamples) {
  return seenOfQuad(vec2(t[0]), vec2(t[1]), vec2(t[2]), vec2(t[2]), samples, kSnap) & 1u;
}

struct Chance {
  std::mt19937 engine{11};
  double operator()(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine); }
};

// Mostly thin and small, as a vessel's are that is seen from afar.
Corners someTriangle(Chance& chance) {
  const glm::dvec2 at(chance(1, 6), chance(1, 6)), edge(chance(-1, 1), chance(-1, 1));
  const glm::dvec2 third = chance(0, 1) * edge + chance(0, 0.3) * glm::dvec2(edge.y, -edge.x);
  return {at, at + edge, at + third};
}

}  // namespace

TEST_CASE("a triangle that covers a sample wherever its corners are moved to is seen") {
  Chance chance;
  int covering = 0;
  for (int i = 0; i < 100'000; ++i) {
    Corners t = someTriangle(chance);
    for (glm::dvec2& p : t) p = glm::dvec2(vec2(p));
    Corners moved = t;
    for (glm::dvec2& p : moved) p += 0.99 * kSnap * glm::dvec2(chance(0, 1) < 0.5 ? -1 : 1, chance(0, 1) < 0.5 ? -1 : 1);
    if (!coversAny(moved)) continue;
    ++covering;
    CHECK(seen(t));
  }
  CHECK(covering > 4'000);
}

TEST_CASE("what misses every sample by more than its corners may move is not seen") {
  Chance chance;
  int missing = 0, close = 0;
  for (int i = 0; i < 100'000; ++i) {
    const Corners t = someTriangle(chance);
    if (seen(t)) continue;
    ++missing;
    Corners wide = t;  // scaled about its middle until its edges lie where corners that move take them
    const glm::dvec2 middle = (t[0] + t[1] + t[2]) / 3.0;
    for (glm::dvec2& p : wide) p = middle + 1.5 * (p - middle);
    close += coversAny(wide);
  }
  CHECK(missing > 50'000);
  CHECK(close > 1'000);  // left out although a triangle half as large again covers a sample
  // A sliver whose upper corner is above a sample, then below it by half a move and by two and a half.
  const auto sliver = [](double below) { return Corners{{{2.6, 3 + below + 0.05}, {3.4, 3 + below + 0.05}, {3, 3 + below}}}; };
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
  CHECK(seenOfQuad(behind, {1, 1}, {2, 2}, {3, 1}, kSamples, kSnap) == 3);
  CHECK(seenOfQuad(vec2(front[0]), vec2(front[1]), vec2(front[2]), behind, kSamples, kSnap) == 3);
}
