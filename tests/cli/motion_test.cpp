#include <doctest/doctest.h>

#include "cli/motion_text.h"
#include "cli/program.h"
#include "core/atomic_file.h"
#include "support/shared_data.h"

using namespace vasa;
using namespace vasa::test;

TEST_CASE("a BVH file moves the built-in human") {
  const TemporaryFolder folder;
  const auto file = (folder.path() / "raise.bvh").string();
  REQUIRE(writeFileAtomically(file, motionText()).ok());
  const auto outcome = runProgram({"render", "--clip", file, "--size", "96x160", "--quads", "4x2", "-o",
                                   (folder.path() / "{frame}.png").string(), "--json"});
  REQUIRE_MESSAGE(outcome.exit == 0, outcome.err);
  CHECK(outcome.json()["frames"] == 2);
  CHECK(outcome.json()["largest_step_m"].get<double>() > 0.3);
}

TEST_CASE("BVH files and joint maps that do not fit are refused") {
  const TemporaryFolder folder;
  const auto write = [&](const char* name, const std::string& text) {
    REQUIRE(writeFileAtomically(folder.path() / name, text).ok());
    return (folder.path() / name).string();
  };
  const auto expect = [&](std::vector<std::string> more, int exit, const char* message) {
    std::vector<std::string> arguments{"render", "--size", "96x160", "-o",
                                       (folder.path() / "{frame}.png").string()};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const auto outcome = runProgram(arguments);
    CHECK(outcome.exit == exit);
    CHECK_MESSAGE(outcome.err.find(message) != std::string::npos, outcome.err);
  };
  const auto good = write("good.bvh", motionText());
  expect({"--clip", write("bad.bvh", "HIERARCHY\nROOTS\n")}, 3, "bad.bvh:2: expected ROOT");
  expect({"--clip", (folder.path() / "absent.bvh").string()}, 6, "absent.bvh");
  expect({"--clip", good, "--joint-map", write("map.txt", "Hips = Nobody\n")}, 3, "has no joint 'Nobody'");
  expect({"--clip", good, "--joint-map", write("bad.txt", "Hips\n")}, 3, "bad.txt:1");
  expect({"--clip", "walk", "--joint-map", write("map.txt", "Hips = Hips\n")}, 2, "belongs to a .bvh file");
  expect(
      {"--clip",
       write(
           "odd.bvh",
           "HIERARCHY\nROOT a\n{\nOFFSET 0 0 0\nCHANNELS 3 Xrotation Yrotation Zrotation\n}\nMOTION\nFrames: 1\nFrame Time: 1\n0 0 0\n")},
      3, "joints in common");
  std::string far = motionText();
  far.replace(far.rfind("0 15 0"), 6, "0 15 1e8");
  expect(
      {"--clip", write("far.bvh", far)}, 3,
      "far.bvh: takes the body farther than a kilometre from where it rests; leave out the frames that jump ");
}

TEST_CASE("a motion whose turns are all small is warned of, as it may be in radians") {
  const TemporaryFolder folder;
  const auto path = folder.path() / "small.bvh";
  const auto told = [&](const char* angle) {
    REQUIRE(writeFileAtomically(path, armMotion({"0", angle})).ok());
    return runProgram({"info", path.string()})
        .err.find("by more than 1.4 degrees in any frame; if the file has radians");
  };
  CHECK(told("-1.4") != std::string::npos);
  CHECK(told("-80") == std::string::npos);
}

TEST_CASE("vessels are held where a table says, which is refused where it names none") {
  const TemporaryFolder folder;
  const auto table = [&](const char* name, const std::string& row) {
    REQUIRE(writeFileAtomically(folder.path() / name, "vessel,at,held_by\n" + row + "\n").ok());
    return (folder.path() / name).string();
  };
  const auto told = [&](std::vector<std::string> more) {
    std::vector<std::string> arguments{"check", "--clip", "walk", "--frames", "5", "--json"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return runProgram(arguments);
  };
  const std::vector<std::string> human{"--body", humanBody().string(), "--network", humanVessels().string()};
  const auto withHuman = [&](std::vector<std::string> more) {
    more.insert(more.end(), human.begin(), human.end());
    return told(more);
  };
  const auto moved = [](const Outcome& outcome) {
    REQUIRE_MESSAGE(outcome.exit == 0, outcome.err);
    return outcome.json()["summary"]["moved_rms_m"].get<double>();
  };
  const auto own = (humanBody().parent_path() / "human.holds.csv").string();
  CHECK(moved(told({})) == moved(withHuman({"--holds", own})));  // the built-in human has its own
  CHECK(moved(told({})) != moved(withHuman({})));
  const auto wrong = told({"--holds", table("wrong.csv", "left anterior tibial artry,0.9,band")});
  CHECK(wrong.exit == 3);
  CHECK_MESSAGE(wrong.err.find("wrong.csv:2") != std::string::npos, wrong.err);
  CHECK_MESSAGE(wrong.err.find("did you mean \"left anterior tibial artery\"") != std::string::npos,
                wrong.err);
  CHECK(told({"--holds", (folder.path() / "absent.csv").string()}).exit == 6);
}

TEST_CASE("what vessels keep is a choice of three") {
  const auto volumeError = [](const char* keep) {
    const auto outcome = runProgram({"check", "--clip", "squat", "--frames", "45", "--keep", keep, "--json"});
    REQUIRE_MESSAGE(outcome.exit == 0, outcome.err);
    const auto summary = outcome.json()["summary"];
    CHECK(summary["certified"] == true);
    return std::pair(summary["volume_error"].get<double>(), summary["volume_gave_way"].get<int>());
  };
  const auto volume = volumeError("volume"), wall = volumeError("wall"), radii = volumeError("radii");
  CHECK(volume.first < 1e-4);
  CHECK(wall.second > volume.second);  // radii at a wall's limits
  CHECK(wall.first < radii.first);
  CHECK(runProgram({"check", "--keep", "shape"}).exit == 2);
  CHECK(runProgram({"check", "--keep", "wall", "--no-volume"}).exit == 2);
}
