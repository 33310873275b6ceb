#include <doctest/doctest.h>

#include <algorithm>

#include "body/person.h"
#include "cli/program.h"
#include "cli/strangers.h"
#include "core/atomic_file.h"
#include "io/gltf_builder.h"
#include "network/file.h"
#include "support/shared_data.h"

using namespace vasa;
using namespace vasa::test;

// Bodies of others, and what lies in them, made here, through the program.

TEST_CASE("half a body, whose mirror was not applied, is warned of, and a whole one is not") {
  const TemporaryFolder folder;
  for (const bool half : {true, false}) {
    const auto path = (folder.path() / "body.glb").string();
    REQUIRE(writeFileAtomically(path, personGlb({.half = half})).ok());
    const auto told = runProgram({"info", path});
    REQUIRE_MESSAGE(told.exit == 0, told.err);
    CHECK_MESSAGE(
        (told.err.find("half a body: one side's arm and leg have no skin") != told.err.npos) == half,
        told.err);
  }
}

TEST_CASE("a body that a negative scale mirrors is told of, with what to do") {
  const TemporaryFolder folder;
  const auto path = (folder.path() / "body.glb").string();
  for (const bool mirrored : {true, false}) {
    REQUIRE(writeFileAtomically(path, personGlb({.mirrored = mirrored})).ok());
    const auto told = runProgram({"info", path});
    REQUIRE_MESSAGE(told.exit == 0, told.err);
    CHECK_MESSAGE(
        (told.err.find("a negative scale mirrors it; export it without") != told.err.npos) == mirrored,
        told.err);
  }
}

TEST_CASE("info tells which elements convert would leave out") {
  const TemporaryFolder folder;
  const auto path = (folder.path() / "scan.obj").string();
  std::string text;
  for (const char* name : {"Leber", "arteria"})
    text += std::string("o ") + name + "\nv 0 0 0\nv 0 900 0\nv 5 900 0\nv 5 0 0\nf -4 -3 -2 -1\n";
  REQUIRE(writeFileAtomically(path, text).ok());
  const auto told = runProgram({"info", path, "--json"}).json()["element"];
  REQUIRE(told.size() == 2);
  CHECK(told[0]["left_out"] == "organ");
  CHECK(!told[1].contains("left_out"));
}

TEST_CASE("a body in centimetres or millimetres is read as that, and that is said") {
  const TemporaryFolder folder;
  const auto net = (folder.path() / "net.vasa").string();
  REQUIRE(
      runProgram({"convert", writeInto(folder, "v.swc", personVessels()), "--unit", "m", "-o", net}).exit ==
      0);
  for (const auto& [scale, unit] : {std::pair(100.0f, "centimetres"), std::pair(1000.0f, "millimetres")}) {
    const auto body = writeInto(folder, "large.glb", personGlb({.unitsAMetre = scale}));
    const auto told = runProgram({"info", body, "--json"});
    REQUIRE_MESSAGE(told.exit == 0, told.err);
    CHECK_MESSAGE(told.err.find(unit) != std::string::npos, told.err);
    CHECK(told.json()["body_height_m"].get<double>() == doctest::Approx(1.75).epsilon(0.02));
    std::string heard;
    for (const float way : waysOf(folder, body, net, heard)) CHECK(way == doctest::Approx(1).epsilon(0.02));
  }
}

TEST_CASE(
    "vessels follow a body with a small odd second primitive, and those that a rig leaves behind are told") {
  const TemporaryFolder folder;
  const auto lines = writeInto(folder, "vessels.swc", personVessels());
  const auto net = (folder.path() / "net.vasa").string();
  REQUIRE(runProgram({"convert", lines, "--unit", "m", "-o", net}).exit == 0);
  std::string told;
  for (const float way : waysOf(folder, writeInto(folder, "eyes.glb", personGlb({.eyes = true})), net, told))
    CHECK(way == doctest::Approx(1).epsilon(0.02));
  CHECK_MESSAGE(told.find("stay in the rest pose") == std::string::npos, told);
  told.clear();
  const auto ways = waysOf(folder, writeInto(folder, "stuck.glb", personGlb({.stuck = true})), net, told);
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
  const auto outcome = runProgram({"check", "--body", writeInto(folder, "person.glb", personGlb()),
                                   "--network", writeInto(folder, "lines.swc", swc), "--frames", "0"});
  CHECK_MESSAGE(outcome.exit == 0, outcome.err);
  CHECK_MESSAGE(outcome.err.find("10 % of these vessels lie outside person.glb at rest") != std::string::npos,
                outcome.err);
}

TEST_CASE("rest is the pose that a skin is bound in, for fit as for what it is given to") {
  const TemporaryFolder folder;
  const auto lines = writeInto(folder, "vessels.swc", personVessels());
  const auto net = (folder.path() / "net.vasa").string(), out = (folder.path() / "out.vasa").string();
  REQUIRE(runProgram({"convert", lines, "--unit", "m", "-o", net}).exit == 0);
  const auto stands = writeInto(folder, "stands.glb", personGlb()),
             jumps = writeInto(folder, "jumps.glb", personGlb({.jumps = true}));
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
    const auto outcome = runProgram({"info", writeInto(folder, "odd.glb", written.glb())});
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
