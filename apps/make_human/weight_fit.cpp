#include "make_human/weight_fit.h"

#include <algorithm>

namespace vasa::human {
namespace {

constexpr int kWeightRounds = 12;

}  // namespace

void lower(const WeightQuadric& quadric, SoughtWeights& weights) {
  auto& w = weights.weights;
  std::array<float, SoughtWeights::kMost> slope{};
  for (int j = 0; j < weights.count; ++j) {
    slope[j] = -quadric.b[j];
    for (int k = 0; k < weights.count; ++k) slope[j] += quadric.a[j][k] * w[k];
  }
  for (int round = 0; round < kWeightRounds; ++round)
    for (int j = 0; j < weights.count; ++j)
      for (int k = 0; k < j; ++k) {
        const float bend = quadric.a[j][j] + quadric.a[k][k] - 2 * quadric.a[j][k];
        if (!(bend > 0)) continue;
        const float step = std::clamp((slope[k] - slope[j]) / bend, -w[j], w[k]);
        w[j] += step;
        w[k] -= step;
        for (int i = 0; i < weights.count; ++i) slope[i] += step * (quadric.a[i][j] - quadric.a[i][k]);
      }
}

}  // namespace vasa::human
