#include "core/nearest_names.h"

#include <doctest/doctest.h>

using namespace vasa;

TEST_CASE("the names that were likely meant come nearest first") {
  const std::vector<std::string> names{"left femoral artery", "right femoral artery", "left femoral vein",
                                       "aorta"};
  CHECK(nearestNames("left femorla artery", names, 1) == std::vector<std::string>{"left femoral artery"});
  CHECK(nearestNames("LEFT FEMORAL ARTERY", names, 2) ==
        std::vector<std::string>{"left femoral artery", "right femoral artery"});
  CHECK(nearestNames("femoral", names, 9).size() == 3);
  CHECK(nearestNames("aorat", names, 9) == std::vector<std::string>{"aorta"});
  CHECK(nearestNames("xyz", names, 9).empty());
  CHECK(nearestNames("", names, 9).empty());
  CHECK(nearestNames(std::string(100000, 'a'), names, 9).empty());
}

TEST_CASE("a message asks for what was likely meant") {
  const std::vector<std::string> names{"walk", "wave", "run", "squat"};
  CHECK(didYouMean("wakl", names) == "did you mean walk?");
  CHECK(didYouMean("wal", names) == "did you mean walk?");
  CHECK(didYouMean("wav", std::vector<std::string>{"wave", "way", "wavy"}) ==
        "did you mean wave, way or wavy?");
  CHECK(didYouMean("xyz", names, "there is walk") == "there is walk");
  CHECK(didYouMean("xyz", names).empty());
}
