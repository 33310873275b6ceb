#include "avoid/metric.h"

#include <doctest/doctest.h>

#include <algorithm>

using namespace vasa;

TEST_CASE("without bending the metric is the identity") {
  const BendingMetric metric(3, true, false, 0);
  std::vector<float> x{1, 2, 3};
  metric.solve(x);
  CHECK(x == std::vector<float>{1, 2, 3});
}

TEST_CASE("two points between fixed ends, by hand") {
  // D2 rows: z0; -2 z0 + z1; z0 - 2 z1; z1. W = I + (1+4+1, -2-2; -4, 6).
  const BendingMetric metric(2, true, true, 1);
  std::vector<float> x{7 * 1.0f - 4 * 2.0f, -4 * 1.0f + 7 * 2.0f};
  metric.solve(x);
  CHECK(x[0] == doctest::Approx(1));
  CHECK(x[1] == doctest::Approx(2));
}

TEST_CASE("a free vessel is shifted and turned as a whole for the price of the identity") {
  const BendingMetric metric(9, false, false, 50);
  std::vector<float> x(9, 1);
  metric.solve(x);
  for (const float value : x) CHECK(value == doctest::Approx(1).epsilon(1e-4));
  CHECK(BendingMetric::energy(std::vector<float>{1, 2, 3}, 50) == doctest::Approx(14));
}

TEST_CASE("a push in the middle gives one smooth bow") {
  const BendingMetric metric(31, true, true, 30);
  std::vector<float> x(31, 0);
  x[15] = 1;
  metric.solve(x);
  CHECK(*std::max_element(x.begin(), x.end()) == x[15]);
  for (std::size_t k = 0; k < 15; ++k) CHECK(x[k] == doctest::Approx(x[30 - k]).epsilon(1e-3));
  CHECK(x[13] > 0.7f * x[15]);
}

TEST_CASE("a vessel of nothing but fixed ends has nothing to solve") {
  const BendingMetric metric(0, true, true, 30);
  std::vector<float> x;
  metric.solve(x);
  CHECK(metric.count() == 0);
}
