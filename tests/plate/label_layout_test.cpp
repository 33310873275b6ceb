#include "plate/label_layout.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <random>

using namespace vasa;
using namespace vasa::plate;

namespace {

constexpr LabelColumns kColumns{.left = 50, .right = 150, .top = 20, .bottom = 280, .gap = 1, .clearance = 1};

std::vector<LabelWish> scattered(std::uint32_t seed, std::size_t count, bool likeHeights) {
  std::mt19937 random(seed);
  const auto between = [&](float low, float high) {
    return low + (high - low) * float(random() % 10000) / 10000.0f;
  };
  std::vector<LabelWish> wishes;
  for (std::size_t i = 0; i < count; ++i) {
    LabelWish wish{vec2(between(10, 40), likeHeights || i % 3 ? 3.5f : 7.0f), {}};
    for (int k = 0; k < 1 + int(i % 4); ++k) wish.anchors.push_back({between(55, 145), between(10, 290)});
    wishes.push_back(std::move(wish));
  }
  return wishes;
}

// What the header promises, for any wishes.
void checkPromises(const std::vector<LabelWish>& wishes, const LabelLayout& layout) {
  CHECK(layout.placed.size() + layout.dropped.size() == wishes.size());
  for (std::size_t i = 0; i < layout.placed.size(); ++i) {
    const PlacedLabel& a = layout.placed[i];
    const LabelWish& wish = wishes[a.label];
    CHECK(std::ranges::find(wish.anchors, a.anchor) != wish.anchors.end());
    CHECK(a.port.x == (a.right ? kColumns.right : kColumns.left));
    CHECK(a.port.y - wish.size.y / 2 >= kColumns.top - 1e-3f);
    CHECK(a.port.y + wish.size.y / 2 <= kColumns.bottom + 1e-3f);
    for (std::size_t j = i + 1; j < layout.placed.size(); ++j) {
      const PlacedLabel& b = layout.placed[j];
      CHECK_FALSE(linesCross(a.port, a.anchor, b.port, b.anchor));
      if (a.right == b.right)
        CHECK(std::abs(a.port.y - b.port.y) >=
              (wish.size.y + wishes[b.label].size.y) / 2 + kColumns.gap - 1e-3f);
    }
  }
}

}  // namespace

TEST_CASE("lines cross where they meet, touch or lie in one another") {
  CHECK(linesCross({0, 0}, {2, 2}, {0, 2}, {2, 0}));
  CHECK(linesCross({0, 0}, {2, 0}, {1, 0}, {1, 5}));
  CHECK(linesCross({0, 0}, {2, 0}, {1, 0}, {5, 0}));
  CHECK_FALSE(linesCross({0, 0}, {2, 0}, {3, 0}, {5, 0}));
  CHECK_FALSE(linesCross({0, 0}, {2, 2}, {3, 0}, {2.1f, 2}));
}

TEST_CASE("texts stand where they wish unless they push one another") {
  const std::vector<float> heights{2, 2, 2};
  CHECK(spreadOut(std::vector<float>{10, 20, 30}, heights, 1, 0, 100) == std::vector<float>{10, 20, 30});
  // Two at one height part evenly around it.
  CHECK(spreadOut(std::vector<float>{10, 10, 30}, heights, 1, 0, 100) == std::vector<float>{8.5f, 11.5f, 30});
  // The ends hold them.
  CHECK(spreadOut(std::vector<float>{-5, 0, 200}, heights, 1, 0, 100) == std::vector<float>{1, 4, 99});
}

TEST_CASE("a label goes to the side of its anchor, level with it") {
  const std::vector<LabelWish> wishes{{{20, 3}, {{60, 100}}}, {{20, 3}, {{140, 50}}}};
  const LabelLayout layout = layOutLabels(wishes, kColumns);
  REQUIRE(layout.placed.size() == 2);
  CHECK(layout.placed[0].label == 0);
  CHECK_FALSE(layout.placed[0].right);
  CHECK(layout.placed[0].port == vec2(50, 100));
  CHECK(layout.placed[1].right);
  CHECK(layout.placed[1].port == vec2(150, 50));
}

TEST_CASE("a pair's label takes the anchor of the emptier side") {
  // Five on the left alone; the sixth may be on either side.
  std::vector<LabelWish> wishes;
  for (int i = 0; i < 5; ++i) wishes.push_back({{20, 3}, {{60, 40.0f + 20 * float(i)}}});
  wishes.push_back({{20, 3}, {{60, 200}, {140, 200}}});
  const LabelLayout layout = layOutLabels(wishes, kColumns);
  REQUIRE(layout.placed.size() == 6);
  CHECK(layout.placed.back().label == 5);
  CHECK(layout.placed.back().right);
}

TEST_CASE("nothing crosses, covers another or leaves the page, however many there are") {
  for (std::uint32_t seed = 1; seed <= 40; ++seed) {
    const auto wishes = scattered(seed, 5 + 3 * seed, seed % 2 == 0);
    const LabelLayout layout = layOutLabels(wishes, kColumns);
    checkPromises(wishes, layout);
    // What fits is not dropped: 60 texts of 3.5 and a gap of 1 a column.
    if (wishes.size() <= 60) CHECK(layout.dropped.size() <= wishes.size() / 20);
  }
}

TEST_CASE("where there is too little room the last wishes go") {
  const auto wishes = scattered(7, 200, true);
  const LabelLayout layout = layOutLabels(wishes, kColumns);
  checkPromises(wishes, layout);
  CHECK(layout.placed.size() >= 100);
  CHECK(layout.dropped.front() > 50);
}

TEST_CASE("the same wishes give the same layout") {
  const auto wishes = scattered(3, 50, false);
  const LabelLayout a = layOutLabels(wishes, kColumns), b = layOutLabels(wishes, kColumns);
  REQUIRE(a.placed.size() == b.placed.size());
  for (std::size_t i = 0; i < a.placed.size(); ++i) {
    CHECK(a.placed[i].label == b.placed[i].label);
    CHECK(a.placed[i].port == b.placed[i].port);
    CHECK(a.placed[i].anchor == b.placed[i].anchor);
  }
}

TEST_CASE("no labels, no layout") {
  const LabelLayout layout = layOutLabels({}, kColumns);
  CHECK(layout.placed.empty());
  CHECK(layout.dropped.empty());
}
