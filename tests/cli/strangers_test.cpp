#include <doctest/doctest.h>

#include <algorithm>
#include <cstdio>

#include "body/doll.h"
#include "body/person.h"
#include "cli/program.h"
#include "core/atomic_file.h"
#include "io/bvh.h"
#include "io/gltf.h"
#include "io/gltf_builder.h"
#include "io/swc.h"
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
  const auto thing =
      runProgram({"info",
                  write(folder, "thing.bvh",
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
    const auto outcome = runProgram({"info", write(folder, "odd.bvh", text)});
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
    return write(folder, name, swc);
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
  const auto spaced = write(folder, "left vein's end.swc", "1 0 0 0 0 0.001 -1\n2 0 0 0.1 0 0.001 1\n");
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

std::string line(const char* word, vec3 p, const char* end) {
  char text[128];
  std::snprintf(text, sizeof text, "%s%.4f %.4f %.4f%s", word, double(p.x), double(p.y), double(p.z), end);
  return text;
}

// The built-in human's trunk as a scan would have it: the skin between crotch and shoulders, without arms.
std::string scannedTrunk() {
  const auto body = readBody(humanBody());
  REQUIRE(body.ok());
  std::string obj = "o trunk\n";
  const auto skin = std::ranges::find(body->meshes, std::string("skin"), &SkinnedMesh::name);
  REQUIRE(skin != body->meshes.end());
  for (const vec3& p : skin->mesh.positions) obj += line("v ", scanned(p), "\n");
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
    swc += std::to_string(id) + " 0" + line(" ", scanned(vec3(p)), " ") + std::to_string(900 * p.w) + " " +
           std::to_string(i ? id - 1 : -1) + "\n";
  }
  const auto path = [&](const char* name) { return (folder.path() / name).string(); };
  const auto lines = write(folder, "aorta.swc", swc), trunk = write(folder, "trunk.obj", scannedTrunk());
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
                    write(folder, "map.txt", "a = b\n"), "-o", path("x.vasa")})
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
    const auto outcome = runProgram(
        {"convert", write(folder, "odd.swc", rows), "-o", (folder.path() / "odd.vasa").string(), "--json"});
    REQUIRE_MESSAGE(outcome.exit == 0, outcome.err);
    CHECK(outcome.json()["summary"]["doubtful"] == 1);
  }
}

namespace {

// A vein along the spine and an artery down to the knee, in metres.
std::string personVessels() {
  std::string swc;
  int id = 0;
  const auto trace = [&](vec3 from, vec3 to, int type) {
    for (int i = 0; i <= 12; ++i) {
      ++id;
      swc += std::to_string(id) + " " + std::to_string(type) +
             line(" ", glm::mix(from, to, float(i) / 12), " ") + "0.006 " + std::to_string(i ? id - 1 : -1) +
             "\n";
    }
  };
  trace({0.02f, 1.4f, -0.03f}, {0.02f, 0.96f, -0.03f}, 11);
  trace({-0.09f, 0.88f, 0.01f}, {-0.09f, 0.45f, 0.01f}, 10);
  return swc;
}

// How far each vessel goes between two frames of walk, in the mean [m].
std::vector<float> waysOf(const TemporaryFolder& folder, const std::string& body, const std::string& network,
                          std::string& told) {
  std::vector<std::vector<vec3>> at;
  for (const char* frame : {"0", "60"}) {
    const auto out = (folder.path() / (std::string(frame) + ".swc")).string();
    const auto outcome =
        runProgram({"export", "--body", body, "--network", network, "--clip", "walk", "--frames",
                    std::string(frame) + ":" + frame, "--unit", "m", "-o", out, "--no-avoid"});
    REQUIRE_MESSAGE(outcome.exit == 0, outcome.err);
    told += outcome.err;
    const auto samples = readSwc(out, {});
    REQUIRE(samples.ok());
    at.emplace_back();
    for (const auto& sample : *samples) at.back().push_back(sample.position);
  }
  REQUIRE(at[0].size() == at[1].size());
  std::vector<float> ways;
  for (std::size_t i = 0; i < at[0].size(); ++i) ways.push_back(glm::distance(at[0][i], at[1][i]));
  return ways;
}

}  // namespace

TEST_CASE("centre lines whose radii are in another unit than their places are doubtful") {
  const TemporaryFolder folder;
  const auto swc = write(folder, "odd.swc", "1 0 0 0 0 1 -1\n2 0 0 0.1 0 1 1\n3 0 0 0.2 0 1 2\n");
  const auto outcome = runProgram({"convert", swc, "-o", (folder.path() / "odd.vasa").string(), "--json"});
  REQUIRE_MESSAGE(outcome.exit == 0, outcome.err);
  CHECK(outcome.json()["summary"]["doubtful"] == 1);
}

TEST_CASE("a body in centimetres or millimetres is read as that, and that is said") {
  const TemporaryFolder folder;
  const auto net = (folder.path() / "net.vasa").string();
  REQUIRE(runProgram({"convert", write(folder, "v.swc", personVessels()), "--unit", "m", "-o", net}).exit ==
          0);
  for (const auto& [scale, unit] : {std::pair(100.0f, "centimetres"), std::pair(1000.0f, "millimetres")}) {
    const auto body = write(folder, "large.glb", personGlb({.unitsAMetre = scale}));
    const auto told = runProgram({"info", body, "--json"});
    REQUIRE_MESSAGE(told.exit == 0, told.err);
    CHECK_MESSAGE(told.err.find(unit) != std::string::npos, told.err);
    CHECK(told.json()["body_height_m"].get<double>() == doctest::Approx(1.75).epsilon(0.02));
    std::string heard;
    for (const float way : waysOf(folder, body, net, heard)) CHECK(way == doctest::Approx(1).epsilon(0.02));
  }
}

TEST_CASE("surfaces that are no vessels and are taken for a network are warned of") {
  const TemporaryFolder folder;
  const auto placed = runProgram(
      {"place", write(folder, "trunk.obj", scannedTrunk()), "-o", (folder.path() / "x.vasa").string()});
  CHECK_MESSAGE(placed.exit == 0, placed.err);
  CHECK_MESSAGE(placed.err.find("trunk.obj: 1 of 1 elements are doubtful as vessels") != std::string::npos,
                placed.err);
  CHECK(placed.err.find("give a body with --body") != std::string::npos);
}

TEST_CASE("info tells of vessels before they are converted") {
  const TemporaryFolder folder;
  const auto lines = runProgram({"info", write(folder, "vein.swc", personVessels()), "--json"});
  REQUIRE_MESSAGE(lines.exit == 0, lines.err);
  CHECK(lines.json()["kind"] == "centre lines");
  CHECK(lines.json()["lines"] == 2);
  const auto surface = runProgram({"info", write(folder, "trunk.obj", scannedTrunk()), "--json"});
  REQUIRE_MESSAGE(surface.exit == 0, surface.err);
  CHECK(surface.json()["kind"] == "surfaces");
  CHECK(surface.json()["metres_a_unit"] == 0.001);
  CHECK(surface.json()["next"].get<std::string>().starts_with("vasa convert"));
  CHECK(runProgram({"info", (folder.path() / "none.swc").string()}).exit == 6);
  // What a file of this kind does not have is not left out without a word.
  const auto swc = write(folder, "v.swc", personVessels()), net = humanVessels().string();
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
  const auto fbx = write(folder, "body.fbx", "Kaydara"), c3d = write(folder, "walk.c3d", "x");
  expect({"map", fbx, human}, 3, "export it with its armature as .glb");
  expect({"fit", net, "--from", fbx, "--to", human, "-o", "x.vasa"}, 3, "armature as .glb");
  expect({"map", net, human}, 3, "it is a network: name a body in its place");
  expect({"fit", net, "--from", human, "--to", net, "-o", "x.vasa"}, 3, "name a body in its place");
  expect({"place", write(folder, "walk.bvh", "HIERARCHY"), "-o", "x.vasa"}, 3,
         "it is a motion, and no vessels");
  const auto walk = write(folder, "walk.bvh", "HIERARCHY");
  expect({"compare", walk, net}, 3, "it is a motion, and no vessels");
  expect({"edit", walk, write(folder, "no.vedit", ""), "-o", "x.vasa"}, 3, "it is a motion, and no vessels");
  expect({"check", "--clip", c3d, "--frames", "0"}, 3, "turn it into .bvh first");
  expect({"check", "--clip", fbx, "--frames", "0"}, 3, "export the armature's motion as .bvh");
  expect({"info", write(folder, "notes.txt", "x")}, 2, "write centre lines as .swc");
  expect({"render", human, "-o", "x.png"}, 3, "a body is given with --body");
  const auto lines = write(folder, "v.swc", personVessels()),
             trunk = write(folder, "trunk.obj", scannedTrunk());
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
  const auto lines = write(folder, "v.swc", personVessels());
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
  refused({"poses", "--ranges", write(folder, "none.csv", head)}, 3, "has no row below its header");
  refused({"poses", "--ranges", write(folder, "far.csv", head + "head flexion,head,flexion,-25,4000\n")}, 3,
          "far.csv:2: low_deg and high_deg must be from -180 to 180");
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
        runProgram({"convert", write(folder, name, "x"), "-o", (folder.path() / "a.vasa").string()});
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
        runProgram({"convert", write(folder, name, text), "-o", (folder.path() / "a.vasa").string()});
    CHECK(outcome.exit == 3);
    CHECK_MESSAGE(
        outcome.err.find(std::string("; by its content it is a ") + kind + " file") != std::string::npos,
        outcome.err);
  }
  const auto grid =
      write(folder, "e.vtu", "<VTKFile type=\"UnstructuredGrid\"><UnstructuredGrid/></VTKFile>");
  const auto outcome = runProgram({"convert", grid, "-o", (folder.path() / "a.vasa").string()});
  CHECK(outcome.exit == 3);
  CHECK_MESSAGE(outcome.err.find("by its content") == std::string::npos, outcome.err);
}

TEST_CASE(
    "vessels follow a body with a small odd second primitive, and those that a rig leaves behind are told") {
  const TemporaryFolder folder;
  const auto lines = write(folder, "vessels.swc", personVessels());
  const auto net = (folder.path() / "net.vasa").string();
  REQUIRE(runProgram({"convert", lines, "--unit", "m", "-o", net}).exit == 0);
  std::string told;
  for (const float way : waysOf(folder, write(folder, "eyes.glb", personGlb({.eyes = true})), net, told))
    CHECK(way == doctest::Approx(1).epsilon(0.02));
  CHECK_MESSAGE(told.find("stay in the rest pose") == std::string::npos, told);
  told.clear();
  const auto ways = waysOf(folder, write(folder, "stuck.glb", personGlb({.stuck = true})), net, told);
  const bool follow = std::ranges::all_of(ways, [](float way) { return way > 0.9f; });
  CHECK_MESSAGE((follow || told.find("stay in the rest pose while stuck.glb moves") != std::string::npos),
                told);
}

TEST_CASE("some vessels that lie outside a body are told of") {
  const TemporaryFolder folder;
  std::string swc;
  for (int vessel = 0; vessel < 10; ++vessel)
    for (int i = 0; i <= 1; ++i) {
      const float x = vessel < 9 ? 0.01f * float(vessel - 4) : 0.9f;  // the last beside the hand
      const int id = 2 * vessel + i + 1;
      swc += std::to_string(id) + " 10 " + std::to_string(x) + (i ? " 1.2" : " 1.0") + " -0.03 0.002 " +
             std::to_string(i ? id - 1 : -1) + "\n";
    }
  const auto outcome = runProgram({"check", "--body", write(folder, "person.glb", personGlb()), "--network",
                                   write(folder, "lines.swc", swc), "--frames", "0"});
  CHECK_MESSAGE(outcome.exit == 0, outcome.err);
  CHECK_MESSAGE(outcome.err.find("10 % of these vessels lie outside person.glb at rest") != std::string::npos,
                outcome.err);
}

TEST_CASE("rest is the pose that a skin is bound in, for fit as for what it is given to") {
  const TemporaryFolder folder;
  const auto lines = write(folder, "vessels.swc", personVessels());
  const auto net = (folder.path() / "net.vasa").string(), out = (folder.path() / "out.vasa").string();
  REQUIRE(runProgram({"convert", lines, "--unit", "m", "-o", net}).exit == 0);
  const auto stands = write(folder, "stands.glb", personGlb()),
             jumps = write(folder, "jumps.glb", personGlb({.jumps = true}));
  const auto outcome =
      runProgram({"fit", net, "--from", stands, "--to", jumps, "-o", out, "--exact", "--json"});
  REQUIRE_MESSAGE(outcome.exit == 0, outcome.err);
  CHECK(outcome.json()["outside_skin"]["share"].get<double>() < 0.01);
  const auto before = readNetwork(net), after = readNetwork(out);
  REQUIRE(before.ok());
  REQUIRE(after.ok());
  for (std::size_t i = 0; i < before->points().size(); ++i)
    CHECK(glm::distance(vec3(before->points()[i]), vec3(after->points()[i])) < 0.002f);
  CHECK(after->bodyHeight() == doctest::Approx(1.75f).epsilon(0.02));
  CHECK(runProgram({"check", "--body", jumps, "--network", out, "--frames", "0"}).exit == 0);
}

TEST_CASE(
    "what a body's file leaves open is told: no binding, packed in a pose, a scene without its meshes") {
  const TemporaryFolder folder;
  const auto said = [&](const GltfBuilder& file) {
    GltfBuilder written = file;
    const auto outcome = runProgram({"info", write(folder, "odd.glb", written.glb())});
    CHECK(outcome.exit == 0);
    return outcome.err;
  };
  CHECK(said(bodyFile()) == "");
  GltfBuilder unbound = bodyFile();
  unbound.document["skins"][0].erase("inverseBindMatrices");
  CHECK(said(unbound).find("warning: odd.glb: a skin has no inverse bind matrices") == 0);
  GltfBuilder elsewhere = bodyFile();
  elsewhere.document["scenes"] = {{{"nodes", {0}}}, {{"nodes", {0, 2}}}};
  CHECK(said(elsewhere).find("warning: odd.glb: none of its meshes can be shown") == 0);
  elsewhere.document["scene"] = 1;
  CHECK(said(elsewhere) == "");
  GltfBuilder still = bodyFile();
  still.add("animations", {{"name", "face"},
                           {"samplers", {{{"input", 4}, {"output", 5}}}},
                           {"channels", {{{"sampler", 0}, {"target", {{"path", "rotation"}}}}}}});
  CHECK(said(still).find("odd.glb: 1 of 2 animations move no joint") == 0);
  GltfBuilder packed = bodyFile();
  const int positions = packed.accessor<std::int16_t>({0, 1, 0, 0, 1, 1, 0, 0, 0, 0, 0, 0}, "VEC3", 5122, 3);
  packed.document["bufferViews"].back()["byteStride"] = 8;
  packed.document["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = positions;
  packed.document["extensionsUsed"] = {"KHR_mesh_quantization"};
  CHECK(said(packed) == "");
  packed.document["nodes"][1]["rotation"] = {0, 0, 0.6, 0.8};
  CHECK(said(packed).find("warning: odd.glb: its vertices are packed") == 0);
}
