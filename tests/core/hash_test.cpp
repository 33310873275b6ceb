#include "core/hash.h"

#include <doctest/doctest.h>

#include <vector>

using namespace vasa;

TEST_CASE("hashes tell contents and seeds apart and never change") {
  const std::vector<int> a{1, 2, 3}, b{1, 2, 4};
  CHECK(hashOf(std::span(a)) == hashOf(std::span(a), 0));
  CHECK(hashOf(std::span(a)) != hashOf(std::span(b)));
  CHECK(hashOf(std::span(a), 1) != hashOf(std::span(a), 2));
  // XXH3_64bits of nothing, from the algorithm's published test vectors.
  CHECK(hashBytes({}) == 0x2D06800538D394C2ull);
}
