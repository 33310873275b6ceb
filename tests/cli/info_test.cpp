#include <doctest/doctest.h>

#include <fstream>

#include "cli/program.h"
#include "support/shared_data.h"

using namespace vasa::test;

TEST_CASE("info on a network has the keys that tools rely on") {
  const auto outcome = runProgram({"info", humanVessels().string(), "--json"});
  REQUIRE(outcome.exit == 0);
  const auto report = outcome.json();
  for (const char* key :
       {"kind", "vessels", "arteries", "veins", "sections", "sweeps", "junctions", "components", "length_m",
        "volume_m3", "body_height_m", "file_bytes", "bytes_per_sweep"})
    CHECK(report.contains(key));
  CHECK(report["kind"] == "network");
  CHECK(report["vessels"].get<int>() >= 60);
  CHECK(report["arteries"].get<int>() + report["veins"].get<int>() == report["vessels"].get<int>());
  CHECK(report["file_bytes"] == std::filesystem::file_size(humanVessels()));
  // 1.75 m: 4.5 litres.
  CHECK(report["share_of_blood"].get<double>() ==
        doctest::Approx(report["volume_m3"].get<double>() / 4.53e-3).epsilon(0.01));
}

TEST_CASE("info on a body and on the built-in scene") {
  const auto body = runProgram({"info", humanBody().string(), "--json"}).json();
  CHECK(body["kind"] == "body");
  CHECK(body["joints"].get<int>() > 30);
  CHECK(body["clips"].size() >= 5);
  const auto scene = runProgram({"info", "--json"}).json();
  CHECK(scene["kind"] == "scene");
  CHECK(scene["networks"][0]["kind"] == "network");
  const auto text = runProgram({"info"});
  CHECK(text.exit == 0);
  CHECK(text.out.find("sweeps") != std::string::npos);
}

TEST_CASE(
    "what a scene file names and is not there is bad input, what the command line names a file that cannot be read") {
  const TemporaryFolder folder;
  const auto scene = (folder.path() / "scene.json").string();
  const auto write = [&](const std::string& body, const std::string& network) {
    std::ofstream(scene) << nlohmann::json{{"body", body}, {"networks", {network}}};
  };
  write("absent.glb", humanVessels().string());
  const auto absent = runProgram({"info", scene});
  CHECK(absent.exit == 3);
  CHECK(absent.err.find("absent.glb, which is not there") != std::string::npos);
  write(humanBody().string(), "absent.vasa");
  CHECK(runProgram({"info", scene}).exit == 3);
  CHECK(runProgram({"check", scene, "--body", "/nowhere.glb"}).exit == 3);
  CHECK(runProgram({"check", scene, "--network", "/nowhere.vasa"}).exit == 6);
}

TEST_CASE("info tells what is missing or broken") {
  CHECK(runProgram({"info", "/nowhere/x.vasa"}).exit == 6);
  CHECK(runProgram({"info", "/nowhere/x.json"}).exit == 6);
  const auto wrong = runProgram({"info", VASA_PROGRAM + std::string(".vasa")});
  CHECK(wrong.exit == 6);
  CHECK(runProgram({"info", "--json"}, {.standardOutput = "/dev/full"}).exit == 6);
}
