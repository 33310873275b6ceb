#include "viewer/pointer.h"

#include <doctest/doctest.h>

using namespace vasa;
using namespace vasa::viewer;

namespace {

const Rect kPicture{0, 0, 800, 600};

struct Hand {
  ViewState state;
  PointerTool tool;
  double now = 0;
  std::optional<Click> feed(InputEvent event, bool free = true) {
    return tool.feed(event, kPicture, free, now, state);
  }
  std::optional<Click> clickAt(vec2 place) {
    feed(PointerMoved{place});
    feed(ButtonChanged{Button::left, true});
    return feed(ButtonChanged{Button::left, false});
  }
};

}  // namespace

TEST_CASE("a press that does not move is a click; two soon after one another are a double click") {
  Hand hand;
  auto click = hand.clickAt({100, 50});
  REQUIRE(click);
  CHECK(click->place == vec2(100, 50));
  CHECK_FALSE(click->twice);
  hand.now = 0.2;
  CHECK(hand.clickAt({101, 50})->twice);
  hand.now = 0.3;
  CHECK_FALSE(hand.clickAt({101, 50})->twice);  // a third one begins anew
  hand.now = 2;
  CHECK_FALSE(hand.clickAt({101, 50})->twice);
}

TEST_CASE("a drag turns and is no click; with shift it moves the picture") {
  Hand hand;
  const vec3 pivot = hand.state.orbit.pivot();
  const vec3 eye = hand.state.orbit.camera(0, 1).position;
  hand.feed(PointerMoved{{100, 100}});
  hand.feed(ButtonChanged{Button::left, true});
  hand.feed(PointerMoved{{160, 100}});
  CHECK_FALSE(hand.feed(ButtonChanged{Button::left, false}));
  CHECK(hand.state.orbit.pivot() == pivot);
  CHECK(hand.state.orbit.camera(0, 1).position != eye);
  hand.feed(KeyChanged{Key::leftShift, true});
  hand.feed(ButtonChanged{Button::middle, true});
  hand.feed(PointerMoved{{200, 100}});
  hand.feed(ButtonChanged{Button::middle, false});
  CHECK(hand.state.orbit.pivot() != pivot);
}

TEST_CASE("what is over a panel or begins outside the picture is not the picture's") {
  Hand hand;
  const float distance = hand.state.orbit.distance();
  hand.feed(PointerMoved{{100, 100}});
  CHECK_FALSE(hand.feed(Scrolled{2}, false));
  CHECK(hand.state.orbit.distance() == distance);
  hand.feed(ButtonChanged{Button::left, true}, false);
  CHECK_FALSE(hand.feed(ButtonChanged{Button::left, false}));
  CHECK_FALSE(hand.clickAt({900, 100}));
  hand.feed(PointerMoved{{100, 100}});
  hand.feed(Scrolled{2});
  CHECK(hand.state.orbit.distance() < distance);
}
