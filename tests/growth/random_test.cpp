#include "growth/random.h"

#include <doctest/doctest.h>

#include <array>
#include <set>

using namespace vasa;

TEST_CASE("random numbers are fixed for good: pictures of a seed stay the same") {
  static_assert(scramble(0) == 129708002u);
  CHECK(scramble(1) == 2831084092u);
  CHECK(unitFloat(0xffffffffu) < 1.0f);
  CHECK(unitFloat(0x80000000u) == 0.5f);
}

TEST_CASE("keys of neighbouring addresses differ, and their numbers are spread evenly") {
  std::set<std::uint32_t> keys;
  std::array<int, 10> tenths{};
  for (std::uint32_t sweep = 0; sweep < 100; ++sweep)
    for (std::uint32_t sprout = 0; sprout < 100; ++sprout) {
      const std::uint32_t key = keyOf(keyOf(1, sweep), sprout);
      keys.insert(key);
      ++tenths[std::size_t(10 * unitOf(key, sprout % 7))];
    }
  CHECK(keys.size() > 9995);
  for (const int count : tenths) {
    CHECK(count > 850);
    CHECK(count < 1150);
  }
}
