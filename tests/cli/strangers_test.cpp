#include <doctest/doctest.h>

#include <algorithm>

#include "cli/program.h"
#include "cli/strangers.h"
#include "io/gltf.h"
#include "network/file.h"
#include "support/shared_data.h"

using namespace vasa;
using namespace vasa::test;

// Files of others, made here, through the program.

TEST_CASE(
    "vessels that stand elsewhere are placed in a body by landmarks, from millimetres with another axis up") {
  const TemporaryFolder folder;
  // An aorta in scanner coordinates: millimetres, +Z up, far from the origin.
  std::string swc;
  for (int i = 0; i <= 20; ++i)
    swc += std::to_string(i + 1) + " 0 " + std::to_string(-120 + 0.2 * i) + " 340 " +
           std::to_string(900 - 15 * i) + " 9 " + std::to_string(i ? i : -1) + "\n";
  const auto file = writeInto(folder, "aorta.swc", swc);
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

TEST_CASE(
    "one small vessel of a scan is read in its unit beside others; one that stands far off is refused") {
  const TemporaryFolder folder;
  const auto trace = [&](const char* name, vec3 from, vec3 step) {
    std::string swc;
    for (int i = 0; i <= 8; ++i) {
      const vec3 p = from + float(i) * step;
      swc += std::to_string(i + 1) + " 0 " + std::to_string(p.x) + " " + std::to_string(p.y) + " " +
             std::to_string(p.z) + " 0.001 " + std::to_string(i ? i : -1) + "\n";
    }
    return writeInto(folder, name, swc);
  };
  const auto check = [&](const std::string& file) {
    return runProgram({"check", "--body", humanBody().string(), "--network", humanVessels().string(),
                       "--network", file, "--frames", "0"});
  };
  // A perforating artery of the thigh, 3 mm of it, in millimetres.
  const auto small = check(trace("left perforating artery.swc", {95, 700, 20}, {0.4f, 0.1f, 0}));
  CHECK_MESSAGE(small.err.find("as in metres they would lie 7") != std::string::npos, small.err);
  CHECK((small.exit == 0 || small.exit == 5));
  const auto far = check(trace("stray artery.swc", {30, 1, 0}, {0.01f, 0, 0}));
  CHECK(far.exit == 3);
  CHECK_MESSAGE(far.err.find("stray artery.swc: 100 %") != std::string::npos, far.err);
}

TEST_CASE("what is proposed can be typed as it stands, and a unit that says nothing of a file is refused") {
  const TemporaryFolder folder;
  const auto spaced = writeInto(folder, "left vein's end.swc", "1 0 0 0 0 0.001 -1\n2 0 0 0.1 0 0.001 1\n");
  const auto next = runProgram({"info", spaced, "--json"}).json()["next"].get<std::string>();
  CHECK_MESSAGE(next.ends_with("left vein'\\''s end.swc' -o NET.vasa"), next);
  const auto refused = runProgram(
      {"convert", humanBody().string(), "--scale", "0.001", "-o", (folder.path() / "x.vasa").string()});
  CHECK(refused.exit == 2);
  CHECK_MESSAGE(refused.err.find("--unit mm") != std::string::npos, refused.err);
}

namespace {

// In a scanner's coordinates: millimetres, +Z up, elsewhere, a smaller person.
vec3 scanned(vec3 p) { return 900.0f * vec3(p.x, -p.z, p.y) + vec3(-120, 340, 77); }

// The built-in human's trunk as a scan would have it: the skin between crotch and shoulders, without arms.
std::string scannedTrunk() {
  const auto body = readBody(humanBody());
  REQUIRE(body.ok());
  std::string obj = "o trunk\n";
  const auto skin = std::ranges::find(body->meshes, std::string("skin"), &SkinnedMesh::name);
  REQUIRE(skin != body->meshes.end());
  for (const vec3& p : skin->mesh.positions) obj += wordsOf("v ", scanned(p), "\n");
  for (const uvec3& t : skin->mesh.triangles) {
    bool inside = true;
    for (int k = 0; k < 3; ++k) {
      const vec3 p = skin->mesh.positions[t[k]];
      inside = inside && p.y > 0.88f && p.y < 1.42f && std::abs(p.x) < (p.y < 1.14f ? 0.175f : 0.2f);
    }
    if (inside)
      obj += "f " + std::to_string(t.x + 1) + " " + std::to_string(t.y + 1) + " " + std::to_string(t.z + 1) +
             "\n";
  }
  return obj;
}

}  // namespace

TEST_CASE(
    "a scan's vessels with its skin and no skeleton are fitted to a body: millimetres, +Z up, elsewhere") {
  const TemporaryFolder folder;
  const auto human = readNetwork(humanVessels());
  REQUIRE(human.ok());
  const auto vessels = human->vessels();
  const auto aorta = std::ranges::find(vessels, std::string_view("abdominal aorta"), &Vessel::name);
  REQUIRE(aorta != vessels.end());
  const auto own = human->pointsOf(*aorta);
  const float ownSpans = float(aorta->spanCount());
  std::string swc;
  int id = 0;
  for (int i = 0; i <= 30; ++i) {
    const vec4 p = evaluate(own, ownSpans * float(i) / 30);
    ++id;
    swc += std::to_string(id) + " 0" + wordsOf(" ", scanned(vec3(p)), " ") + std::to_string(900 * p.w) + " " +
           std::to_string(i ? id - 1 : -1) + "\n";
  }
  const auto path = [&](const char* name) { return (folder.path() / name).string(); };
  const auto lines = writeInto(folder, "aorta.swc", swc),
             trunk = writeInto(folder, "trunk.obj", scannedTrunk());
  REQUIRE(runProgram({"convert", lines, "--unit", "mm", "--up", "z", "-o", path("scan.vasa")}).exit == 0);
  for (const bool told : {true, false}) {  // the unit is the likely one where it is not told
    std::vector<std::string> words{
        "fit", path("scan.vasa"),   "--from", trunk, "--up", "z", "--to", humanBody().string(),
        "-o",  path("fitted.vasa"), "--json"};
    if (told) words.insert(words.end(), {"--unit", "mm"});
    const auto outcome = runProgram(words);
    REQUIRE_MESSAGE(outcome.exit == 0, outcome.err);
    const auto report = outcome.json();
    CHECK(report["surface"]["share"].get<double>() > 0.85);
    CHECK(report["surface"]["scale"].get<double>() == doctest::Approx(1 / 0.9).epsilon(0.04));
    CHECK(report["outside_skin"]["share"].get<double>() < 0.01);
    CHECK(report["strained"].size() == 1);
    const auto fitted = readNetwork(path("fitted.vasa"));
    REQUIRE(fitted.ok());
    const auto points = fitted->pointsOf(fitted->vessels()[0]);
    const float spans = float(fitted->vessels()[0].spanCount());
    for (const float t : {0.0f, 0.25f, 0.5f, 0.75f, 1.0f}) {
      const vec3 p(evaluate(points, t * spans));
      float away = 1e9f;  // from where it runs in the human
      for (int i = 0; i <= 200; ++i)
        away = std::min(away, glm::distance(p, vec3(evaluate(own, ownSpans * float(i) / 200))));
      CHECK_MESSAGE(away < 0.02f, t);
    }
  }
  const auto moved = runProgram({"check", "--network", path("fitted.vasa"), "--clip", "walk", "--frames",
                                 "0:2", "--body", humanBody().string(), "--json"});
  CHECK_MESSAGE(moved.exit == 0, moved.err);
  // What belongs to surfaces is refused for bodies, and the other way round.
  CHECK(runProgram({"fit", humanVessels().string(), "--from", humanBody().string(), "--to",
                    humanBody().string(), "--unit", "mm", "-o", path("x.vasa")})
            .exit == 2);
  CHECK(runProgram({"fit", path("scan.vasa"), "--from", trunk, "--to", humanBody().string(), "--joint-map",
                    writeInto(folder, "map.txt", "a = b\n"), "-o", path("x.vasa")})
            .exit == 2);
  // The same file read upright as it is: the vessels lie elsewhere.
  const auto lying = runProgram(
      {"fit", path("scan.vasa"), "--from", trunk, "--to", humanBody().string(), "-o", path("x.vasa")});
  CHECK(lying.exit == 3);
  CHECK_MESSAGE(lying.err.find("--up") != std::string::npos, lying.err);
}

TEST_CASE("networks that have no vessel in common are said to be strangers") {
  const TemporaryFolder folder;
  for (const char* radius : {"1", "0.000003"}) {
    std::string rows;
    for (int i = 0; i < 3; ++i)
      rows += std::to_string(i + 1) + " 0 0 0." + std::to_string(i) + " 0 " + radius + " " +
              std::to_string(i > 0 ? i : -1) + "\n";
    const auto outcome = runProgram({"convert", writeInto(folder, "odd.swc", rows), "-o",
                                     (folder.path() / "odd.vasa").string(), "--json"});
    REQUIRE_MESSAGE(outcome.exit == 0, outcome.err);
    CHECK(outcome.json()["summary"]["doubtful"] == 1);
  }
}

TEST_CASE("centre lines whose radii are in another unit than their places are doubtful") {
  const TemporaryFolder folder;
  const auto swc = writeInto(folder, "odd.swc", "1 0 0 0 0 1 -1\n2 0 0 0.1 0 1 1\n3 0 0 0.2 0 1 2\n");
  const auto outcome = runProgram({"convert", swc, "-o", (folder.path() / "odd.vasa").string(), "--json"});
  REQUIRE_MESSAGE(outcome.exit == 0, outcome.err);
  CHECK(outcome.json()["summary"]["doubtful"] == 1);
}

TEST_CASE("surfaces that are no vessels and are taken for a network are warned of") {
  const TemporaryFolder folder;
  const auto placed = runProgram(
      {"place", writeInto(folder, "trunk.obj", scannedTrunk()), "-o", (folder.path() / "x.vasa").string()});
  CHECK_MESSAGE(placed.exit == 0, placed.err);
  CHECK_MESSAGE(placed.err.find("trunk.obj: 1 of 1 elements are doubtful as vessels") != std::string::npos,
                placed.err);
  CHECK(placed.err.find("give a body with --body") != std::string::npos);
}

TEST_CASE("info tells of vessels before they are converted") {
  const TemporaryFolder folder;
  const auto lines = runProgram({"info", writeInto(folder, "vein.swc", personVessels()), "--json"});
  REQUIRE_MESSAGE(lines.exit == 0, lines.err);
  CHECK(lines.json()["kind"] == "centre lines");
  CHECK(lines.json()["lines"] == 2);
  const auto surface = runProgram({"info", writeInto(folder, "trunk.obj", scannedTrunk()), "--json"});
  REQUIRE_MESSAGE(surface.exit == 0, surface.err);
  CHECK(surface.json()["kind"] == "surfaces");
  CHECK(surface.json()["metres_a_unit"] == 0.001);
  CHECK(surface.json()["next"].get<std::string>().starts_with("vasa convert"));
  CHECK(runProgram({"info", (folder.path() / "none.swc").string()}).exit == 6);
  // What a file of this kind does not have is not left out without a word.
  const auto swc = writeInto(folder, "v.swc", personVessels()), net = humanVessels().string();
  for (const auto& [words, remedy] :
       {std::pair(std::vector<std::string>{"info", swc, "--vessels"}, "vasa convert makes a network of"),
        std::pair(std::vector<std::string>{"info", swc, "--joints"}, "--joints is for a body"),
        std::pair(std::vector<std::string>{"info", net, "--joints"}, "is a network"),
        std::pair(std::vector<std::string>{"info", humanBody().string(), "--vessels"}, "is a body"),
        std::pair(std::vector<std::string>{"info", net, "--step", "3"}, "--profile")}) {
    const auto refused = runProgram(words);
    CHECK(refused.exit == 2);
    CHECK_MESSAGE(refused.err.find(remedy) != std::string::npos, refused.err);
  }
}

TEST_CASE(
    "bodies and motions of a kind that is not read say what to do; a file that is not there is no usage") {
  const TemporaryFolder folder;
  const auto expect = [&](std::vector<std::string> words, int exit, const char* remedy) {
    const auto outcome = runProgram(words);
    CHECK(outcome.exit == exit);
    CHECK_MESSAGE(outcome.err.find(remedy) != std::string::npos, outcome.err);
  };
  const auto human = humanBody().string(), net = humanVessels().string();
  const auto fbx = writeInto(folder, "body.fbx", "Kaydara"), c3d = writeInto(folder, "walk.c3d", "x");
  expect({"map", fbx, human}, 3, "export it with its armature as .glb");
  expect({"fit", net, "--from", fbx, "--to", human, "-o", "x.vasa"}, 3, "armature as .glb");
  expect({"map", net, human}, 3, "it is a network: name a body in its place");
  expect({"fit", net, "--from", human, "--to", net, "-o", "x.vasa"}, 3, "name a body in its place");
  expect({"place", writeInto(folder, "walk.bvh", "HIERARCHY"), "-o", "x.vasa"}, 3,
         "it is a motion, and no vessels");
  const auto walk = writeInto(folder, "walk.bvh", "HIERARCHY");
  expect({"compare", walk, net}, 3, "it is a motion, and no vessels");
  expect({"edit", walk, writeInto(folder, "no.vedit", ""), "-o", "x.vasa"}, 3,
         "it is a motion, and no vessels");
  expect({"check", "--clip", c3d, "--frames", "0"}, 3, "turn it into .bvh first");
  expect({"check", "--clip", fbx, "--frames", "0"}, 3, "export the armature's motion as .bvh");
  expect({"info", writeInto(folder, "notes.txt", "x")}, 2, "write centre lines as .swc");
  expect({"render", human, "-o", "x.png"}, 3, "a body is given with --body");
  const auto lines = writeInto(folder, "v.swc", personVessels()),
             trunk = writeInto(folder, "trunk.obj", scannedTrunk());
  expect({"convert", trunk, lines, "-o", "x.vasa"}, 2, "converted apart");
  expect({"convert", lines, "-o", (folder.path() / "x.glb").string()}, 2, "vasa export makes other files");
  expect({"convert", lines, "-o", (folder.path() / "no" / "x.vasa").string()}, 6, "create it first");
  expect({"place", lines, "--at", "v 1:middle=hips", "-o", "x.vasa"}, 3, "start, end or a share");
  expect({"convert", (folder.path() / "none.xyz").string(), "-o", "x.vasa"}, 6, "cannot open");
}

TEST_CASE("nothing that is read is written over, and no option is passed over without a word") {
  const TemporaryFolder folder;
  const auto refused = [&](std::vector<std::string> words, int exit, const char* reason) {
    const auto outcome = runProgram(words);
    CHECK(outcome.exit == exit);
    CHECK_MESSAGE(outcome.err.find(reason) != std::string::npos, outcome.err);
  };
  const auto lines = writeInto(folder, "v.swc", personVessels());
  const auto net = (folder.path() / "v.vasa").string();
  REQUIRE(runProgram({"convert", lines, "-o", net}).exit == 0);
  const auto before = readFile(net);
  refused({"place", net, "--scale", "2", "-o", net}, 2, "v.vasa: is read, too, and would be written over");
  refused({"place", net, "--scale", "2", "-o", (folder.path() / "." / "v.vasa").string()}, 2, "written over");
  CHECK(*readFile(net) == *before);
  const auto to = [&](const char* name) { return (folder.path() / name).string(); };
  refused({"export", "-o", to("a.obj"), "--unit", "mm"}, 2, "--unit is of .vtp, .swc and .stl files");
  refused({"export", "-o", to("a.csv"), "--flat"}, 2, "--flat is of .glb files");
  refused({"prepare", "--clip", "nope", "-o", to("kept")}, 3, "no clip 'nope'");
  const std::string head = "name,part,motion,low_deg,high_deg\n";
  refused({"poses", "--ranges", writeInto(folder, "none.csv", head)}, 3, "has no row below its header");
  refused({"poses", "--ranges", writeInto(folder, "far.csv", head + "head flexion,head,flexion,-25,4000\n")},
          3, "far.csv:2: low_deg and high_deg must be from -180 to 180");
}

TEST_CASE("files of a kind that is not read say what to do") {
  const TemporaryFolder folder;
  for (const auto& [name, remedy] :
       {std::pair("a.ply", "export it as .glb or .obj"), std::pair("a.vti", "Extract Surface"),
        std::pair("a.nii", "3D Slicer"), std::pair("a.nii.gz", "3D Slicer"), std::pair("a.fcsv", "3D Slicer"),
        std::pair("a.gii", "as .stl"), std::pair("a.asc", "to .swc first"),
        std::pair("a.ctgr", "SimVascular"), std::pair("a.traces", "as .swc"),
        std::pair("a.stl.gz", "unpack it first")}) {
    const auto outcome =
        runProgram({"convert", writeInto(folder, name, "x"), "-o", (folder.path() / "a.vasa").string()});
    CHECK(outcome.exit == 2);
    CHECK_MESSAGE(outcome.err.find(remedy) != std::string::npos, outcome.err);
  }
}

TEST_CASE("files whose names tell another kind than they are of are named by what they hold") {
  const TemporaryFolder folder;
  const std::string facet =
      "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n"
      "endsolid a\n";
  const std::string mesh =
      "o a\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 2 3\nf 1 2 3\nf 1 2 3\nf 1 2 3\nf 3 2 1\n";
  for (const auto& [name, text, kind] :
       {std::tuple("a.obj", facet, ".stl"), std::tuple("b.stl", mesh + mesh, ".obj"),
        std::tuple("c.swc", dollMotion({.family = "cmu"}, 2), ".bvh"),
        std::tuple("d.obj", std::string("ply\nformat ascii 1.0\n"), ".ply")}) {
    const auto outcome =
        runProgram({"convert", writeInto(folder, name, text), "-o", (folder.path() / "a.vasa").string()});
    CHECK(outcome.exit == 3);
    CHECK_MESSAGE(
        outcome.err.find(std::string("; by its content it is a ") + kind + " file") != std::string::npos,
        outcome.err);
  }
  const auto grid =
      writeInto(folder, "e.vtu", "<VTKFile type=\"UnstructuredGrid\"><UnstructuredGrid/></VTKFile>");
  const auto outcome = runProgram({"convert", grid, "-o", (folder.path() / "a.vasa").string()});
  CHECK(outcome.exit == 3);
  CHECK_MESSAGE(outcome.err.find("by its content") == std::string::npos, outcome.err);
}
