#include <doctest/doctest.h>

#include "cli/program.h"
#include "core/atomic_file.h"
#include "support/shared_data.h"

using namespace vasa;
using namespace vasa::test;

namespace {

// Two frames of a skeleton with CMU's names: standing, then the left arm raised sideways.
std::string motionText() {
  const auto joint = [](const std::string& name, const std::string& offset, const std::string& inside) {
    return "JOINT " + name + "\n{\nOFFSET " + offset + "\nCHANNELS 3 Zrotation Yrotation Xrotation\n" +
           inside + "}\n";
  };
  const std::string end = "End Site\n{\nOFFSET 0 0 1\n}\n";
  std::string text =
      "HIERARCHY\nROOT Hips\n{\nOFFSET 0 0 0\nCHANNELS 6 Xposition Yposition Zposition Zrotation Yrotation Xrotation\n";
  for (const std::string& side : {std::string("Left"), std::string("Right")}) {
    const std::string out = side == "Left" ? "" : "-";
    text += joint(side + "UpLeg", out + "1.5 -1 0",
                  joint(side + "Leg", "0 -7 0", joint(side + "Foot", "0 -7 0", end)));
    text += joint(side + "Arm", out + "3 8 0",
                  joint(side + "ForeArm", out + "5 0 0", joint(side + "Hand", out + "4 0 0", end)));
  }
  text += "}\nMOTION\nFrames: 2\nFrame Time: 0.04\n";
  for (int frame = 0; frame < 2; ++frame) {
    text += "0 15 0";
    for (int value = 0; value < 39; ++value) text += value == 12 ? (frame ? " 40" : " -80") : " 0";
    text += "\n";
  }
  return text;
}

}  // namespace

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
}
