#include "io/chain_lines.h"

#include <doctest/doctest.h>

namespace vasa {
namespace {

TEST_CASE("edges that meet two by two are one line; at a fork the straightest two go on") {
  const auto lines = chainLines({{{0, 0, 0, 1}, {1, 0, 0, 1}},
                                 {{2, 0, 0, 1}, {1, 0, 0, 1}},
                                 {{2, 0, 0, 1}, {3, 0, 0, 1}},
                                 {{2, 0, 0, 1}, {2, 1, 0, 1}}});
  REQUIRE(lines.size() == 2);
  CHECK(std::max(lines[0].size(), lines[1].size()) == 4);
  CHECK(std::min(lines[0].size(), lines[1].size()) == 2);
}

// Found by libFuzzer: radii of nothing do not say which edge goes on.
TEST_CASE("where nothing tells which edge goes on all end, and none is lost") {
  const auto lines =
      chainLines({{{0, 0, 0, 0}, {1, 0, 0, 0}}, {{0, 0, 0, 0}, {0, 1, 0, 0}}, {{0, 0, 0, 0}, {0, 0, 1, 0}}});
  CHECK(lines.size() == 3);
}

}  // namespace
}  // namespace vasa
