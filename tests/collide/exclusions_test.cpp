#include "collide/exclusions.h"

#include <doctest/doctest.h>

using namespace vasa;

TEST_CASE("excluded pairs count once, in either order") {
  const TubePair pairs[] = {{3, 1}, {1, 3}, {0, 1}, {1, 3}};
  const Exclusions exclusions(5, pairs);
  CHECK(exclusions.tubeCount() == 5);
  CHECK(exclusions.pairCount() == 2);
  CHECK(exclusions.contains(1, 3));
  CHECK(exclusions.contains(3, 1));
  CHECK(exclusions.contains(1, 0));
  CHECK(!exclusions.contains(0, 3));
  CHECK(exclusions.partnersOf(1).size() == 2);
  CHECK(exclusions.partnersOf(4).empty());
  CHECK(Exclusions(0).tubeCount() == 0);
}
