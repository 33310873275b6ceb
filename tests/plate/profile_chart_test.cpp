#include "plate/profile_chart.h"

#include <doctest/doctest.h>

#include <algorithm>

using namespace vasa;

namespace {

// 100 mm, 4 mm wide in radius but for 2 mm around the middle.
std::vector<ProfileStation> narrowed() {
  std::vector<ProfileStation> stations;
  for (int i = 0; i <= 100; ++i) {
    ProfileStation station;
    station.along = 0.001f * float(i);
    station.centre = {0, station.along, 0};
    station.radius = i >= 45 && i <= 55 ? 0.002f : 0.004f;
    stations.push_back(station);
  }
  return stations;
}

// Rows in which a column is filled, from the top: of the line and what is below it.
int filledIn(const Image& picture, int x, int from, int to) {
  int count = 0;
  for (int y = from; y < to; ++y) {
    const std::uint8_t* pixel = &picture.rgba[4 * (std::size_t(y) * picture.width + std::size_t(x))];
    count += pixel[0] > pixel[2] + 12;  // reddish
  }
  return count;
}

}  // namespace

TEST_CASE("a chart shows half the radius at half the height, and a quarter of the area at a quarter") {
  const auto picture = plate::drawProfile("a vessel", narrowed());
  REQUIRE_MESSAGE(picture, picture.error().message);
  const int half = int(picture->height) / 2, left = 200, middle = (84 + int(picture->width) - 28) / 2;
  const auto share = [&](int from, int to) {
    return double(filledIn(*picture, middle, from, to)) / filledIn(*picture, left, from, to);
  };
  CHECK(share(0, half) == doctest::Approx(0.5).epsilon(0.03));
  CHECK(share(half, int(picture->height)) == doctest::Approx(0.25).epsilon(0.05));
}

TEST_CASE("a chart of a single place, and of one without width, is drawn all the same") {
  CHECK(plate::drawProfile("a place", std::vector<ProfileStation>(1)));
  CHECK(plate::drawProfile("a place", std::vector<ProfileStation>(2)));
}

TEST_CASE("the table has a row a station") {
  const std::string table = plate::profileCsv(narrowed());
  CHECK(std::ranges::count(table, '\n') == 102);
  CHECK(table.find("\n50.000,0.50000,0.000,50.000,0.000,2.0000,12.5664,0.000000\n") != std::string::npos);
}
