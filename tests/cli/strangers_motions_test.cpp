#include <doctest/doctest.h>

#include "body/doll.h"
#include "cli/program.h"
#include "cli/strangers.h"
#include "io/bvh.h"
#include "support/shared_data.h"

using namespace vasa;
using namespace vasa::test;

// Motions of others, made here, through the program.

TEST_CASE("info tells what a motion file holds and how its joints are understood") {
  const TemporaryFolder folder;
  const auto file =
      writeInto(folder, "odd.bvh", dollMotion({"daz", DollDialect::Zero::oneAxis, 100, true, false}, 4));
  const auto outcome = runProgram({"info", file, "--joints", "--json"});
  REQUIRE_MESSAGE(outcome.exit == 0, outcome.err);
  const auto report = outcome.json();
  CHECK(report["kind"] == "motion");
  CHECK(report["frames"] == 4);
  CHECK(report["names"] == "words");
  CHECK(report["parts_known"] == 14);
  CHECK(report["up"] == "+Z");
  CHECK(report["metres_a_unit"].get<double>() == doctest::Approx(0.01));
  CHECK(report["stands_in"].get<std::string>().starts_with("frame"));
  CHECK(report["joint"][0]["part"] == "hips");
  CHECK(report["joint"].size() == report["joints"].get<std::size_t>());
  const auto thing =
      runProgram({"info",
                  writeInto(folder, "thing.bvh",
                            "HIERARCHY\nROOT a\n{\nOFFSET 0 0 0\nCHANNELS 3 Zrotation Yrotation Xrotation\n"
                            "End Site\n{\nOFFSET 0 1 0\n}\n}\nMOTION\nFrames: 1\nFrame Time: 0.03\n0 0 0\n"),
                  "--json"});
  REQUIRE_MESSAGE(thing.exit == 0, thing.err);
  CHECK(thing.json()["metres_a_unit"].is_null());
  const auto body = runProgram({"info", humanBody().string(), "--joints", "--json"}).json();
  CHECK(body["joint"].size() == body["joints"].get<std::size_t>());
  CHECK(body["parts_known"] == 14);
}

TEST_CASE("several people, swapped sides and a root in another unit are told where a motion is read") {
  const TemporaryFolder folder;
  const auto told = [&](const std::string& text) {
    const auto outcome = runProgram({"info", writeInto(folder, "odd.bvh", text)});
    CHECK_MESSAGE(outcome.exit == 0, outcome.err);
    return outcome.err;
  };
  const DollDialect walk{.family = "cmu", .unitsAMetre = 100, .glides = 0};
  const std::string one = dollMotion(walk, 48);
  CHECK(told(one).empty());
  DollDialect metres = walk;
  metres.rootTimes = 0.01;
  CHECK_MESSAGE(told(dollMotion(metres, 48)).find("the way is taken 100 times as long") != std::string::npos,
                told(dollMotion(metres, 48)));
  std::string swapped = one;
  for (std::size_t at = 0; (at = swapped.find_first_of("LR", at)) != swapped.npos; ++at) {
    const bool left = swapped.compare(at, 4, "Left") == 0, right = swapped.compare(at, 5, "Right") == 0;
    if (left || right) swapped.replace(at, left ? 4 : 5, left ? "Right" : "Left");
  }
  CHECK_MESSAGE(told(swapped).find("sides seem swapped") != std::string::npos, told(swapped));
  // Twice the hierarchy, and each row twice.
  const std::size_t motion = one.find("MOTION"), rows = one.find('\n', one.find("Frame Time")) + 1;
  std::string two = one.substr(0, motion) + one.substr(10, motion - 10) + one.substr(motion, rows - motion);
  for (std::size_t at = rows, end; (end = one.find('\n', at)) != one.npos; at = end + 1)
    two += one.substr(at, end - at) + one.substr(at, end - at) + "\n";
  CHECK_MESSAGE(told(two).find("it holds 2 people") != std::string::npos, told(two));
}

TEST_CASE("map writes pairs that can be mended and given back; a motion says how it was matched") {
  const TemporaryFolder folder;
  const auto motion =
      writeInto(folder, "dance.bvh", dollMotion({"numbered", DollDialect::Zero::a, 39.37, false, false}, 2));
  const auto map = (folder.path() / "map.txt").string();
  const auto outcome = runProgram({"map", humanBody().string(), motion, "-o", map, "--json"});
  REQUIRE_MESSAGE(outcome.exit == 0, outcome.err);
  CHECK(outcome.json()["pairs"].size() >= 14);
  CHECK(outcome.json()["sureness"].get<double>() >= 0.75);
  const auto pairs = readJointMap(map);
  if (!pairs.ok()) FAIL(pairs.error().message);
  CHECK(pairs->size() >= 14);
  const auto told = runProgram({"export", "--clip", motion, "--joint-map", map, "--no-avoid", "--frames",
                                "0:0", "-o", (folder.path() / "rest.swc").string()});
  CHECK_MESSAGE(told.exit == 0, told.err);
  CHECK_MESSAGE(told.err.find("joints matched") != std::string::npos, told.err);
  CHECK(told.err.find("% sure") != std::string::npos);
  // Another body in place of a motion: what fit pairs.
  const auto printed = runProgram({"map", humanBody().string(), humanBody().string()});
  CHECK(printed.exit == 0);
  const auto named = runProgram({"map", humanBody().string(), humanBody().string(), "-o", "-"},
                                {.folder = folder.path().string()});
  CHECK(named.exit == 0);
  CHECK(named.out == printed.out);
  CHECK_FALSE(std::filesystem::exists(folder.path() / "-"));
  CHECK(runProgram({"map", humanBody().string(), humanBody().string(), "-o", "-", "--json"}).exit == 2);
  CHECK(runProgram({"map", humanBody().string(), humanVessels().string()}).exit == 3);
}
