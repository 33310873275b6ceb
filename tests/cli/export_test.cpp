#include <doctest/doctest.h>

#include <fmt/format.h>

#include <sstream>

#include "cli/program.h"
#include "io/gltf.h"
#include "io/obj.h"
#include "io/stl.h"
#include "io/swc.h"
#include "io/vtp.h"
#include "network/file.h"
#include "support/shared_data.h"

using namespace vasa;
using namespace vasa::test;

namespace {

nlohmann::json exported(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), "export");
  arguments.push_back("--json");
  const auto outcome = runProgram(arguments);
  REQUIRE_MESSAGE(outcome.exit == 0, outcome.err);
  return outcome.json();
}

}  // namespace

TEST_CASE("export: an animated GLB within tolerance and budget, the same bytes for any number of threads") {
  const TemporaryFolder folder;
  const auto file = (folder.path() / "a.glb").string(), again = (folder.path() / "b.glb").string();
  const auto report = exported({"--clip", "walk", "--frames", "3:8", "--quads", "4x2", "-o", file});
  for (const char* key : {"file", "clip", "frames", "vessels", "quads", "vertices", "triangles", "shapes",
                          "keys", "error_mm", "between_error_mm", "file_bytes"})
    CHECK_MESSAGE(report.contains(key), key);
  CHECK(report["keys"].get<int>() >= 6);
  CHECK(report["shapes"].get<int>() <= report["keys"].get<int>());
  CHECK(report["error_mm"].get<double>() <= 0.05);
  CHECK(report["file_bytes"] == std::filesystem::file_size(file));
  const auto summary = checkGltf(file);
  REQUIRE_MESSAGE(summary.ok(), summary.error().message);
  CHECK(summary->animations == 1);
  // Names and kinds come back, portal veins and others apart.
  const auto read = runProgram({"info", file, "--json"}).json()["element"],
             own = runProgram({"info", humanVessels().string(), "--vessels", "--json"}).json()["vessel"];
  REQUIRE(read.size() == own.size());
  for (std::size_t v = 0; v < own.size(); ++v) {
    CHECK(read[v]["name"] == own[v]["name"]);
    CHECK_MESSAGE(read[v]["kind"] == own[v]["kind"], own[v]["name"]);
  }
  exported({"--clip", "walk", "--frames", "3:8", "--quads", "4x2", "--threads", "1", "-o", again});
  CHECK(contentOf(file) == contentOf(again));
  // One key a frame strays farther between keys than more keys do.
  const auto sparse = exported({"--clip", "walk", "--frames", "8:13", "--quads", "4x2", "--between", "1000",
                                "--no-avoid", "-o", again});
  const auto dense = exported({"--clip", "walk", "--frames", "8:13", "--quads", "4x2", "--between", "0.2",
                               "--no-avoid", "-o", again});
  CHECK(sparse["keys"] == 6);
  CHECK(dense["keys"].get<int>() > 6);
  CHECK(dense["between_error_mm"].get<double>() < 0.5 * sparse["between_error_mm"].get<double>());
  CHECK(checkGltf(again).ok());
  CHECK(exported({"--clip", "walk", "--frames", "8:13", "--quads", "4x2", "--fps", "60", "--between", "1000",
                  "--no-avoid", "-o", again})["keys"] == 11);
  const auto small = exported({"--clip", "walk", "--frames", "3:5", "--budget", "25", "-o", file});
  CHECK(small["file_bytes"].get<double>() < 25 * 1048576 + 1e5);
  CHECK(small["vertices"].get<int>() > report["vertices"].get<int>());
  const auto flat = exported({"--clip", "walk", "--frames", "3:8", "--quads", "4x2", "--flat", "-o", file});
  CHECK(flat["file_bytes"].get<double>() < 0.6 * report["file_bytes"].get<double>());
  CHECK(checkGltf(file).ok());
  const auto refused = runProgram({"export", "--clip", "walk", "--frames", "3:5", "--budget", "0.1", "-o",
                                   (folder.path() / "c.glb").string()});
  CHECK(refused.exit == 1);
  CHECK(refused.err.find("--budget") != std::string::npos);
  CHECK(!std::filesystem::exists(folder.path() / "c.glb"));
}

TEST_CASE("export: a posed surface, and centre lines that convert reads back") {
  const TemporaryFolder folder;
  const auto path = [&](const char* name) { return (folder.path() / name).string(); };
  CHECK(exported({"--clip", "squat", "--quads", "4x2", "-o", path("a.obj")})["frames"] == 1);
  const auto elements = readObj(path("a.obj"));
  REQUIRE(elements.ok());
  const auto human = readNetwork(humanVessels());
  REQUIRE(human.ok());
  CHECK(elements->size() == human->vessels().size());

  exported({"-o", path("rest.vtp")});
  const auto converted =
      runProgram({"convert", path("rest.vtp"), "--scale", "0.001", "--exact", "-o", path("rest.vasa")});
  REQUIRE_MESSAGE(converted.exit == 0, converted.err);
  const auto again = readNetwork(path("rest.vasa"));
  REQUIRE(again.ok());
  REQUIRE(again->vessels().size() == human->vessels().size());
  CHECK(again->componentCount() == human->componentCount());
  CHECK(again->junctionCount() == human->junctionCount());
  for (std::size_t v = 0; v < human->vessels().size(); ++v) {
    CHECK(again->vessels()[v].name == human->vessels()[v].name);
    CHECK(again->vessels()[v].kind == human->vessels()[v].kind);
    CHECK(lengthOf(again->pointsOf(again->vessels()[v])) ==
          doctest::Approx(lengthOf(human->pointsOf(human->vessels()[v]))).epsilon(0.01));
  }
  // Written, read and written: the same bytes.
  const std::string vtp = contentOf(path("rest.vtp"));
  const auto lines = parseVtp(std::as_bytes(std::span(vtp)), "rest.vtp", {0.001});
  REQUIRE(lines.ok());
  CHECK(encodeVtp(*lines, {0.001}) == vtp);
  exported({"--clip", "walk", "--frames", "0:2", "--unit", "m", "-o", path("{frame}.swc")});
  const std::string swc = contentOf(path("2.swc"));
  const auto samples = parseSwc(swc, "2.swc");
  REQUIRE(samples.ok());
  CHECK(encodeSwc(*samples) == swc);
}

TEST_CASE("export: .stl holds the triangles of .obj, in millimetres or in another unit") {
  const TemporaryFolder folder;
  const auto path = [&](const char* name) { return (folder.path() / name).string(); };
  const std::vector<std::string> one{"--clip",  "squat", "--frames",   "9",
                                     "--quads", "4x2",   "--no-avoid", "-o"};
  const auto write = [&](const char* name, std::vector<std::string> more) {
    std::vector<std::string> arguments = one;
    arguments.push_back(path(name));
    arguments.insert(arguments.end(), more.begin(), more.end());
    return exported(arguments);
  };
  const auto report = write("a.stl", {});
  CHECK(report["unit"] == "mm");
  CHECK(report["file_bytes"] == 84 + 50 * report["triangles"].get<std::size_t>());
  write("m.stl", {"--unit", "m"});
  write("a.obj", {});
  const auto millimetres = readStl(path("a.stl"), {0.001}), metres = readStl(path("m.stl"));
  const auto surfaces = readObj(path("a.obj"));
  REQUIRE(millimetres.ok());
  REQUIRE(metres.ok());
  REQUIRE(surfaces.ok());
  REQUIRE(millimetres->size() == 1);
  Aabb all;
  for (const MeshElement& element : *surfaces) all.add(element.mesh.bounds());
  for (const auto* read : {&millimetres, &metres}) {
    const Aabb box = (*read)->front().mesh.bounds();
    CHECK(glm::distance(box.low, all.low) < 1e-4f);
    CHECK(glm::distance(box.high, all.high) < 1e-4f);
  }
}

TEST_CASE("export: a row a frame and vessel") {
  const TemporaryFolder folder;
  const auto file = (folder.path() / "a.csv").string();
  const auto report = exported({"--clip", "walk", "--frames", "0:1", "-o", file});
  std::istringstream text(contentOf(file));
  std::string line;
  std::getline(text, line);
  CHECK(
      line ==
      "frame,time_s,vessel,name,kind,length_m,volume_m3,radius_min_m,radius_mean_m,radius_max_m,curvature_max_per_m,clearance_m");
  int rows = 0;
  while (std::getline(text, line)) {
    ++rows;
    CHECK(std::count(line.begin(), line.end(), ',') >= 11);
  }
  CHECK(rows == report["rows"]);
  CHECK(rows == 2 * report["vessels"].get<int>());
}

TEST_CASE("export: a tube list in which bench collide finds the pairs that check finds") {
  const TemporaryFolder folder;
  const auto file = (folder.path() / "twist.tubes").string();
  const auto report = exported({"--clip", "twist", "--frames", "15:20", "--no-avoid", "-o", file});
  const auto frames =
      runProgram({"check", "--clip", "twist", "--frames", "15:20", "--method", "paper", "--json"})
          .json()["frames"];
  const double height = runProgram({"info", "--json"}).json()["body"]["body_height_m"];
  for (const int pose : {0, 1}) {
    const auto& frame = frames[pose ? 5 : 0];
    const auto pairsBy = [&](const std::string& method) {
      const auto bench =
          runProgram({"bench", "collide", "--tubes", file, "--pose", std::to_string(pose), "--runs", "1",
                      "--method", method, "--tolerance", fmt::format("{}", 1e-3 * height), "--json"})
              .json();
      CHECK(bench["tubes"] == report["tubes"]);
      CHECK(bench["excluded"] == report["excluded"]);
      return bench["pairs"];
    };
    CHECK(pairsBy("exact") == frame["contacts_before"]);
    CHECK(pairsBy("paper") == frame["paper_pairs_before"]);
  }
  CHECK(frames[5]["contacts_before"] > 0);
  exported({"-o", file});  // at rest nothing touches
  CHECK(runProgram({"bench", "collide", "--tubes", file, "--runs", "1", "--json"}).json()["pairs"] == 0);
}

TEST_CASE("export tells what is wrong") {
  const TemporaryFolder folder;
  const auto expect = [&](std::vector<std::string> arguments, int exit, const char* message) {
    arguments.insert(arguments.begin(), "export");
    const auto outcome = runProgram(arguments);
    CHECK(outcome.exit == exit);
    CHECK_MESSAGE(outcome.err.find(message) != std::string::npos, outcome.err);
  };
  const auto path = [&](const char* name) { return (folder.path() / name).string(); };
  expect({"-o", path("a.fbx")}, 2, "export writes");
  expect({"--clip", "no such", "-o", path("a.glb")}, 3, "no such");
  expect({"--clip", "walk", "--frames", "0:3", "-o", path("a.obj")}, 2, "{frame");
  expect({"--quads", "auto", "-o", path("a.glb")}, 2, "--quads auto");
  expect({"--clip", "walk", "-o", path("{frame:03}.glb")}, 2, "leave {frame} out");
  expect({"--clip", "walk", "--frames", "0", "--quads", "3x2", "-o", path("no/folder/a.glb")}, 6, "folder");
  CHECK(listOf(folder.path()).empty());
}

TEST_CASE(
    "export: a frame is the same bytes alone, from a track, in a run over all frames, and on any number of "
    "threads") {
  const TemporaryFolder folder;
  const auto at = [&](const std::string& name) { return (folder.path() / name).string(); };
  exported(
      {"--clip", "squat", "--frames", "0:12", "--track", at("squat.track"), "-o", at("all-{frame}.vtp")});
  exported({"--clip", "squat", "--frames", "12", "-o", at("alone.vtp")});
  exported({"--clip", "squat", "--frames", "12", "--track", at("squat.track"), "-o", at("kept.vtp")});
  for (const char* threads : {"1", "8"}) {
    exported({"--clip", "squat", "--frames", "12", "--threads", threads, "-o", at("threads.vtp")});
    CHECK(contentOf(at("threads.vtp")) == contentOf(at("all-12.vtp")));
  }
  CHECK(contentOf(at("alone.vtp")) == contentOf(at("all-12.vtp")));
  CHECK(contentOf(at("kept.vtp")) == contentOf(at("all-12.vtp")));
  // A track of another motion is told, and nothing is written.
  const auto other = runProgram(
      {"export", "--clip", "run", "--frames", "2", "--track", at("squat.track"), "-o", at("other.vtp")});
  CHECK(other.exit == 7);
  CHECK(other.err.find("squat.track") != std::string::npos);
  CHECK_FALSE(std::filesystem::exists(at("other.vtp")));
  CHECK(runProgram({"export", "--track", at("squat.track"), "-o", at("other.vtp")}).exit == 2);
}
