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

TEST_CASE("a line goes on through a bend as sharp as a hairpin, in one line as from one to the next") {
  const std::vector<vec4> there{{0, 0, 0, 1}, {5, 0, 0, 1}, {10, 0, 0, 1}},
      back{{10, 0, 0, 1}, {9, 0.5f, 0, 1}, {5, 1, 0, 1}};
  std::vector<vec4> whole = there;
  whole.insert(whole.end(), back.begin() + 1, back.end());
  using Lines = std::vector<std::vector<vec4>>;
  for (const Lines& lines : {Lines{whole}, Lines{there, back}}) {
    const auto chained = chainLines(lines);
    REQUIRE(chained.size() == 1);
    CHECK(chained[0].size() == whole.size());
  }
}

}  // namespace
}  // namespace vasa
