#include "atlas/scene_look.h"

#include <doctest/doctest.h>

using namespace vasa;

TEST_CASE("what a scene says of a look gives the look again, whatever was changed") {
  for (const char* preset : {"atlas", "clinical", "xray"}) {
    CAPTURE(preset);
    Look look = *lookNamed(preset);
    CHECK(atlas::lookOf(atlas::choiceOf(look, preset)) == look);
    look.background = {0.1f, 0.2f, 0.3f, 1};
    look.drawVeins = look.drawOther = false;  // the heart stays
    look.boneOpacity = 0.25f, look.arteryOpacity = 0.5f, look.veinOpacity = 0.75f, look.heartOpacity = 0;
    look.otherOpacity = 0.125f, look.skinOpacity = 0.875f, look.capillaryOpacity = 0.375f;
    const LookChoice choice = atlas::choiceOf(look, preset);
    CHECK(atlas::lookOf(choice) == look);
    SceneFile scene;
    scene.look = choice;
    const auto read = parseScene(sceneText(scene, "folder"), "folder", "scene.json");
    REQUIRE(read);
    CHECK(atlas::lookOf(read->look) == look);
  }
}

TEST_CASE("where a scene hides organs the heart goes with them, unless it says otherwise") {
  LookChoice choice;
  choice.organs = false;
  CHECK_FALSE(atlas::lookOf(choice).drawHeart);
  choice.heart = true;
  CHECK(atlas::lookOf(choice).drawHeart);
  CHECK_FALSE(atlas::lookOf(choice).drawOther);
}
