// What a session leaves in files: scenes, exports, settings.
#include <doctest/doctest.h>

#include <algorithm>
#include <csignal>
#include <fstream>

#include "io/png.h"
#include "view/session.h"

using namespace vasa;
using namespace vasa::test;

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
