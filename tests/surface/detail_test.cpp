#include "reference/detail.h"

#include <doctest/doctest.h>

#include <cmath>

#include "support/frames.h"
#include "support/networks.h"

using namespace vasa;

namespace {

// Looks along -z from (0, 0, 2), 100 pixels a metre at depth 1, 200 x 200 pixels.
shared::DetailView frontView(float tolerance) {
  shared::DetailView view{};
  const float s = std::sqrt(0.5f);
  view.planes[0] = {s, 0, -s, 2 * s};
  view.planes[1] = {-s, 0, -s, 2 * s};
  view.planes[2] = {0, s, -s, 2 * s};
  view.planes[3] = {0, -s, -s, 2 * s};
  view.planes[4] = {0, 0, -1, 1.9f};
  view.depth = {0, 0, -1, 2};
  view.nearest = 0.1f;
  view.reach = 1;
  view.focal = 100;
  view.tolerance = tolerance;
  return view;
}

Bezier straight(vec3 from, vec3 to, float radius) {
  return {{vec4(from, radius), vec4(glm::mix(from, to, 1 / 3.0f), radius),
           vec4(glm::mix(from, to, 2 / 3.0f), radius), vec4(to, radius)}};
}

SweepExtent extentOf(const Bezier& z, const shared::DetailView& view) { return sweepExtent(z.b, z, view); }

}  // namespace

TEST_CASE("a tube's size in pixels, and when it is out of view") {
  const shared::DetailView view = frontView(0.25f);
  const SweepExtent near = extentOf(straight({-0.5f, 0, 1}, {0.5f, 0, 1}, 0.2f), view);
  CHECK(near.inView);
  CHECK(near.radiusPixels == doctest::Approx(0.2f * 100 / 0.8f));
  CHECK(near.bendPixels == doctest::Approx(0).epsilon(1e-4));
  CHECK(!extentOf(straight({3.3f, 0, 0}, {3.3f, 1, 0}, 0.2f), view).inView);  // right of the picture
  CHECK(extentOf(straight({2.2f, 0, 0}, {2.2f, 1, 0}, 0.2f), view).inView);   // its side is in view
  CHECK(!extentOf(straight({0, 0, 2.5f}, {0, 1, 2.5f}, 0.2f), view).inView);  // behind the eye
  CHECK(extentOf(straight({-9, 0, 0}, {9, 0, 0}, 0.2f), view).inView);        // across it
}

TEST_CASE("m and n are the least that keep the error") {
  for (float size = 0.01f; size < 2000; size *= 1.3f)
    for (const float tolerance : {0.05f, 0.25f, 1.0f}) {
      const std::uint32_t m = aroundFor(size, tolerance), n = alongFor(size, tolerance);
      const auto sagitta = [&](std::uint32_t k) { return size * (1 - std::cos(kPi / float(k))); };
      const bool coarse = tolerance >= shared::kCoarse;
      const auto share = [&](std::uint32_t k) {
        return (coarse && k < shared::kRoundAround ? shared::kThinShare : 1) * tolerance;
      };
      const std::uint32_t least = coarse ? shared::kMinAround : shared::kRoundAround;
      if (!coarse) CHECK((m == shared::kThinAround) == (size <= tolerance));
      if (m < shared::kMaxAround) CHECK(sagitta(m) <= share(m) * 1.0001f);
      if (m > least) CHECK(sagitta(m - 1) > share(m - 1) * 0.9999f);
      if (n < shared::kMaxAlong) CHECK(size / float(n * n) <= 0.07f * tolerance * 1.0001f);
      if (n > 1) CHECK(size / float((n - 1) * (n - 1)) > 0.07f * tolerance * 0.9999f);
    }
}

TEST_CASE("the bend's height bounds how far an arc is from its chords") {
  shared::DetailView view = frontView(0.1f);
  for (const float turn : {0.1f, 0.5f, 1.2f}) {
    const float r = 0.3f, tube = 0.1f, k = 4.0f / 3 * std::tan(turn / 4) * r;
    const vec2 end(std::cos(turn), std::sin(turn)), back(end.y, -end.x);
    Bezier arc{{vec4(r, 0, 0, tube), vec4(r, k, 0, tube), vec4(r * end + k * back, 0, tube),
                vec4(r * end, 0, tube)}};
    const float bend = extentOf(arc, view).bendPixels, scale = 100 / (2 - tube);
    for (std::uint32_t n = 1; n < 8; ++n) {
      const float height = (r + tube) * (1 - std::cos(turn / float(2 * n))) * scale;  // of the outer side
      CHECK(height <= bend / float(n * n) * 1.02f);
      CHECK(height >= bend / float(n * n) * 0.7f);
    }
  }
}

TEST_CASE("m is the same for all sweeps of a vessel, fixed quads stay as they are") {
  const Network network = test::windingNetwork(20, 3);
  const SweepTable table = makeSweepTable(network);
  const std::vector<quat> frames = test::framesOf(network);
  const PosedNetwork posed{table, network.points(), frames};
  shared::DetailView view = frontView(0.02f);
  const NetworkDetail detail = networkDetail(posed, view);
  REQUIRE(detail.around.size() == network.vessels().size());
  REQUIRE(detail.along.size() == table.sweeps.size());
  CHECK(*std::max_element(detail.around.begin(), detail.around.end()) >
        *std::min_element(detail.around.begin(), detail.around.end()));
  view.around = 8;
  view.along = 5;
  for (const std::uint32_t m : networkDetail(posed, view).around) CHECK(m == 8);
  for (const std::uint32_t n : networkDetail(posed, view).along) CHECK((n == 5 || n == 0));
}
