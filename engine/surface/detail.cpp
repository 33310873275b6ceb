#include "surface/detail.h"

#include <array>
#include <cmath>
#include <numbers>

#include "shared/detail.h"

namespace vasa {

std::span<const float> aroundErrors() {
  static const auto errors = [] {
    std::array<float, shared::kMaxAround + 1> values{};
    for (std::uint32_t m = 1; m <= shared::kMaxAround; ++m)
      values[m] = float(1 - std::cos(std::numbers::pi / m));
    return values;
  }();
  return errors;
}

}  // namespace vasa
