#include "viewer/settings.h"

#include <doctest/doctest.h>

using namespace vasa;
using namespace vasa::viewer;

TEST_CASE("settings come back as they were written") {
  Settings settings{.width = 900, .height = 700};
  settings.state.preset = "xray";
  settings.state.look = *lookNamed("xray");
  settings.state.look.skinOpacity = 0.5f;
  settings.state.look.drawBones = false;
  settings.state.orbit.setOrthographic(true);
  settings.state.detail = {.automatic = false, .around = 12, .along = 4};
  settings.state.forces.avoid = false;
  settings.state.playback.speed = -0.5f;
  settings.state.recent = {"/a/b.json", "/c \"d\".glb"};
  Settings read;
  readSettings(writeSettings(settings), read);
  CHECK(read.width == 900);
  CHECK(read.height == 700);
  CHECK(read.state.preset == "xray");
  CHECK(read.state.look.style == LookStyle::xray);
  CHECK(read.state.look.skinOpacity == 0.5f);
  CHECK_FALSE(read.state.look.drawBones);
  CHECK(read.state.orbit.orthographic());
  CHECK(read.state.detail == settings.state.detail);
  CHECK_FALSE(read.state.forces.avoid);
  CHECK(read.state.playback.speed == -0.5f);
  CHECK(read.state.recent == settings.state.recent);
}

TEST_CASE("what makes no sense is passed over") {
  for (
      const char* text :
      {"", "[]", "{",
       "{\"around\": 99, \"speed\": \"fast\", \"preset\": \"sepia\", \"width\": -3, \"more\": 1, \"recent\": [3]}"}) {
    Settings settings;
    readSettings(text, settings);
    CHECK(settings.state.detail.around == 8);
    CHECK(settings.state.playback.speed == 1);
    CHECK(settings.state.preset == "atlas");
    CHECK(settings.width == 0);
    CHECK(settings.state.recent.empty());
  }
}
