#include "avoid/metric.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

using namespace vasa;

namespace {

// All of it, whatever is negligible.
void solve(const BendingMetric& metric, std::span<float> x) {
  if (!x.empty()) metric.solveNear(x, {0, metric.count()}, 0);
}

}  // namespace

TEST_CASE("without bending the metric is the identity") {
  const BendingMetric metric(3, true, false, 0);
  std::vector<float> x{1, 2, 3};
  solve(metric, x);
  CHECK(x == std::vector<float>{1, 2, 3});
}

TEST_CASE("two points between fixed ends, by hand") {
  // D2 rows: z0; -2 z0 + z1; z0 - 2 z1; z1. W = I + (1+4+1, -2-2; -4, 6).
  const BendingMetric metric(2, true, true, 1);
  std::vector<float> x{7 * 1.0f - 4 * 2.0f, -4 * 1.0f + 7 * 2.0f};
  solve(metric, x);
  CHECK(x[0] == doctest::Approx(1));
  CHECK(x[1] == doctest::Approx(2));
}

TEST_CASE("a free vessel is shifted and turned as a whole for the price of the identity") {
  const BendingMetric metric(9, false, false, 50);
  std::vector<float> x(9, 1);
  solve(metric, x);
  for (const float value : x) CHECK(value == doctest::Approx(1).epsilon(1e-4));
  CHECK(BendingMetric::energy(std::vector<float>{1, 2, 3}, 50) == doctest::Approx(14));
}

TEST_CASE("a push in the middle gives one smooth bow") {
  const BendingMetric metric(31, true, true, 30);
  std::vector<float> x(31, 0);
  x[15] = 1;
  solve(metric, x);
  CHECK(*std::max_element(x.begin(), x.end()) == x[15]);
  for (std::size_t k = 0; k < 15; ++k) CHECK(x[k] == doctest::Approx(x[30 - k]).epsilon(1e-3));
  CHECK(x[13] > 0.7f * x[15]);
  CHECK(x[15 - std::size_t(std::ceil(BendingMetric::bowOf(30)))] < 0.1f * x[15]);
}

TEST_CASE("a vessel of nothing but fixed ends has nothing to solve") {
  const BendingMetric metric(0, true, true, 30);
  std::vector<float> x;
  solve(metric, x);
  CHECK(metric.count() == 0);
}

TEST_CASE("near the push, the short way gives what the whole way gives") {
  const BendingMetric metric(120, true, false, 30);
  for (const std::uint32_t at : {0u, 3u, 60u, 116u}) {
    CAPTURE(at);
    std::vector<float> whole(120, 0), near(120, 0);
    for (std::uint32_t k = at; k < at + 4; ++k) whole[k] = near[k] = 0.1f * float(k - at) + 0.2f;
    solve(metric, whole);
    const auto [first, last] = metric.solveNear(near, {at, at + 4}, 1e-3f);
    CHECK(last - first < 80);
    const float largest = *std::max_element(whole.begin(), whole.end());
    for (std::uint32_t k = 0; k < 120; ++k) {
      CHECK(std::abs(near[k] - whole[k]) < 3e-3f * largest);
      if (k < first || k >= last) CHECK(near[k] == 0);
    }
  }
}
