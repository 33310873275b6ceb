#include <doctest/doctest.h>

#include "body/doll.h"
#include "cli/program.h"
#include "core/atomic_file.h"
#include "io/bvh.h"
#include "network/file.h"
#include "support/shared_data.h"

using namespace vasa;
using namespace vasa::test;

// Files of others, made here, through the program.

namespace {

std::string write(const TemporaryFolder& folder, const char* name, const std::string& text) {
  const auto path = (folder.path() / name).string();
  REQUIRE(writeFileAtomically(path, text).ok());
  return path;
}

}  // namespace

TEST_CASE("info tells what a motion file holds and how its joints are understood") {
  const TemporaryFolder folder;
  const auto file =
      write(folder, "odd.bvh", dollMotion({"daz", DollDialect::Zero::oneAxis, 100, true, false}, 4));
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
  const auto body = runProgram({"info", humanBody().string(), "--joints", "--json"}).json();
  CHECK(body["joint"].size() == body["joints"].get<std::size_t>());
  CHECK(body["parts_known"] == 14);
}

TEST_CASE("map writes pairs that can be mended and given back; a motion says how it was matched") {
  const TemporaryFolder folder;
  const auto motion =
      write(folder, "dance.bvh", dollMotion({"numbered", DollDialect::Zero::a, 39.37, false, false}, 2));
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
  CHECK(runProgram({"map", humanBody().string(), humanBody().string()}).exit == 0);
  CHECK(runProgram({"map", humanBody().string(), humanVessels().string()}).exit == 3);
}

TEST_CASE(
    "vessels that stand elsewhere are placed in a body by landmarks, from millimetres with another axis up") {
  const TemporaryFolder folder;
  // An aorta in scanner coordinates: millimetres, +Z up, far from the origin.
  std::string swc;
  for (int i = 0; i <= 20; ++i)
    swc += std::to_string(i + 1) + " 0 " + std::to_string(-120 + 0.2 * i) + " 340 " +
           std::to_string(900 - 15 * i) + " 9 " + std::to_string(i ? i : -1) + "\n";
  const auto file = write(folder, "aorta.swc", swc);
  const auto path = [&](const char* name) { return (folder.path() / name).string(); };
  const auto converted = runProgram({"convert", file, "--up", "z", "-o", path("scan.vasa")});
  REQUIRE_MESSAGE(converted.exit == 0, converted.err);
  CHECK_MESSAGE(converted.err.find("read as millimetres") != std::string::npos, converted.err);
  const auto outcome = runProgram(
      {"place", path("scan.vasa"), "--body", humanBody().string(), "--at", "aorta 1:start=0,1.35,-0.02",
       "--at", "aorta 1:end=leftUpperLeg/rightUpperLeg", "-o", path("placed.vasa"), "--json"});
  REQUIRE_MESSAGE(outcome.exit == 0, outcome.err);
  const auto report = outcome.json();
  CHECK(report["landmark_worst_mm"].get<double>() < 0.1);
  CHECK(report["outside_skin_share"].get<double>() < 0.01);
  const auto placed = readNetwork(path("placed.vasa"));
  REQUIRE(placed.ok());
  const auto points = placed->pointsOf(placed->vessels()[0]);
  CHECK(glm::distance(vec3(evaluate(points, 0)), vec3(0, 1.35f, -0.02f)) < 1e-3f);
  CHECK(
      runProgram({"check", "--body", humanBody().string(), "--network", path("placed.vasa"), "--frames", "0"})
          .exit == 0);
  const auto turned = runProgram({"place", path("scan.vasa"), "--turn", "y:90", "--scale", "2", "--move",
                                  "1,0,0", "-o", path("turned.vasa"), "--json"});
  REQUIRE_MESSAGE(turned.exit == 0, turned.err);
  CHECK(turned.json()["turn_degrees"].get<double>() == doctest::Approx(90));
  CHECK(turned.json()["length_m"].get<double>() == doctest::Approx(2 * 0.3).epsilon(0.01));
  CHECK(runProgram({"place", path("scan.vasa"), "--at", "aorta 1=hips", "-o", path("x.vasa")}).exit == 2);
  CHECK(runProgram({"place", path("scan.vasa"), "--body", humanBody().string(), "--at", "aorta 1=tail", "-o",
                    path("x.vasa")})
            .exit == 3);
  CHECK(runProgram({"place", path("scan.vasa"), "--turn", "w:90", "-o", path("x.vasa")}).exit == 2);
}

TEST_CASE("networks that have no vessel in common are said to be strangers") {
  const TemporaryFolder folder;
  const auto swc = write(folder, "odd.swc", "1 0 0 0 0 2 -1\n2 0 0 10 0 2 1\n3 0 0 20 0 2 2\n");
  const auto net = (folder.path() / "odd.vasa").string();
  REQUIRE(runProgram({"convert", swc, "--unit", "mm", "-o", net}).exit == 0);
  const auto outcome = runProgram({"compare", net, humanVessels().string()});
  CHECK(outcome.exit == 0);
  CHECK_MESSAGE(outcome.out.find("no vessel is in both") != std::string::npos, outcome.out);
}

TEST_CASE("files of a kind that is not read say what to do") {
  const TemporaryFolder folder;
  for (const auto& [name, remedy] :
       {std::pair("a.ply", "export it as .glb or .obj"), std::pair("a.vtu", "Extract Surface"),
        std::pair("a.nii", "3D Slicer")}) {
    const auto outcome =
        runProgram({"convert", write(folder, name, "x"), "-o", (folder.path() / "a.vasa").string()});
    CHECK(outcome.exit == 2);
    CHECK_MESSAGE(outcome.err.find(remedy) != std::string::npos, outcome.err);
  }
}
