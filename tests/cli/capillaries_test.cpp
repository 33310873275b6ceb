#include <doctest/doctest.h>

#include <fstream>

#include "cli/program.h"
#include "io/png.h"
#include "support/shared_data.h"

using namespace vasa;
using namespace vasa::test;

namespace {

Outcome renderTo(const std::filesystem::path& picture, std::initializer_list<std::string> more) {
  std::vector<std::string> arguments{"render",   "--clip", "fist",    "--frames",      "20",   "--focus",
                                     "LeftHand", "--size", "160x160", "--hide",        "skin", "--quads",
                                     "4x2",      "--json", "-o",      picture.string()};
  arguments.insert(arguments.end(), more);
  return runProgram(arguments);
}

}  // namespace

TEST_CASE("capillaries grow from the built-in human, the same again, more with each generation") {
  TemporaryFolder folder;
  std::int64_t before = 0;
  for (const char* levels : {"1", "2"}) {
    const auto outcome = renderTo(folder.path() / (std::string(levels) + ".png"), {"--capillaries", levels});
    REQUIRE_MESSAGE(outcome.exit == 0, outcome.err);
    const auto report = outcome.json();
    CHECK(report["capillaries"].get<std::int64_t>() > 2 * before);
    CHECK(report["capillary_bytes"].get<std::int64_t>() < 24'000'000);
    before = report["capillaries"].get<std::int64_t>();
  }
  REQUIRE(renderTo(folder.path() / "again.png", {"--capillaries", "2", "--threads", "1"}).exit == 0);
  REQUIRE(renderTo(folder.path() / "other.png", {"--capillaries", "2", "--seed", "2"}).exit == 0);
  const auto two = readPng(folder.path() / "2.png"), again = readPng(folder.path() / "again.png"),
             other = readPng(folder.path() / "other.png");
  REQUIRE((two.ok() && again.ok() && other.ok()));
  CHECK(two->rgba == again->rgba);
  CHECK(two->rgba != other->rgba);
}

TEST_CASE("a budget holds") {
  TemporaryFolder folder;
  const auto outcome = renderTo(
      folder.path() / "a.png", {"--capillaries", "2", "--capillary-budget", "500", "--capillary-edges", "8"});
  REQUIRE_MESSAGE(outcome.exit == 0, outcome.err);
  CHECK(outcome.json()["capillaries"].get<int>() <= 500);
  CHECK(outcome.json()["capillaries"].get<int>() > 400);
}

TEST_CASE("what is wrong with capillaries is told") {
  TemporaryFolder folder;
  const auto picture = folder.path() / "a.png";
  CHECK(renderTo(picture, {"--capillaries", "7"}).exit == 2);
  CHECK(renderTo(picture, {"--capillaries", "2", "--capillary-edges", "6"}).exit == 2);
  CHECK(renderTo(picture, {"--capillaries", "2", "--growth", (folder.path() / "nothing").string()}).exit ==
        6);
  std::ofstream(folder.path() / "capillaries.lsys") << "system a\naxiom S\ndraw S\nS -> F [@3 S]\n";
  std::ofstream(folder.path() / "regions.csv")
      << "region,system,joints,vessels,kinds,thinnest_mm,thickest_mm,bed_mm,surface\nall,b,,,,0,3,20,\n";
  auto outcome = renderTo(picture, {"--capillaries", "2", "--growth", folder.path().string()});
  CHECK(outcome.exit == 3);
  CHECK(outcome.err.find("capillaries.lsys:4: '@3' wants a number from 0.02 to 1") != std::string::npos);
  std::ofstream(folder.path() / "capillaries.lsys") << "system a\naxiom S\ndraw S\nS -> F [@1 S]\n";
  outcome = renderTo(picture, {"--capillaries", "2", "--growth", folder.path().string()});
  CHECK(outcome.exit == 3);
  CHECK(outcome.err.find("regions.csv:2: there is no system 'b'; use one of -, a") != std::string::npos);
}

TEST_CASE("info counts what would grow, without drawing it") {
  const auto outcome = runProgram({"info", "--json"});
  REQUIRE_MESSAGE(outcome.exit == 0, outcome.err);
  const auto report = outcome.json()["capillaries"];
  CHECK(report["curves_1_levels"] == report["trees"]);
  CHECK(report["bytes_per_bed"] == 304);
  CHECK(report["curves_3_levels"].get<std::int64_t>() > 200'000);
  CHECK(report["regions"].size() >= 5);
}

TEST_CASE("a scene file may ask for capillaries, and the command line may have it otherwise") {
  TemporaryFolder folder;
  const auto scene = folder.path() / "scene.json";
  std::ofstream(scene) << R"({"body": ")" + humanBody().string() + R"(", "networks": [")" +
                              humanVessels().string() + R"("], "capillaries": {"levels": 1}})";
  const auto render = [&](std::initializer_list<std::string> more) {
    std::vector<std::string> arguments{"render", scene.string(), "--size",
                                       "64x64",  "--hide",       "skin",
                                       "--json", "-o",           (folder.path() / "a.png").string()};
    arguments.insert(arguments.end(), more);
    return runProgram(arguments).json()["capillaries"].get<std::int64_t>();
  };
  const auto asked = render({});
  CHECK(asked > 0);
  CHECK(render({"--capillary-budget", "100"}) < asked);
  CHECK(render({"--capillaries", "0"}) == 0);

  std::ofstream(scene) << R"({"capillaries": {"levels": 1, "rules": "absent"}})";
  const auto absent = runProgram({"info", scene.string()});
  CHECK(absent.exit == 3);
  CHECK(absent.err.find("scene.json: names ") != std::string::npos);
  CHECK(absent.err.find("absent, which is not there") != std::string::npos);
  const auto rules = std::filesystem::path("data/growth");
  CHECK(runProgram({"render", scene.string(), "--size", "64x64", "--growth", rules.string(), "-o",
                    (folder.path() / "b.png").string()})
            .exit == 0);
}
