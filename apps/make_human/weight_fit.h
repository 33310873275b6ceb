#pragma once
#include <array>
#include <cstdint>

#include "math/types.h"

namespace vasa::human {

/// A vertex's weights while they are sought: of the joints that may move it.
struct SoughtWeights {
  static constexpr int kMost = 8;
  int count = 0;
  std::array<std::uint16_t, kMost> joints{};
  std::array<float, kMost> weights{};
};

/// A quadratic form of weights, w A w / 2 - b w.
struct WeightQuadric {
  std::array<std::array<float, SoughtWeights::kMost>, SoughtWeights::kMost> a{};
  std::array<float, SoughtWeights::kMost> b{};
};

/// Lowers the form among weights that are not negative and sum to one, from where they are. Method: mass goes
/// from one joint to another by exact steps, pair by pair (sequential minimal optimisation, Platt 1998).
void lower(const WeightQuadric& quadric, SoughtWeights& weights);

}  // namespace vasa::human
