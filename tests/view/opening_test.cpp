// What is opened beside what is there, and when.
#include <doctest/doctest.h>

#include <fstream>

#include "cli/motion_text.h"
#include "io/png.h"
#include "view/session.h"

using namespace vasa;
using namespace vasa::test;

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
