#include <doctest/doctest.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <fstream>

#include "cli/motion_text.h"
#include "cli/program.h"
#include "golden/compare.h"
#include "io/png.h"
#include "support/shared_data.h"
#include "view/virtual_display.h"

// vasa view on a display without a screen. The pictures that it must show are in tests/view/pictures;
// scripts/golden.sh writes them anew.

using namespace vasa;
using namespace vasa::test;

namespace {

// The script with OUT/ standing for a folder, in a file there.
std::filesystem::path scriptIn(const std::filesystem::path& folder, std::string text) {
  for (std::size_t at = 0; (at = text.find("OUT/", at)) != std::string::npos;)
    text.replace(at, 4, folder.string() + "/");
  const auto path = folder / "script.txt";
  std::ofstream(path) << text;
  return path;
}

ProgramOptions on(const VirtualDisplay& display, const TemporaryFolder& home) {
  static const TemporaryFolder cache;  // the driver compiles shaders once for all sessions
  return {.environment = {display.variable(), "XDG_CONFIG_HOME=" + home.path().string(),
                          "XDG_CACHE_HOME=" + cache.path().string()},
          .folder = home.path().string()};
}

void checkPicture(const std::filesystem::path& found, const std::string& name) {
  CAPTURE(name);
  const auto picture = readPng(found);
  REQUIRE_MESSAGE(picture, (picture ? "" : picture.error().message));
  const auto stored = std::filesystem::path("tests/view/pictures") / (name + ".png");
  if (std::getenv("VASA_WRITE_GOLDEN")) {
    std::filesystem::create_directories(stored.parent_path());
    REQUIRE(writePng(stored, *picture));
    return;
  }
  const auto wanted = readPng(stored);
  REQUIRE_MESSAGE(wanted, (wanted ? "" : wanted.error().message));
  REQUIRE(wanted->width == picture->width);
  REQUIRE(wanted->height == picture->height);
  const golden::Difference difference = golden::compare(*wanted, *picture);
  CAPTURE(difference.mean);
  CAPTURE(difference.changed);
  CHECK(golden::same(difference));
}

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

TEST_CASE(
    "a session saves under another name what it hides, names and keeps, exports, and opens that again by the dialog") {
  const VirtualDisplay display;
  const TemporaryFolder folder;
  const auto run = [&](const std::string& text) {
    return runProgram({"view", "--clip", "stand", "--size", "800x600", "--json", "--out",
                       folder.path().string(), "--script", scriptIn(folder.path(), text)},
                      on(display, folder));
  };
  const std::string press = "\nlet control\nframes 3\n";
  const auto first =
      run("settle\nmove 320 300\npress right\nrelease right\nsettle\nkey escape\nkey n\nkey h\nkey k\n"
          "hold control\nhold shift\nkey 4\nkey s\nlet shift" +
          press +
          "type second\nkey enter\nsettle\n"
          "hold control\nkey e" +
          press +
          "type small.csv\nkey enter\nsettle\n"
          "hold control\nkey e" +
          press +
          "type small.stl\nkey enter\nsettle\n"
          "hold control\nkey e" +
          press + "type small.png\nkey enter\nsettle\n");
  REQUIRE_MESSAGE(first.exit == 0, first.err);
  CHECK(first.json()["files"].size() == 4);
  const std::string saved = contentOf(folder.path() / "second.json");
  const auto scene = nlohmann::json::parse(saved, nullptr, false);
  REQUIRE(scene.is_object());
  CHECK(scene["hidden"].size() == 1);
  CHECK(scene["labels"] == scene["hidden"]);
  CHECK(scene["look"]["colour"] == "blood");
  CHECK(scene["look"]["legend"] == true);
  CHECK(scene["views"].contains("4"));
  CHECK(readPng(folder.path() / "small.png")->width == 1920);
  CHECK(std::ranges::count(contentOf(folder.path() / "small.csv"), '\n') > 959 * 100);  // of the whole clip
  const auto bytes = contentOf(folder.path() / "small.stl");
  CHECK(bytes.size() > 84);
  CHECK((bytes.size() - 84) % 50 == 0);

  std::filesystem::remove(folder.path() / "second.vedit");
  const auto again = run("settle\nhold control\nkey o" + press +
                         "type sec\nkey enter\nsettle\nhold control\nkey s\nlet control\n");
  REQUIRE_MESSAGE(again.exit == 0, again.err);
  REQUIRE(again.json()["loads"].size() == 2);
  CHECK(again.json()["loads"][1]["outcome"] == "opened");
  REQUIRE(again.json()["files"].size() == 1);
  CHECK(std::filesystem::path(again.json()["files"][0].get<std::string>()).filename() == "second.json");
  CHECK(contentOf(folder.path() / "second.json") == saved);

  // A script writes below its folder only; what is not saved keeps what is dropped waiting, Esc stays.
  CHECK(run("settle\nhold control\nhold shift\nkey s\nlet shift" + press +
            "type /tmp/elsewhere\nkey enter\nsettle\n")
            .exit == 3);
  const auto asked = run(
      "settle\nmove 320 300\npress right\nrelease right\nsettle\nkey escape\nkey h\ndrop OUT/second.json\nsettle\nkey escape\nsettle\n");
  CHECK(asked.exit == 0);
  CHECK(asked.json()["loads"].size() == 1);
}

TEST_CASE("a motion that is opened leaves edits, undoing and the scene's name; other vessels do not") {
  const VirtualDisplay display;
  const TemporaryFolder folder;
  for (const char* name : {"first.bvh", "second.bvh"}) std::ofstream(folder.path() / name) << motionText();
  REQUIRE(runProgram({"export", "-o", (folder.path() / "lines.vtp").string()}).exit == 0);
  const auto control = [](const std::string& keys) {
    return "hold control\n" + keys + "let control\nframes 3\n";
  };
  const std::string removeArtery = control("key f\n") +
                                   "type left femoral artery\nframes 2\nkey enter\nsettle\nmove 320 300\n"
                                   "key e\nhold shift\nkey delete\nlet shift\nsettle\n",
                    save = control("key s\n");
  const auto outcome = runProgram(
      {"view", "--clip", "stand", "--size", "800x600", "--json", "--out", folder.path().string(), "--script",
       scriptIn(folder.path(),
                "settle\n" + removeArtery + "drop OUT/first.bvh\nsettle\n" + save + control("key z\n") +
                    "settle\n" + control("hold shift\nkey s\nlet shift\n") +
                    "type undone\nkey enter\nsettle\n" + control("key y\n") + "settle\n" + save +
                    "drop OUT/second.bvh\nsettle\n" + save + "drop OUT/lines.vtp\nsettle\n" + save)},
      on(display, folder));
  REQUIRE_MESSAGE(outcome.exit == 0, outcome.err);
  const auto report = outcome.json();
  REQUIRE(report["loads"].size() == 4);
  for (const auto& load : report["loads"]) CHECK(load["outcome"] == "opened");
  std::vector<std::string> names;
  for (const auto& file : report["files"])
    names.push_back(std::filesystem::path(file.get<std::string>()).filename().string());
  CHECK(names == std::vector<std::string>{"vasa_001.json", "undone.json", "undone.json", "undone.json",
                                          "vasa_002.json"});
  const auto saved = [&](const char* name) {
    return nlohmann::json::parse(contentOf(folder.path() / name), nullptr, false);
  };
  CHECK(saved("vasa_001.json")["clip"] == "first.bvh");
  CHECK(contentOf(folder.path() / "vasa_001.vedit").starts_with("delete "));
  CHECK(saved("undone.json")["clip"] == "second.bvh");
  CHECK(contentOf(folder.path() / "undone.vedit").starts_with("delete "));
  CHECK(saved("vasa_002.json")["networks"] == nlohmann::json{"lines.vtp"});
  CHECK_FALSE(saved("vasa_002.json").contains("edits"));
}

TEST_CASE("what is being opened when a file is refused is opened, and the script fails as the file did") {
  const VirtualDisplay display;
  const TemporaryFolder folder;
  std::ofstream(folder.path() / "bad.json") << "{";
  struct Refused {
    const char *name, *told;
    int exit;
  };
  for (const auto& [name, told, exit] :
       {Refused{"absent.json", "absent.json", 6},
        {"bad.json", "bad.json: is not valid JSON", 3},
        {"table.csv", "table.csv: this is no kind of file that the app opens; open a scene", 2}}) {
    const std::string text = std::string("drop OUT/") + name + "\npicture OUT/" + name + ".png\n";
    const auto outcome = runProgram({"view", "--clip", "stand", "--size", "400x300", "--json", "--out",
                                     folder.path().string(), "--script", scriptIn(folder.path(), text)},
                                    on(display, folder));
    CHECK(outcome.exit == exit);
    CHECK_MESSAGE(outcome.err.find(told) != std::string::npos, outcome.err);
    CHECK(readPng(folder.path() / (std::string(name) + ".png")));
    const auto loads = outcome.json()["loads"];
    REQUIRE(loads.size() == 3);
    CHECK(loads[0]["outcome"] == "cancelled");
    CHECK(loads[2]["title"] == loads[0]["title"]);
    CHECK(loads[2]["outcome"] == "opened");
  }
}

TEST_CASE("a script's picture waits for what is being opened, and fails where nothing is") {
  const VirtualDisplay display;
  const TemporaryFolder folder;
  const auto run = [&](const std::string& text, const std::string& opened) {
    return runProgram({"view", opened, "--size", "400x300", "--out", folder.path().string(), "--script",
                       scriptIn(folder.path(), text)},
                      on(display, folder));
  };
  const auto scene = folder.path() / "stand.json";
  std::ofstream(scene) << R"({"clip": "stand"})";
  const auto waited = run("picture OUT/early.png\nclose\n", scene.string());
  CHECK_MESSAGE(waited.exit == 0, waited.err);
  CHECK(readPng(folder.path() / "early.png"));
  const auto slow = (folder.path() / "vessels.obj").string();
  REQUIRE(runProgram({"export", "--quads", "10x8", "-o", slow}).exit == 0);
  const auto cancelled = run("key escape\npicture OUT/none.png\n", slow);
  CHECK(cancelled.exit == 1);
  CHECK_MESSAGE(cancelled.err.find("none.png: there is nothing to draw") != std::string::npos, cancelled.err);
  CHECK_FALSE(std::filesystem::exists(folder.path() / "none.png"));
}

TEST_CASE("a script saves no scene that lies elsewhere than its pictures") {
  const VirtualDisplay display;
  const TemporaryFolder folder;
  const auto out = folder.path() / "out", scene = folder.path() / "scene.json";
  std::filesystem::create_directories(out);
  const std::string text = R"({"clip": "stand"})";
  std::ofstream(scene) << text;
  const auto save = [&](const std::filesystem::path& opened) {
    const auto script = scriptIn(folder.path(), "settle\nhold control\nkey s\nlet control\nframes 2\n");
    return runProgram(
        {"view", opened.string(), "--size", "400x300", "--out", out.string(), "--script", script},
        on(display, folder));
  };
  const auto refused = save(scene);
  CHECK(refused.exit == 3);
  CHECK_MESSAGE(
      refused.err.find(scene.string() + ": a script writes below " + out.string()) != std::string::npos,
      refused.err);
  CHECK(contentOf(scene) == text);
  std::ofstream(out / "inner.json") << text;
  const auto saved = save(out / "inner.json");
  CHECK_MESSAGE(saved.exit == 0, saved.err);
  CHECK(contentOf(out / "inner.json") != text);
}

TEST_CASE(
    "opening goes on beside a living window, and Esc ends it within a step; a still's capillaries come in slices") {
  const VirtualDisplay display;
  const TemporaryFolder folder;
  REQUIRE(runProgram({"export", "--quads", "10x8", "-o", (folder.path() / "vessels.obj").string()}).exit ==
          0);
  const auto scene = folder.path() / "scene.json";
  std::ofstream(scene) << R"({"body": ")" + humanBody().string() + R"(", "networks": [")" +
                              humanVessels().string() + R"("], "capillaries": {"levels": 1}})";
  const std::string text =
      "settle\ndrop OUT/vessels.obj\nlive 1.5\nwindow OUT/opening.png\nkey escape\nsettle\nwindow OUT/still.png\n";
  const auto outcome = runProgram(
      {"view", scene.string(), "--size", "640x480", "--json", "--script", scriptIn(folder.path(), text)},
      on(display, folder));
  REQUIRE_MESSAGE(outcome.exit == 0, outcome.err);
  const auto report = outcome.json();
  CHECK(report["still_slices"].get<int>() > 4);  // 33,695 stems, 8,192 at most in each
  REQUIRE(report["loads"].size() == 2);
  const auto& load = report["loads"][1];
  CHECK(load["outcome"] == "cancelled");
  CHECK(load["frames"].get<int>() > 8);
  REQUIRE(report["stop_ms"].size() == 1);
  MESSAGE("opening: " << load["frames"] << " pictures of the window in " << load["seconds"]
                      << " s, the longest " << load["longest_ms"] << " ms; stopped after "
                      << report["stop_ms"][0] << " ms");
  CHECK(report["stop_ms"][0].get<double>() < 1000);
  CHECK(load["longest_ms"].get<double>() < 1000);
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

TEST_CASE("without a display there is a message with a remedy, and no device is asked for") {
  const auto outcome = runProgram({"view"}, {.environment = {"DISPLAY="}});
  CHECK(outcome.exit == 1);
  CHECK(outcome.err.find("xvfb-run") != std::string::npos);
  CHECK(outcome.out.empty());
}

TEST_CASE("what is wrong is told before a window opens, or by its closing") {
  const VirtualDisplay display;
  const TemporaryFolder folder;
  CHECK(runProgram({"view", "--script", "no-such-script.txt"}, on(display, folder)).exit == 6);
  CHECK(runProgram({"view", "--look", "sepia"}, on(display, folder)).exit == 2);
  CHECK(runProgram({"view", "--size", "big"}, on(display, folder)).exit == 2);
  CHECK(runProgram({"view", "--device", "no such device"}, on(display, folder)).exit == 4);
  std::ofstream(folder.path() / "bad.json") << "{ \"body\": 3 }";
  CHECK(runProgram({"view", (folder.path() / "bad.json").string()}, on(display, folder)).exit == 3);
  const auto missing =
      runProgram({"view", "--body", "none.glb", "--network", "none.vasa"}, on(display, folder));
  CHECK(missing.exit == 6);
  const auto recorded = [&](const std::string& file) {
    const auto script = scriptIn(folder.path(), "settle\nwindow OUT/late.png\n").string();
    return runProgram({"view", "--size", "400x300", "--script", script, "--record-script", file},
                      on(display, folder));
  };
  const std::string nowhere = (folder.path() / "none" / "session.txt").string();
  const auto early = recorded(nowhere);
  CHECK(early.exit == 6);
  CHECK_MESSAGE(early.err.find("error: " + nowhere) == 0, early.err);
  CHECK(!std::filesystem::exists(folder.path() / "late.png"));
  const auto full = recorded("/dev/full");
  CHECK(full.exit == 6);
  CHECK_MESSAGE(full.err.find("/dev/full") == full.err.rfind("/dev/full"), full.err);
}

TEST_CASE("vessels may be named as they are beside a body or other vessels") {
  const VirtualDisplay display;
  const TemporaryFolder folder;
  const auto lines = folder.path() / "lines.swc";
  std::ofstream(lines) << "1 10 0 1 0 0.004 -1\n2 10 0 1.1 0 0.004 1\n";
  const std::string save =
      "settle\nhold control\nhold shift\nkey s\nlet shift\nlet control\nframes 3\ntype kept.json\nkey enter\nsettle\n";
  const auto networksOf = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments{
        "view",  lines.string(),         "--size",   "400x300",
        "--out", folder.path().string(), "--script", scriptIn(folder.path(), save)};
    arguments.insert(arguments.end(), more.begin(), more.end());
    std::filesystem::remove(folder.path() / "kept.json");  // what is there is asked about
    const auto outcome = runProgram(arguments, on(display, folder));
    REQUIRE_MESSAGE(outcome.exit == 0, outcome.err);
    return nlohmann::json::parse(contentOf(folder.path() / "kept.json"))["networks"].size();
  };
  CHECK(networksOf({"--body", humanBody().string()}) == 1);
  CHECK(networksOf({"--network", humanVessels().string()}) == 2);
  const auto twice =
      runProgram({"view", humanBody().string(), "--body", humanBody().string(), "--network", "a.vasa"},
                 on(display, folder));
  CHECK(twice.exit == 2);
  CHECK_MESSAGE(twice.err.find("--body gives another one") != std::string::npos, twice.err);
  const auto missing =
      runProgram({"view", "missing.glb", "--body", humanBody().string()}, on(display, folder));
  CHECK(missing.exit == 6);
  CHECK_MESSAGE(missing.err.find("missing.glb: cannot open") != std::string::npos, missing.err);
}

TEST_CASE("a session that a signal ends leaves what was not saved in a scene of its own") {
  const VirtualDisplay display;
  for (int after = 4000;; after *= 2) {
    const TemporaryFolder home;
    // A view is kept under a number, and then the body walks.
    const auto script = scriptIn(home.path(),
                                 "settle\nhold control\nhold shift\nkey 4\nlet shift\nlet control\nframes 2\n"
                                 "window seen.png\nkey space\nframes 100000\n");
    ProgramOptions options = on(display, home);
    options.signalAfterMs = after;
    options.signal = SIGTERM;
    const Outcome ended = runProgram({"view", "--clip", "walk", "--script", script.string(), "--size",
                                      "400x320", "--out", home.path().string()},
                                     options);
    INFO(ended.err);
    REQUIRE(ended.exit == 128 + SIGTERM);
    if (!std::filesystem::exists(home.path() / "seen.png")) {  // on a busy machine
      REQUIRE(after < 100000);
      continue;
    }
    const auto scene = home.path() / "vasa_001.json";
    CHECK(ended.err.find("what was not saved is in " + scene.string()) != std::string::npos);
    const Outcome again = runProgram({"info", scene.string()}, on(display, home));
    CHECK_MESSAGE(again.exit == 0, again.err);
    CHECK(contentOf(scene).find("\"views\"") != std::string::npos);
    break;
  }
}

TEST_CASE("settings are kept when a person ends the session, and only then") {
  const VirtualDisplay display;
  const TemporaryFolder home;
  auto options = on(display, home);
  const auto scripted =
      runProgram({"view", "--size", "400x300", "--script", scriptIn(home.path(), "settle\n")}, options);
  CHECK(scripted.exit == 0);
  CHECK_FALSE(std::filesystem::exists(home.path() / "vasa"));
  options.signalAfterMs = 6000;
  const auto outcome = runProgram({"view", "--size", "410x310"}, options);
  CHECK(outcome.exit == 130);
  const auto kept = nlohmann::json::parse(contentOf(home.path() / "vasa" / "view.json"), nullptr, false);
  REQUIRE(kept.is_object());
  CHECK(kept["width"] == 410);
  CHECK(listOf(home.path() / "vasa") == std::vector<std::string>{"view.json"});
}
