#include "core/large_pages.h"

#include <doctest/doctest.h>

#include <cstdint>
#include <limits>
#include <numeric>

namespace vasa {

TEST_CASE("A large vector keeps its elements while it grows past a large page") {
  LargeVector<std::uint32_t> numbers;
  constexpr std::uint32_t kMany = 3'000'000;  // 12 MB
  for (std::uint32_t k = 0; k < kMany; ++k) numbers.push_back(k);
  CHECK(std::accumulate(numbers.begin(), numbers.end(), std::uint64_t(0)) ==
        std::uint64_t(kMany) * (kMany - 1) / 2);
  numbers.resize(10);
  numbers.shrink_to_fit();
  CHECK(numbers.back() == 9);
}

TEST_CASE("Small and large vectors keep to their elements' alignment") {
  struct alignas(128) Wide {
    float numbers[32];
  };
  for (const std::size_t count : {1, 3, 100'000}) {
    const LargeVector<Wide> wide(count);
    CHECK(reinterpret_cast<std::uintptr_t>(wide.data()) % 128 == 0);
  }
}

TEST_CASE("More than there is fails as it does everywhere") {
  LargePages<double> pages;
  CHECK_THROWS_AS((void)pages.allocate(std::numeric_limits<std::size_t>::max() / 4), std::bad_alloc);
}

}  // namespace vasa
