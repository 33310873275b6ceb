#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "cli/program.h"
#include "core/atomic_file.h"
#include "network/file.h"
#include "support/shared_data.h"
#include "support/tubes.h"

using namespace vasa;
using namespace vasa::test;

namespace {

// An OBJ of straight tubes along +Y, one object each.
std::string tubesObj(const std::vector<std::pair<std::string, float>>& tubes) {
  std::string text;
  int base = 1;
  for (const auto& [name, x] : tubes) {
    text += "o " + name + "\n";
    for (int ring = 0; ring <= 20; ++ring)
      for (int k = 0; k < 12; ++k)
        text += "v " + std::to_string(x + 0.004 * std::cos(k * 0.5235988)) + " " +
                std::to_string(0.01 * ring) + " " + std::to_string(-0.004 * std::sin(k * 0.5235988)) + "\n";
    for (int ring = 0; ring < 20; ++ring)
      for (int k = 0; k < 12; ++k) {
        const int a = base + ring * 12, b = a + 12, n = (k + 1) % 12;
        for (const int index : {a + k, a + n, b + n, b + k})
          text += (index == a + k ? "f " : " ") + std::to_string(index);
        text += "\n";
      }
    base += 21 * 12;
  }
  return text;
}

struct Folder {
  TemporaryFolder folder;
  std::string path(const char* name) const { return (folder.path() / name).string(); }
  std::string write(const char* name, const std::string& text) const {
    REQUIRE(writeFileAtomically(folder.path() / name, text).ok());
    return path(name);
  }
};

bool contains(const std::string& text, const std::string& part) { return text.find(part) != text.npos; }

}  // namespace

TEST_CASE("convert writes a network and reports with the keys that tools rely on") {
  const Folder folder;
  const auto mesh = folder.write("arteries.obj", tubesObj({{"left", 0}, {"right", 0.1f}, {"copy", 0.1f}}));
  const auto outcome = runProgram({"convert", mesh, "-o", folder.path("out.vasa"), "--json"});
  REQUIRE(outcome.exit == 0);
  const auto report = outcome.json();
  REQUIRE(report["elements"].size() == 3);
  for (const char* key :
       {"name", "kind", "status", "reason", "sweeps", "triangles", "coverage", "error_mm", "back_error_mm"})
    CHECK(report["elements"][0].contains(key));
  for (const char* key : {"elements", "ok", "partial", "failed", "vessels", "sweeps", "junctions",
                          "components", "coverage", "error_mm", "back_error_mm", "mesh_bytes",
                          "network_bytes", "seconds", "largest_arterial_tree_share", "bridges", "gaps"})
    CHECK(report["summary"].contains(key));
  for (const char* key : {"mean", "p95", "max"}) CHECK(report["summary"]["error_mm"].contains(key));
  CHECK(report["elements"][0]["kind"] == "artery");
  CHECK(report["summary"]["ok"] == 3);
  CHECK(report["summary"]["duplicates"] == 1);
  CHECK(report["summary"]["network_bytes"] == std::filesystem::file_size(folder.path("out.vasa")));
  CHECK(report["summary"]["quantised"] == true);
  const auto network = readNetwork(folder.path("out.vasa"));
  REQUIRE(network.ok());
  CHECK(network->vessels().size() == 2);
  CHECK(network->bodyHeight() == doctest::Approx(0.2f));
}

TEST_CASE("convert --interpolate puts a sweep between every two sections, for surfaces alone") {
  const Folder folder;
  const auto mesh = folder.write("arteries.obj", tubesObj({{"one", 0}}));
  const auto sweeps = [&](std::vector<std::string> more) {
    std::vector<std::string> arguments{"convert", mesh, "-o", folder.path("out.vasa"), "--json"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const auto outcome = runProgram(arguments);
    REQUIRE_MESSAGE(outcome.exit == 0, outcome.err);
    CHECK(outcome.json()["summary"]["error_mm"]["max"].get<double>() < 0.5);
    return outcome.json()["summary"]["sweeps"].get<int>();
  };
  CHECK(sweeps({"--interpolate"}) == 20);  // 21 rings
  CHECK(sweeps({}) < 20);
  CHECK(runProgram({"convert", mesh, "--interpolate", "--tolerance", "1", "-o", folder.path("out.vasa")})
            .exit == 2);
  const auto lines = folder.write("line.swc", "1 2 0 0 0 1 -1\n2 2 0 10 0 1 1\n");
  const auto refused = runProgram({"convert", lines, "--interpolate", "-o", folder.path("lines.vasa")});
  CHECK(refused.exit == 2);
  CHECK(contains(refused.err, "leave out --interpolate"));
}

TEST_CASE("convert parts what overlaps at rest, and leaves it where the surfaces have it with --no-part") {
  const Folder folder;
  const auto mesh = folder.write("arteries.obj", tubesObj({{"left", 0}, {"right", 0.006f}}));
  for (const bool parts : {true, false}) {
    std::vector<std::string> arguments{"convert", mesh, "--json", "-o", folder.path("out.vasa")};
    if (!parts) arguments.push_back("--no-part");
    const auto outcome = runProgram(arguments);
    REQUIRE_MESSAGE(outcome.exit == 0, outcome.err);
    const auto summary = outcome.json()["summary"];
    const auto pairs = summary["rest_pairs_before"].get<int>();
    CHECK(pairs > 0);
    CHECK(summary["rest_pairs_after"] == (parts ? 0 : pairs));
    CHECK(summary["rest_overlaps"].empty() == parts);
    CHECK((summary["rest_moved_max_mm"].get<double>() > 0.5) == parts);
    CHECK((summary["error_mm"]["mean"].get<double>() > 0.2) == parts);
  }
}

TEST_CASE("convert: units, axis, kind, height, exact numbers") {
  const Folder folder;
  const auto mesh = folder.write("tube.obj", tubesObj({{"tube", 0}}));
  const auto outcome = runProgram({"convert", mesh, "-o", folder.path("out.vasa"), "--scale", "2", "--up",
                                   "z", "--kind", "portal", "--body-height", "1.8", "--exact"});
  REQUIRE(outcome.exit == 0);
  CHECK(contains(outcome.out, "1: 1 ok"));
  const auto network = readNetwork(folder.path("out.vasa"));
  REQUIRE(network.ok());
  CHECK(network->vessels()[0].kind == VesselKind::portalVein);
  CHECK(network->bodyHeight() == 1.8f);
  const auto points = network->points();
  CHECK(std::abs(points.front().z - points.back().z) == doctest::Approx(0.4f).epsilon(0.02));
  CHECK(points[1].w == doctest::Approx(0.008f).epsilon(0.05));
}

TEST_CASE("convert --keep-patches keeps the wall around forks, and tells what became of each") {
  const Folder folder;
  std::string obj = "o aorta\n";
  const TriangleMesh surface = forkedSurface();
  for (const vec3& p : surface.positions)
    obj += "v " + std::to_string(p.x) + " " + std::to_string(p.y) + " " + std::to_string(p.z) + "\n";
  for (const uvec3& t : surface.triangles)
    obj +=
        "f " + std::to_string(t.x + 1) + " " + std::to_string(t.y + 1) + " " + std::to_string(t.z + 1) + "\n";
  const auto mesh = folder.write("aorta.obj", obj), out = folder.path("out.vasa"),
             plain = folder.path("plain.vasa");
  const auto outcome = runProgram({"convert", mesh, "-o", out, "--keep-patches", "--json"});
  REQUIRE(outcome.exit == 0);
  const auto patches = outcome.json()["patches"];
  CHECK(patches["forks"] == 2);
  CHECK(patches["kept"] == 2);
  CHECK(patches["without"].empty());
  REQUIRE(patches["fork"].size() == 2);
  for (const char* key : {"vessels", "kept", "reason", "joined", "triangles"})
    CHECK(patches["fork"][0].contains(key));
  REQUIRE(runProgram({"convert", mesh, "-o", plain}).exit == 0);
  CHECK(patches["bytes"] == std::filesystem::file_size(out) - std::filesystem::file_size(plain));
  CHECK(runProgram({"info", out, "--json"}).json()["patches"] == 2);
  CHECK(runProgram({"info", plain, "--json"}).json()["patches"] == 0);
  CHECK(contains(runProgram({"convert", mesh, "-o", out, "--keep-patches"}).out,
                 "2 of 2 forks keep the source's wall, 0 of them of several surfaces"));

  const auto lines = folder.write(
      "lines.swc", "1 0 0 0 0 5 -1\n2 0 0 100 0 5 1\n3 0 0 200 0 5 2\n4 0 80 120 0 3 2\n5 0 160 140 0 3 4\n");
  const auto told = runProgram({"convert", lines, "-o", out, "--scale", "0.001", "--keep-patches", "--json"});
  REQUIRE(told.exit == 0);
  CHECK(told.json()["patches"]["kept"] == 0);
  CHECK(told.json()["patches"]["without"]["the source is centre lines, without a wall"] ==
        told.json()["patches"]["forks"]);
}

TEST_CASE("convert tells what is wrong and leaves no file") {
  const Folder folder;
  const auto mesh = folder.write("tube.obj", tubesObj({{"tube", 0}}));
  const auto out = folder.path("out.vasa");
  const auto expect = [&](const std::vector<std::string>& arguments, int exit, const std::string& message) {
    const auto outcome = runProgram(arguments);
    CHECK(outcome.exit == exit);
    INFO(outcome.err);
    CHECK(contains(outcome.err, message));
    CHECK(outcome.out.empty());
    CHECK(!std::filesystem::exists(out));
  };
  expect({"convert", folder.path("absent.obj"), "-o", out}, 6, "absent.obj");
  expect({"convert", folder.write("bad.obj", "v 0 0 x\n"), "-o", out}, 3, "bad.obj:1");
  expect({"convert", folder.write("flat.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 1 2\n"), "-o", out}, 3,
         "export the surface");
  expect({"convert", folder.write("mesh.ply", "ply\n"), "-o", out}, 2, "convert reads");
  expect({"convert", mesh}, 2, "--output");
  expect({"convert", mesh, "-o", out, "--up", "x"}, 2, "--up");
  expect({"convert", mesh, "-o", out, "--scale", "-1"}, 2, "--scale");
  expect({"convert", mesh, "-o", out, "--exact", "--quantise"}, 2, "--quantise");
  expect({"convert", mesh, "-o", folder.path("no/such/folder.vasa")}, 6, "folder");
}

TEST_CASE("where all elements failed nothing is written, and each is told") {
  const Folder folder;
  std::string text = tubesObj({{"torn", 0}});
  for (int i = 0; i < 300; ++i) {  // splinters, far apart
    const auto at = [&](double x, double y) {
      text += fmt::format("v {} {} 0\n", 0.1 + 0.05 * (i % 20) + x, 0.05 * double(i / 20) + y);
    };
    at(0, 0), at(0.02, 0), at(0, 0.02);
    text += "f -3 -2 -1\n";
  }
  const auto mesh = folder.write("torn.obj", text), out = folder.path("out.vasa");
  const auto outcome = runProgram({"convert", mesh, "-o", out, "--json"});
  CHECK(outcome.exit == 3);
  CHECK(contains(outcome.err, "error: nothing is written: the one element failed ('torn': "));
  CHECK(outcome.json()["elements"][0]["status"] == "failed");
  CHECK(!std::filesystem::exists(out));
  CHECK(!contains(runProgram({"convert", mesh, "-o", out}).out, "written"));
  // Beside one that did not fail it is as before.
  const auto both =
      runProgram({"convert", mesh, folder.write("tube.obj", tubesObj({{"tube", -0.1f}})), "-o", out});
  CHECK(both.exit == 0);
  CHECK(contains(both.out, "1 failed"));
}

TEST_CASE("names from files steer no terminal and forge no line, on standard output and error") {
  const Folder folder;
  const auto clean = [](const std::string& text) {
    return std::ranges::all_of(
        text, [](unsigned char c) { return c == '\n' || c == '\t' || (c >= 0x20 && c != 0x7f); });
  };
  const auto mesh = folder.write("a.obj", tubesObj({{"\x1b[31mred\x07", 0}}) +
                                              "o \x1b]0;title\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\n");
  const auto made = runProgram({"convert", mesh, "-o", folder.path("a.vasa")});
  REQUIRE_MESSAGE(made.exit == 0, made.err);
  CHECK(contains(made.out, "\\x1b]0;title"));
  const auto line = folder.write("a\nerror: forged.swc", "1 1 0 0 0 2 -1\n2 3 0 10 0 2 1\n");
  REQUIRE(runProgram({"convert", line, "-o", folder.path("b.vasa")}).exit == 0);
  for (const char* network : {"a.vasa", "b.vasa"}) {
    const auto info = runProgram({"info", "--vessels", folder.path(network)});
    CHECK(info.exit == 0);
    CHECK(clean(info.out));
    CHECK(!contains(info.out, "\nerror:"));
    const auto same = runProgram({"compare", folder.path(network), folder.path(network)});
    CHECK(clean(same.out));
    CHECK(!contains(same.out, "\nerror:"));
    CHECK(runProgram({"info", "--vessels", "--json", folder.path(network)})
              .json()["vessel"][0]["name"]
              .is_string());
  }
  CHECK(runProgram({"info", "--vessels", "--json", folder.path("b.vasa")}).json()["vessel"][0]["name"] ==
        "a\nerror: forged 1");
  const auto absent = runProgram({"info", folder.path("no\nerror: \x1b[2J.vasa")});
  CHECK(absent.exit == 6);
  CHECK(clean(absent.err));
}

TEST_CASE("convert stops on SIGINT without a file") {
  VASA_REQUIRE_SHARED_DATA(data);
  const Folder folder;
  const auto outcome =
      runProgram({"convert", (data / "bp3d/bp3d_veins.glb").string(), "-o", folder.path("out.vasa")},
                 {.signalAfterMs = 400});
  CHECK(outcome.exit == 130);
  CHECK(listOf(folder.folder.path()).empty());
}

TEST_CASE("convert reads centre lines: an element a line, radii as told") {
  const Folder folder;
  const auto swc =
      folder.write("brain artery.swc",
                   "1 1 0 0 0 2 -1\n2 3 0 10 0 2 1\n3 3 0 20 0 1.5 2\n4 3 5 15 0 1 2\n5 3 9 18 0 1 4\n");
  const auto outcome =
      runProgram({"convert", swc, "--scale", "0.001", "-o", folder.path("out.vasa"), "--json"});
  REQUIRE(outcome.exit == 0);
  const auto report = outcome.json();
  REQUIRE(report["elements"].size() == 2);
  CHECK(report["elements"][0]["name"] == "brain artery 1");
  CHECK(report["elements"][0]["kind"] == "artery");
  CHECK(report["elements"][0]["status"] == "ok");
  CHECK(report["elements"][0]["method"] == "centre line");
  CHECK(report["summary"]["junctions"] == 1);
  CHECK(report["summary"]["joins"]["end_to_side"] == 1);
  CHECK(report["summary"]["quantised"] == false);
  CHECK(report["summary"]["error_mm"]["max"].get<double>() < 0.1);
  const auto network = readNetwork(folder.path("out.vasa"));
  REQUIRE(network.ok());
  CHECK(network->points().front() == vec4(0, 0, 0, 0.002f));
  // The same file a second time brings nothing.
  const auto twice =
      runProgram({"convert", swc, swc, "--scale", "0.001", "-o", folder.path("twice.vasa"), "--json"});
  REQUIRE(twice.exit == 0);
  CHECK(twice.json()["summary"]["vessels"] == 2);
  CHECK(contains(twice.err, "is left out"));
}

TEST_CASE("convert refuses centre lines that it cannot read, and surfaces and lines at once") {
  const Folder folder;
  const auto out = folder.path("out.vasa");
  const auto expect = [&](const std::vector<std::string>& files, int exit, const std::string& message) {
    std::vector<std::string> arguments{"convert", "-o", out};
    arguments.insert(arguments.end(), files.begin(), files.end());
    const auto outcome = runProgram(arguments);
    CHECK(outcome.exit == exit);
    INFO(outcome.err);
    CHECK(contains(outcome.err, message));
    CHECK(!std::filesystem::exists(out));
  };
  const auto good = folder.write("good.swc", "1 1 0 0 0 2 -1\n2 3 0 10 0 2 1\n");
  expect({folder.write("bad.swc", "1 1 0 0 0 -2 -1\n")}, 3, "bad.swc:1: radius -2 must be positive");
  expect({folder.write("dot.swc", "1 1 0 0 0 2 -1\n")}, 3, "no line of two places");
  expect({folder.write("bad.vtp", "<VTKFile/>")}, 3, "bad.vtp: /VTKFile");
  for (const char* ofSurfaces : {"--interpolate", "--no-bridges"})
    expect({good, ofSurfaces}, 2, std::string("leave out ") + ofSurfaces);
  expect({good, "--tolerance", "5"}, 2, "leave out --tolerance");
  expect({good, folder.write("tube.obj", tubesObj({{"tube", 0}}))}, 2, "converted apart");
  expect({folder.path("absent.swc")}, 6, "absent.swc");
}
