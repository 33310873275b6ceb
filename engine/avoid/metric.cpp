#include "avoid/metric.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

namespace vasa {
namespace {

constexpr std::array<double, 3> kSecondDifference{1, -2, 1};

}  // namespace

BendingMetric::BendingMetric(std::uint32_t count, bool startFixed, bool endFixed, float beta) {
  // Rows of D2 are numbered by their first point; those that reach beyond a fixed end see zeros there.
  const int n = int(count), from = startFixed ? -2 : 0, to = endFixed ? n : n - 2;
  std::vector<std::array<double, 3>> band(count, {1, 0, 0});  // [i][k] = W(i, i - k)
  for (int row = from; row < to; ++row)
    for (int a = 0; a < 3; ++a)
      for (int b = 0; b <= a; ++b) {
        const int i = row + a, j = row + b;
        if (i >= 0 && i < n && j >= 0 && j < n)
          band[std::size_t(i)][std::size_t(i - j)] +=
              double(beta) * kSecondDifference[std::size_t(a)] * kSecondDifference[std::size_t(b)];
      }
  pivot_.resize(count);
  lower1_.assign(count, 0);
  lower2_.assign(count, 0);
  std::vector<double> d(count), l1(count, 0), l2(count, 0);
  for (std::size_t i = 0; i < count; ++i) {
    if (i >= 2) l2[i] = band[i][2] / d[i - 2];
    if (i >= 1) l1[i] = (band[i][1] - (i >= 2 ? l2[i] * d[i - 2] * l1[i - 1] : 0)) / d[i - 1];
    d[i] = band[i][0] - (i >= 1 ? l1[i] * l1[i] * d[i - 1] : 0) - (i >= 2 ? l2[i] * l2[i] * d[i - 2] : 0);
    pivot_[i] = float(1 / d[i]);
    lower1_[i] = float(l1[i]);
    lower2_[i] = float(l2[i]);
  }
}

BendingMetric::Range BendingMetric::solveNear(std::span<float> x, Range given, float negligible) const {
  assert(x.size() == pivot_.size() && given.first < given.last && given.last <= x.size());
  const std::uint32_t n = count();
  float largest = 0;
  std::uint32_t end = given.first;
  for (std::uint32_t i = given.first; i < n; ++i) {
    if (i > given.first) x[i] -= lower1_[i] * x[i - 1] + (i >= given.first + 2 ? lower2_[i] * x[i - 2] : 0);
    largest = std::max(largest, std::abs(x[i]));
    end = i + 1;
    if (i > given.last && std::max(std::abs(x[i]), std::abs(x[i - 1])) < negligible * largest) break;
  }
  for (std::uint32_t i = given.first; i < end; ++i) x[i] *= pivot_[i];
  largest = 0;
  std::uint32_t begin = end;
  for (std::uint32_t i = end; i-- > 0;) {
    if (i + 1 < end) x[i] -= lower1_[i + 1] * x[i + 1];
    if (i + 2 < end) x[i] -= lower2_[i + 2] * x[i + 2];
    largest = std::max(largest, std::abs(x[i]));
    begin = i;
    if (i + 1 < given.first && std::max(std::abs(x[i]), std::abs(x[i + 1])) < negligible * largest) break;
  }
  return {begin, end};
}

float BendingMetric::energy(std::span<const float> z, float beta) {
  float sum = 0;
  for (std::size_t i = 0; i < z.size(); ++i) {
    sum += z[i] * z[i];
    if (i < 2) continue;
    const float bend = z[i - 2] - 2 * z[i - 1] + z[i];
    sum += beta * bend * bend;
  }
  return sum;
}

}  // namespace vasa
