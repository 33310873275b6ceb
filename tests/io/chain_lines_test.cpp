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

// Found by libFuzzer: no direction can be told from differences whose squares are not numbers or nothing.
TEST_CASE("where no direction can be told edges end, and nothing is lost") {
  for (const float step : {1e-38f, 3e38f}) {
    CAPTURE(step);
    const vec4 at(0, 0, 0, 0);
    const auto lines = chainLines({{at, {step, 0, 0, 0}}, {at, {0, step, 0, 0}}, {at, {0, 0, step, 0}}});
    CHECK(lines.size() == 3);
  }
}

}  // namespace
}  // namespace vasa
