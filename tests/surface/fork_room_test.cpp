#include "surface/fork_room.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <random>
#include <vector>

using namespace vasa;

TEST_CASE("a fork with room all around gets what it wants, in its place") {
  std::vector<ForkRoom> rooms{{.centre = 5, .before = 1, .after = 1, .want = 2}};
  REQUIRE(shareRoom(rooms, 0, 10, 0.1f));
  CHECK(rooms[0].low == doctest::Approx(3));
  CHECK(rooms[0].high == doctest::Approx(7));
  CHECK(rooms[0].shift == 0);
}

TEST_CASE("two forks at one place part evenly and share their ring") {
  std::vector<ForkRoom> rooms(2, {.centre = 5, .before = 1, .after = 1, .want = 1.5f});
  REQUIRE(shareRoom(rooms, 0, 10, 0.1f));
  CHECK(rooms[0].centre == doctest::Approx(4));
  CHECK(rooms[1].centre == doctest::Approx(6));
  CHECK(rooms[0].high == rooms[1].low);
}

TEST_CASE("what is too little for all is refused; a fork beside an end is moved in") {
  std::vector<ForkRoom> rooms(3, {.centre = 5, .before = 1, .after = 1, .want = 1});
  CHECK(!shareRoom(rooms, 0, 5.9f, 0.1f));
  rooms.resize(1);
  rooms[0].centre = 0.2f;
  REQUIRE(shareRoom(rooms, 0, 10, 0.1f));
  CHECK(rooms[0].low == 0);
  CHECK(rooms[0].shift == doctest::Approx(0.8f));
}

TEST_CASE("rooms never overlap, stay within bounds and hold the least they need") {
  std::mt19937 engine(4);
  std::uniform_real_distribution<float> number(0, 1);
  for (int round = 0; round < 500; ++round) {
    std::vector<ForkRoom> rooms(1 + engine() % 6);
    for (ForkRoom& room : rooms)
      room = {.centre = 10 * number(engine),
              .before = number(engine),
              .after = number(engine),
              .want = 2 * number(engine)};
    std::sort(rooms.begin(), rooms.end(),
              [](const ForkRoom& a, const ForkRoom& b) { return a.centre < b.centre; });
    if (!shareRoom(rooms, 0, 10, 0.05f)) continue;
    for (std::size_t i = 0; i < rooms.size(); ++i) {
      CHECK(rooms[i].low >= (i > 0 ? rooms[i - 1].high : 0));
      CHECK(rooms[i].high <= 10.0001f);
      CHECK(rooms[i].centre - rooms[i].low >= rooms[i].before - 1e-4f);
      CHECK(rooms[i].high - rooms[i].centre >= rooms[i].after - 1e-4f);
    }
  }
}
