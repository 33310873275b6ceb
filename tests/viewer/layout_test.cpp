#include "viewer/layout.h"

#include <doctest/doctest.h>

#include <initializer_list>
#include <iterator>

using namespace vasa;
using namespace vasa::viewer;

namespace {

bool overlap(const Rect& a, const Rect& b) {
  return a.left < b.left + b.width && b.left < a.left + a.width && a.top < b.top + b.height &&
         b.top < a.top + a.height;
}

}  // namespace

TEST_CASE("a window that is larger than a device can draw is drawn in its shape with as many pixels as go") {
  CHECK(drawnSize({1280, 720}, 16384, 33'554'432) == uvec2(1280, 720));
  CHECK(drawnSize({12000, 12000}, 16384, 33'554'432) == uvec2(5792, 5792));
  CHECK(drawnSize({16000, 100}, 8192, 33'554'432) == uvec2(8192, 51));
  CHECK(drawnSize({30000, 1}, 8192, 33'554'432) == uvec2(8192, 1));
  CHECK(drawnSize({0, 720}, 16384, 33'554'432) == uvec2(0, 720));  // minimised
}

TEST_CASE("the window's parts share it out, with nothing on another, at any size and scale") {
  for (const vec2 size : {vec2(400, 300), vec2(800, 600), vec2(1280, 720), vec2(1920, 1280)})
    for (const float scale : {1.0f, 1.5f, 2.0f})
      for (const bool list : {false, true}) {
        CAPTURE(size.x);
        CAPTURE(scale);
        CAPTURE(list);
        const Layout layout = layoutOf(size.x, size.y, scale, true, list);
        const Rect parts[]{layout.bar, layout.outliner, layout.picture, layout.panels, layout.transport};
        float covered = 0;
        for (std::size_t a = 0; a < std::size(parts); ++a) {
          covered += parts[a].width * parts[a].height;
          for (std::size_t b = 0; b < a; ++b) CHECK_FALSE(overlap(parts[a], parts[b]));
        }
        CHECK(covered == doctest::Approx(size.x * size.y));
      }
}

TEST_CASE(
    "the clip's time runs under the panels, too, where the window is narrow, and beside them where not") {
  const Layout narrow = layoutOf(800, 600, 2, true, false), wide = layoutOf(1280, 720, 1, true, false);
  CHECK(narrow.transport.width == 800);
  CHECK(wide.transport.width == 1280 - 320);
  CHECK(wide.panels.height == 720 - 30);
}

TEST_CASE("without panels the picture has all of the window") {
  CHECK(layoutOf(800, 600, 2, false, false).picture == Rect{0, 0, 800, 600});
}
