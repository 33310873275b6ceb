#include "core/letters.h"

#include <doctest/doctest.h>

using namespace vasa;

TEST_CASE("capitals of ASCII go, all other bytes stay") {
  CHECK(lowerCase("Vena Cava 2 [@`{z]") == "vena cava 2 [@`{z]");
  CHECK(lowerCase("ARTÈRE") == "artÈre");
  CHECK(lowerCase("").empty());
}

TEST_CASE("words are the same but for capitals") {
  CHECK(sameLetters("Hierarchy", "HIERARCHY"));
  CHECK_FALSE(sameLetters("solid", "solids"));
  CHECK_FALSE(sameLetters("solid", "solie"));
  CHECK_FALSE(sameLetters("[", "{"));  // as far apart as letters from their capitals
}
