#include <doctest/doctest.h>

#include <fstream>

#include "cli/program.h"
#include "network/file.h"
#include "support/shared_data.h"

using namespace vasa;
using namespace vasa::test;

TEST_CASE("a network fitted to the body it lies in stays where it is") {
  const TemporaryFolder folder;
  const auto out = (folder.path() / "same.vasa").string();
  const auto outcome = runProgram({"fit", humanVessels().string(), "--from", humanBody().string(), "--to",
                                   humanBody().string(), "-o", out, "--exact", "--json"});
  REQUIRE_MESSAGE(outcome.exit == 0, outcome.err);
  const auto report = outcome.json();
  for (const char* key :
       {"file", "vessels", "length_m", "length_before_m", "body_height_m", "radius_factor", "joints_matched",
        "joints_free", "points_pushed_in", "kinks", "outside_skin", "outside_skin_before"})
    CHECK_MESSAGE(report.contains(key), key);
  CHECK(report["joints_free"].empty());
  CHECK(report["radius_factor"].get<double>() == doctest::Approx(1));
  const auto before = readNetwork(humanVessels()), after = readNetwork(out);
  REQUIRE(before.ok());
  REQUIRE(after.ok());
  REQUIRE(before->points().size() == after->points().size());
  CHECK(before->nodes().size() == after->nodes().size());
  float farthest = 0;
  for (std::size_t i = 0; i < before->points().size(); ++i)
    farthest = std::max(farthest, glm::distance(before->points()[i], after->points()[i]));
  CHECK(farthest < 0.002f);
}

TEST_CASE("the built-in human's vessels fit other bodies: less than 2 % of their length outside the skin") {
  VASA_REQUIRE_SHARED_DATA(data);
  const TemporaryFolder folder;
  for (const char* body :
       {"rigs/makehuman_male_cmu31.glb", "rigs/makehuman_female_cmu31.glb", "bp3d/bp3d_body.glb"}) {
    const auto out = (folder.path() / "fitted.vasa").string(), target = (data / body).string();
    const auto outcome = runProgram({"fit", humanVessels().string(), "--from", humanBody().string(), "--to",
                                     target, "-o", out, "--json"});
    REQUIRE_MESSAGE(outcome.exit == 0, outcome.err);
    const auto report = outcome.json();
    CHECK(report["outside_skin"]["measured"] == true);
    CHECK(report["outside_skin"]["share"].get<double>() < 0.02);
    CHECK(report["joints_matched"].get<int>() >= 24);
    MESSAGE(std::string(body) << ": " << 100 * report["outside_skin"]["share"].get<double>() << " % outside");
    // What was refused before is at home there now.
    CHECK(runProgram({"check", "--body", target, "--network", out, "--frames", "0", "--json"}).exit == 0);
  }
}

TEST_CASE("fit tells what does not match") {
  const TemporaryFolder folder;
  const auto out = (folder.path() / "out.vasa").string();
  const auto expect = [&](std::vector<std::string> arguments, int exit, const char* message) {
    arguments.insert(arguments.begin(), "fit");
    const auto outcome = runProgram(arguments);
    CHECK(outcome.exit == exit);
    CHECK_MESSAGE(outcome.err.find(message) != std::string::npos, outcome.err);
    CHECK(!std::filesystem::exists(out));
  };
  const auto body = humanBody().string(), vessels = humanVessels().string();
  expect({vessels, "--from", body, "-o", out}, 2, "--to");
  expect({(folder.path() / "none.vasa").string(), "--from", body, "--to", body, "-o", out}, 6, "none.vasa");
  expect({vessels, "--from", body, "--to", vessels, "-o", out}, 3, "human.vasa");
  const auto line = (folder.path() / "far.swc").string(), far = (folder.path() / "far.vasa").string();
  std::ofstream(line) << "1 1 50 1 0 0.01 -1\n2 3 50 1.2 0 0.01 1\n";
  REQUIRE(runProgram({"convert", line, "--unit", "m", "-o", far}).exit == 0);
  expect({far, "--from", body, "--to", body, "-o", out}, 3, "do not belong to the body");
}

TEST_CASE("a body whose joints have no names is known by its shape, and vessels fit it") {
  VASA_REQUIRE_SHARED_DATA(data);
  const TemporaryFolder folder;
  const auto out = (folder.path() / "out.vasa").string();
  const auto outcome = runProgram({"fit", humanVessels().string(), "--from", humanBody().string(), "--to",
                                   (data / "rigs/CesiumMan.glb").string(), "-o", out, "--json"});
  REQUIRE_MESSAGE(outcome.exit == 0, outcome.err);
  CHECK(outcome.json()["joints_matched"].get<int>() >= 15);
  CHECK(outcome.json()["outside_skin"]["share"].get<double>() < 0.02);
}
