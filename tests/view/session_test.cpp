// What a person does and sees, from the first picture to the last.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstdio>
#include <fstream>

#include "io/png.h"
#include "view/session.h"

using namespace vasa;
using namespace vasa::test;

namespace {

// As ffprobe counts them.
int videoFrames(const std::filesystem::path& video) {
  const std::string command =
      "ffprobe -v error -count_frames -select_streams v -show_entries stream=nb_read_frames -of csv=p=0 '" +
      video.string() + "'";
  FILE* pipe = popen(command.c_str(), "r");
  REQUIRE(pipe);
  int frames = -1;
  CHECK(std::fscanf(pipe, "%d", &frames) == 1);
  pclose(pipe);
  return frames;
}

}  // namespace

TEST_CASE(
    "a session opens, poses, plays, turns, picks, searches, measures, cuts, writes pictures and a video, resizes 50 times, opens "
    "what is dropped and quits, and validation is silent") {
  const VirtualDisplay display;
  const TemporaryFolder folder;
  REQUIRE(runProgram({"export", "-o", (folder.path() / "lines.vtp").string()}).exit == 0);
  std::ofstream(folder.path() / "bad.swc") << "1 1 0 0 0 nonsense -1\n";
  std::string text = contentOf("tests/view/session.txt");
  for (int i = 0; i < 50; ++i)
    text += "resize " + std::to_string(400 + 13 * (i * 7 % 50)) + " " +
            std::to_string(300 + 9 * (i * 11 % 50)) + "\n";
  text += "resize 960 640\nkey 1\nkey home\nsettle\nwindow OUT/resized.png\n";
  // Panels are drawn where they change; after a change of size all of them are.
  text +=
      "key space\nframes 4\nkey space\nsettle\nwindow OUT/changed.png\nresize 900 600\nframes 2\nresize 960 640\nsettle\nwindow OUT/anew.png\n";
  text +=
      "drop OUT/bad.swc\nsettle\ndrop OUT/lines.vtp\nsettle\nwindow OUT/dropped.png\nmove 320 269\npress left\nrelease left\nsettle\n";
  auto options = on(display, folder);
  const auto outcome = runProgram({"view", "--clip", "walk", "--size", "960x640", "--validate", "--json",
                                   "--script", scriptIn(folder.path(), text)},
                                  options);
  CHECK_MESSAGE(outcome.exit == 3, outcome.err);
  // Nothing but in which unit the dropped lines were read, and at the end what could not be.
  CHECK_MESSAGE(outcome.err.find("lines.vtp: read as millimetres") != std::string::npos, outcome.err);
  CHECK_MESSAGE(outcome.err.find("bad.swc:1") != std::string::npos, outcome.err);
  CHECK_MESSAGE(std::ranges::count(outcome.err, '\n') == 2, outcome.err);
  const auto report = outcome.json();
  CHECK(report["validation_messages"] == 0);
  CHECK(report["files"].size() == 15);
  CHECK(report["pictures"].get<int>() > 60);  // each new size is drawn
  CHECK(report["selected"] != "");
  CHECK(report["width"] == 640);  // the panels have the rest
  for (const char* name : {"posed", "measured", "searched"})
    checkPicture(folder.path() / (std::string(name) + ".png"), name);
  CHECK(contentOf(folder.path() / "changed.png") == contentOf(folder.path() / "anew.png"));
  CHECK(readPng(folder.path() / "picked.png")->width == 960);
  CHECK(readPng(folder.path() / "vasa_001.png")->width == 640);
  CHECK(report["video_frames"].get<int>() >= 10);
  CHECK(videoFrames(folder.path() / "vasa_001.mp4") == report["video_frames"].get<int>());
  REQUIRE(report["loads"].size() == 3);
  CHECK(report["loads"][1]["outcome"].get<std::string>().find("bad.swc:1") != std::string::npos);
  CHECK(report["loads"][2]["title"] == "lines.vtp");
  CHECK(report["loads"][2]["outcome"] == "opened");
}

TEST_CASE("a session pulls a wrist and an ankle, finds femoral arteries by a few letters and shows strain") {
  const VirtualDisplay display;
  const TemporaryFolder folder;
  const std::string text =
      "settle\nkey p\nmove 403 316\nframes 2\npress left\nmove 424 267\nmove 443 210\nframes 2\nwindow OUT/held.png\n"
      "release left\nmove 348 538\npress left\nmove 377 438\nframes 2\nrelease left\nsettle\n"
      "hold control\nkey c\nkey z\nkey z\nkey v\nlet control\nkey p\nsettle\n"  // as before, through the
                                                                                // clipboard
      "key o\nmove 100 50\npress left\nrelease left\nframes 2\ntype femrl art\nsettle\n"
      "move 100 106\npress left\nrelease left\nsettle\nkey down\nhold shift\nkey down\nlet shift\n"
      "hold control\nkey z\nkey y\nkey s\nlet control\nkey k\nkey k\nkey k\nsettle\nwindow OUT/found.png\n";
  const auto outcome =
      runProgram({"view", "--clip", "stand", "--size", "960x640", "--validate", "--json", "--out",
                  folder.path().string(), "--script", scriptIn(folder.path(), text)},
                 on(display, folder));
  CHECK_MESSAGE(outcome.exit == 0, outcome.err);
  CHECK(outcome.json()["validation_messages"] == 0);
  CHECK(outcome.json()["selected"].get<std::string>().find("femoral artery") != std::string::npos);
  const auto scene = nlohmann::json::parse(contentOf(folder.path() / "vasa_001.json"), nullptr, false);
  REQUIRE(scene.is_object());
  CHECK(scene["pose"].contains("LeftArm"));
  CHECK(scene["pose"].contains("LeftUpLeg"));
  CHECK(scene["pose"].contains("LeftLeg"));
  CHECK_FALSE(scene["pose"].contains("LeftForeArmRoll"));
  checkPicture(folder.path() / "held.png", "held");
  checkPicture(folder.path() / "found.png", "found");
}

TEST_CASE(
    "a session at 800x600 and one with letters twice as large have room for menus, help and what a click offers") {
  const VirtualDisplay display;
  const TemporaryFolder folder;
  const auto run = [&](const std::string& size, const std::string& scale, const std::string& text) {
    const auto outcome = runProgram({"view", "--clip", "stand", "--size", size, "--ui-scale", scale,
                                     "--validate", "--json", "--script", scriptIn(folder.path(), text)},
                                    on(display, folder));
    REQUIRE_MESSAGE(outcome.exit == 0, outcome.err);
    CHECK(outcome.json()["validation_messages"] == 0);
  };
  run("800x600", "1",
      "settle\nmove 110 15\npress left\nrelease left\nframes 3\nwindow OUT/menus.png\nkey escape\nkey f1\nframes 3\n"
      "window OUT/help.png\n");
  run("1600x1200", "2",
      "settle\nmove 640 600\npress right\nrelease right\nsettle\nwindow OUT/context.png\nkey escape\nkey n\nkey k\n"
      "frames 2\n");
  run("800x600", "2",
      "settle\nhold control\nkey f\nlet control\nframes 2\ntype abdominal aorta\nkey enter\nframes 2\nkey e\n"
      "settle\nwindow OUT/narrow.png\nkey o\nsettle\nwindow OUT/narrow_list.png\n");
  for (const char* name : {"menus", "help", "context", "narrow", "narrow_list"})
    checkPicture(folder.path() / (std::string(name) + ".png"), name);
}

TEST_CASE("on a high-DPI screen window, panels and texts are as large as on an ordinary one") {
  const TemporaryFolder folder;
  const std::string text = "settle\nwindow OUT/large.png\n";
  {
    const VirtualDisplay display;
    const auto outcome = runProgram({"view", "--ui-scale", "2", "--size", "1920x1280", "--json", "--script",
                                     scriptIn(folder.path(), text)},
                                    on(display, folder));
    REQUIRE_MESSAGE(outcome.exit == 0, outcome.err);
    CHECK(outcome.json()["width"] == 1920 - 2 * 320);
    CHECK(outcome.json()["height"] == 1280 - 2 * (30 + 46));
    checkPicture(folder.path() / "large.png", "large");
    CHECK(runProgram({"view", "--ui-scale", "9"}, on(display, folder)).exit == 2);
  }
  const VirtualDisplay dense(192);  // the window's own choice, of a person's session
  auto options = on(dense, folder);
  options.signalAfterMs = 4000;
  CHECK(runProgram({"view"}, options).exit == 130);
  const auto kept = nlohmann::json::parse(contentOf(folder.path() / "vasa" / "view.json"), nullptr, false);
  REQUIRE(kept.is_object());
  CHECK(kept["width"] == 2560);
  CHECK(kept["height"] == 1440);
  CHECK(runProgram({"view"}, options).exit == 130);
  CHECK(nlohmann::json::parse(contentOf(folder.path() / "vasa" / "view.json"), nullptr, false)["width"] ==
        2560);  // no larger each time
}

TEST_CASE("a recorded session does the same again") {
  const VirtualDisplay display;
  const TemporaryFolder folder;
  const auto recorded = folder.path() / "recorded.txt";
  const std::string text =
      "settle\nkey tab\nkey 3\nmove 100 100\npress left\nmove 140 120\nrelease left\nfrayed";
  const auto wrong = runProgram({"view", "--script", scriptIn(folder.path(), text)}, on(display, folder));
  CHECK(wrong.exit == 3);
  CHECK(wrong.err.find("script.txt:8: 'frayed'") != std::string::npos);
  const std::string start = "settle\n", end = "settle\nwindow OUT/end.png\n";
  const std::string middle =
      "key tab\nkey 3\nmove 100 100\npress left\nmove 140 120\nrelease left\nframes 2\n";
  const auto session = [&](const std::string& script, std::vector<std::string> more) {
    std::vector<std::string> arguments{"view",   "--size",   "400x300",
                                       "--json", "--script", scriptIn(folder.path(), script)};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const auto outcome = runProgram(arguments, on(display, folder));
    REQUIRE_MESSAGE(outcome.exit == 0, outcome.err);
    return readPng(folder.path() / "end.png");
  };
  const auto first = session(start + middle + end, {"--record-script", recorded.string()});
  const auto again = session(start + contentOf(recorded) + end, {});
  REQUIRE(first);
  REQUIRE(again);
  CHECK(first->rgba == again->rgba);
}
