#include "viewer/fuzzy.h"

#include <doctest/doctest.h>

#include <algorithm>

using namespace vasa::viewer;

namespace {

constexpr std::string_view kNames[] = {"left femoral artery",
                                       "right femoral artery",
                                       "left profunda femoris artery",
                                       "left femoral vein",
                                       "abdominal aorta",
                                       "arch of aorta",
                                       "left renal artery",
                                       "coeliac trunk",
                                       "left subclavian artery",
                                       "superior mesenteric artery",
                                       "left anterior tibial artery",
                                       "left great saphenous vein"};

std::string_view firstFor(std::string_view typed) {
  const auto found = fuzzySearch(typed, kNames);
  return found.empty() ? "" : kNames[found.front()];
}

}  // namespace

TEST_CASE("letters that are left out do not matter, nor the words' order, nor case") {
  CHECK(firstFor("femrl").find("femoral") != std::string_view::npos);
  CHECK(firstFor("femrl art") == "left femoral artery");
  CHECK(firstFor("femrl vn") == "left femoral vein");
  CHECK(firstFor("artery fem r") == "right femoral artery");
  CHECK(firstFor("SMA") == "superior mesenteric artery");
  CHECK(firstFor("gsv") == "left great saphenous vein");
  CHECK(firstFor("aorta") == "arch of aorta");  // the shorter one
  CHECK(firstFor("celiac") == "coeliac trunk");
  CHECK(firstFor("subcl") == "left subclavian artery");
}

TEST_CASE("what lacks a letter is not found, and letters in a row come before scattered ones") {
  CHECK_FALSE(fuzzyScore("femz", "left femoral artery"));
  CHECK_FALSE(fuzzyScore("lfa", "artery"));
  CHECK(firstFor("xyz") == "");
  CHECK(*fuzzyScore("tib", "left anterior tibial artery") > *fuzzyScore("tib", "the interior lobe"));
  CHECK(*fuzzyScore("renal", "left renal artery") > *fuzzyScore("renal", "left adrenal artery"));
  CHECK(*fuzzyScore("fem", "femoral artery") > *fuzzyScore("fem", "profunda femoris artery"));
  const auto found = fuzzySearch("femoral", kNames);
  CHECK(found.size() == 3);  // and not what has these letters all over it
}

TEST_CASE("nothing typed finds everything, as it comes") {
  const auto all = fuzzySearch("", kNames);
  CHECK(all.size() == std::size(kNames));
  CHECK(std::ranges::is_sorted(all));
  CHECK(fuzzySearch("  ", kNames).size() == std::size(kNames));
}
