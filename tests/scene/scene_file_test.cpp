#include "scene/scene_file.h"

#include <doctest/doctest.h>

#include "core/atomic_file.h"
#include "support/shared_data.h"

using namespace vasa;

namespace {

std::string messageOf(const std::string& text) {
  const auto scene = parseScene(text, "/scenes", "x.json");
  REQUIRE(!scene.ok());
  CHECK(scene.error().fault == Fault::badInput);
  return scene.error().message;
}

}  // namespace

TEST_CASE("a full scene is read, paths relative to the file") {
  test::TemporaryFolder folder;
  const auto path = folder.path() / "scene.json";
  REQUIRE(
      writeFileAtomically(
          path,
          std::string(
              R"({"body": "b.glb", "networks": ["a.vasa", "/abs/v.vasa"], "edits": ["l.vedit"], "clip": "walk",
    "camera": {"position": [1, 2, 3], "target": [0, 1, 0], "angle": 20, "focus": "aorta"},
    "look": {"background": [1, 1, 1, 0], "skin": false, "skin_opacity": 0.5}})"))
          .ok());
  const auto scene = readSceneFile(path);
  REQUIRE(scene.ok());
  CHECK(scene->body == folder.path() / "b.glb");
  CHECK(scene->networks[0] == folder.path() / "a.vasa");
  CHECK(scene->networks[1] == "/abs/v.vasa");
  CHECK(scene->edits == std::vector{folder.path() / "l.vedit"});
  CHECK(scene->clip == "walk");
  CHECK(scene->camera.position == vec3(1, 2, 3));
  CHECK(scene->camera.focus == "aorta");
  CHECK(!scene->look.skin);
  CHECK(scene->look.bones);
  CHECK(scene->look.background->w == 0);
}

TEST_CASE("a scene in UTF-16 is refused as that, one in Windows' code page is read") {
  const test::TemporaryFolder folder;
  const auto path = folder.path() / "scene.json";
  const std::string text = R"({"clip": "walk"})";
  std::string wide = "\xFF\xFE";
  for (const char letter : text) wide += {letter, '\0'};
  REQUIRE(writeFileAtomically(path, wide).ok());
  const auto refused = readSceneFile(path);
  REQUIRE_FALSE(refused.ok());
  CHECK(refused.error().fault == Fault::badInput);
  CHECK(refused.error().message.find("scene.json: the text is UTF-16; save it as UTF-8") !=
        std::string::npos);
  REQUIRE(writeFileAtomically(path, std::string("{\"chosen\": \"art\xE8re\"}")).ok());
  const auto read = readSceneFile(path);
  REQUIRE(read.ok());
  CHECK(read->chosen == "art\xC3\xA8re");
}

TEST_CASE("a motion file's path is relative to the scene, a clip's name is no path") {
  const auto scene =
      parseScene(R"({"clip": "walk.bvh", "joint_map": "map.txt", "holds": "h.csv", "as_recorded": true})",
                 "/here", "x.json");
  REQUIRE(scene.ok());
  CHECK(scene->clip == "/here/walk.bvh");
  CHECK(scene->jointMap == "/here/map.txt");
  CHECK(scene->holds == "/here/h.csv");
  CHECK(parseScene(sceneText(*scene, "/here"), "/here", "x.json")->holds == scene->holds);
  CHECK(scene->asRecorded);
  CHECK(parseScene(sceneText(*scene, "/here"), "/here", "x.json")->asRecorded);
  CHECK(isMotionFile(scene->clip));
  CHECK(!isMotionFile("walk"));
}

TEST_CASE("a scene may ask for capillaries") {
  const auto scene = parseScene(
      R"({"capillaries": {"levels": 3, "edges": 8, "budget": 1000, "smallest": 2.5, "rules": "mine"}})",
      "/here", "x.json");
  REQUIRE(scene.ok());
  CHECK(scene->capillaries.levels == 3);
  CHECK(scene->capillaries.edges == 8);
  CHECK(scene->capillaries.budget == 1000);
  CHECK(scene->capillaries.smallest == 2.5f);
  CHECK(scene->capillaries.rules == "/here/mine");
  CHECK(messageOf(R"({"capillaries": {"levels": 7}})") ==
        "x.json: /capillaries/levels must be a whole number from 0 to 6");
  CHECK(messageOf(R"({"capillaries": {"levels": 1.5}})") ==
        "x.json: /capillaries/levels must be a whole number from 0 to 6");
  CHECK(messageOf(R"({"capillaries": {"edges": 4}})").find("must be 3, 5, 8, 10, or 0") != std::string::npos);
}

TEST_CASE("hidden vessels, colours, labels and kept views come back to the byte") {
  const std::string text = R"({
  "camera": {
    "orthographic": true
  },
  "look": {
    "preset": "atlas",
    "heart": true,
    "artery_opacity": 0.5,
    "bone_opacity": 0.25,
    "skin_opacity": 0.125,
    "colour": "radius",
    "legend": true
  },
  "hidden": [
    "a",
    "b \"c\""
  ],
  "labels": [
    "d"
  ],
  "views": {
    "1": {
      "position": [
        0.1,
        1.5,
        3.0
      ],
      "target": [
        0.0,
        1.0,
        0.0
      ],
      "angle": 30.0
    },
    "9": {
      "position": [
        1.0,
        2.0,
        3.0
      ],
      "target": [
        0.0,
        0.5,
        0.0
      ],
      "angle": 12.345,
      "orthographic": true
    }
  }
}
)";
  const auto scene = parseScene(text, "/here", "x.json");
  REQUIRE_MESSAGE(scene.ok(), scene.error().message);
  CHECK(scene->look.colour == "radius");
  CHECK(scene->look.legend);
  CHECK(scene->look.opacity.bones == 0.25f);
  CHECK_FALSE(scene->look.opacity.veins);
  CHECK(scene->camera.orthographic);
  CHECK(scene->hidden == std::vector<std::string>{"a", "b \"c\""});
  CHECK(scene->labels == std::vector<std::string>{"d"});
  REQUIRE(scene->views.size() == 2);
  CHECK(scene->views[1] == ViewChoice{9, {1, 2, 3}, {0, 0.5f, 0}, 12.345f, true});
  CHECK(sceneText(*scene, "/here") == text);
  CHECK(messageOf(R"({"look": {"bone_opacity": 2}})") ==
        "x.json: /look/bone_opacity must be a number from 0.0 to 1.0");
  CHECK(messageOf(R"({"look": {"colour": "mood"}})") ==
        "x.json: /look/colour must be kind, blood, region, radius, strain, bend or lumen");
  CHECK(messageOf(R"({"hidden": "aorta"})").find("/hidden must be a list of at most") != std::string::npos);
  CHECK(messageOf(R"({"labels": [1]})") == "x.json: /labels/0 must be a string");
  CHECK(messageOf(R"({"views": {"0": {}}})") ==
        "x.json: /views/0 is no view's number: they are called 1 to 9");
  CHECK(messageOf(R"({"views": {"1": {"position": [0, 0, 0]}}})") ==
        "x.json: /views/1 must have a position and a target");
  CHECK(messageOf(R"({"views": {"1": {"eye": 1}}})").find("/views/1/eye is not a known key") !=
        std::string::npos);
}

TEST_CASE("an empty scene is the default one") {
  const auto scene = parseScene("{}", "", "x.json");
  REQUIRE(scene.ok());
  CHECK(scene->body.empty());
  CHECK(scene->camera.view == "front");
}

TEST_CASE("scenes that people wrote: comments, and folders as on Windows") {
  test::TemporaryFolder folder;
  std::filesystem::create_directory(folder.path() / "my nets");
  REQUIRE(writeFileAtomically(folder.path() / "my nets" / "a.vasa", std::string("a")).ok());
  REQUIRE(writeFileAtomically(folder.path() / "b\\c.vasa", std::string("b")).ok());
  const auto scene = parseScene(R"({ // mine
    /* two of them */ "networks": ["my nets\\a.vasa", "b\\c.vasa"] })",
                                folder.path(), "x.json");
  if (!scene.ok()) FAIL(scene.error().message);
  CHECK(scene->networks == std::vector{folder.path() / "my nets/a.vasa", folder.path() / "b\\c.vasa"});
}

TEST_CASE("each fault is told with its place") {
  CHECK(messageOf(R"({"clip": "walk", "look": {"skin": true}, "clip": "run"})") ==
        "x.json: /clip is there twice; leave one of them out");
  CHECK(parseScene(R"({"views": {"1": {"position": [0, 0, 1], "target": [0, 0, 0]},
                                 "2": {"position": [0, 0, 1], "target": [0, 0, 0]}}})",
                   "", "x.json")
            .ok());
  const std::string trailing = messageOf(R"({"networks": ["a.vasa",]})");
  CHECK_MESSAGE(trailing.starts_with("x.json: is not valid JSON: parse error at line 1, column 24"),
                trailing);
  CHECK_MESSAGE(trailing.ends_with("commas between two things and not behind the last"), trailing);
  CHECK(messageOf("{").find("x.json: is not valid JSON") == 0);
  CHECK(messageOf("[1]") == "x.json: / must be an object");
  CHECK(
      messageOf(R"({"boddy": 1})") ==
      "x.json: /boddy is not a known key; use one of as_recorded, body, camera, capillaries, chosen, clip, edits, hidden, holds, joint_map, labels, look, networks, pose, time, views");
  CHECK(messageOf(R"({"body": 3})") == "x.json: /body must be a string");
  CHECK(messageOf(R"({"networks": "a"})") == "x.json: /networks must be a list of file names");
  CHECK(messageOf(R"({"networks": [1]})") == "x.json: /networks/0 must be a string");
  CHECK(messageOf(R"({"edits": ["a", ""]})").starts_with("x.json: /edits/1 must name a file"));
  CHECK(messageOf(R"({"camera": {"angle": 0}})").find("/camera/angle must be a number from 1.0 to 150.0") !=
        std::string::npos);
  CHECK(messageOf(R"({"camera": {"position": [1, 2]}})") ==
        "x.json: /camera/position must be a list of 3 numbers");
  CHECK(messageOf(R"({"camera": {"position": [1, 2, 1e99]}})").find("/camera/position/2") !=
        std::string::npos);
  CHECK(messageOf(R"({"camera": {"view": "below"}})") ==
        "x.json: /camera/view must be front, back, left, right or top");
  CHECK(messageOf(R"({"look": {"skin": 1}})") == "x.json: /look/skin must be true or false");
  CHECK(messageOf(std::string(100000, '[')).find("nested too deeply") != std::string::npos);
}
