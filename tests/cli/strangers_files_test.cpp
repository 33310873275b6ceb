#include <doctest/doctest.h>

#include "body/person.h"
#include "cli/program.h"
#include "convert/sources.h"
#include "core/atomic_file.h"
#include "io/gltf_builder.h"
#include "io/person_pieces.h"
#include "network/file.h"
#include "network/measure.h"
#include "support/shared_data.h"

using namespace vasa;
using namespace vasa::test;

// Kinds of files that vessels come in, made here, through the program.

namespace {

struct Files {
  TemporaryFolder folder;
  std::string path(const char* name) const { return (folder.path() / name).string(); }
  std::string write(const char* name, const std::string& text) const {
    REQUIRE(writeFileAtomically(path(name), text).ok());
    return path(name);
  }
};

bool holds(const std::string& text, const char* part) { return text.find(part) != text.npos; }

// An object of an .obj file, by corners that count from its own end.
std::string object(const char* name, const TriangleMesh& mesh, float scale = 1, vec3 away = vec3(0)) {
  std::string text = std::string("o ") + name + "\n";
  for (const vec3& p : mesh.positions)
    text += "v " + std::to_string(scale * p.x + away.x) + " " + std::to_string(scale * p.y + away.y) + " " +
            std::to_string(scale * p.z + away.z) + "\n";
  const auto count = int(mesh.positions.size());
  for (const uvec3& t : mesh.triangles)
    text += "f " + std::to_string(int(t.x) - count) + " " + std::to_string(int(t.y) - count) + " " +
            std::to_string(int(t.z) - count) + "\n";
  return text;
}

void addMesh(GltfBuilder& file, const TriangleMesh& mesh) {
  std::vector<float> places;
  std::vector<std::uint32_t> corners;
  for (const vec3& p : mesh.positions) places.insert(places.end(), {p.x, p.y, p.z});
  for (const uvec3& t : mesh.triangles) corners.insert(corners.end(), {t.x, t.y, t.z});
  const int positions = file.floats(places, "VEC3");
  const Aabb box = mesh.bounds();
  auto& told = file.document["accessors"][std::size_t(positions)];
  told["min"] = {box.low.x, box.low.y, box.low.z}, told["max"] = {box.high.x, box.high.y, box.high.z};
  const int indices = file.accessor(corners, "SCALAR", GltfBuilder::kUnsignedInt, corners.size());
  file.add("meshes", {{"primitives", {{{"attributes", {{"POSITION", positions}}}, {"indices", indices}}}}});
}

const TriangleMesh& tube() {
  static const TriangleMesh mesh = tubeBetween({0, 0, 0}, {0, 0.1f, 0}, 0.004f);
  return mesh;
}

}  // namespace

TEST_CASE("curves of 3D Slicer are centre lines, in the unit and the axes that they tell") {
  const Files files;
  std::string points, radii;
  for (int i = 0; i <= 10; ++i) {
    points += std::string(i > 0 ? "," : "") + R"({"position":[3,1,)" + std::to_string(10 * i) + "]}";
    radii += (i > 0 ? ",4" : "4");
  }
  const auto curve = files.write(
      "femoral artery.mrk.json",
      R"({"markups":[{"type":"Curve","coordinateSystem":"LPS","coordinateUnits":"mm","controlPoints":[)" +
          points + R"(],"measurements":[{"name":"Radius","controlPointValues":[)" + radii + "]}]}]}");
  const auto told = runProgram({"info", curve, "--json"});
  REQUIRE_MESSAGE(told.exit == 0, told.err);
  CHECK(told.json()["high_m"].get<double>() == doctest::Approx(0.1));
  const auto net = files.path("a.vasa");
  const auto made = runProgram({"convert", curve, "-o", net, "--json"});
  REQUIRE_MESSAGE(made.exit == 0, made.err);
  CHECK(made.json()["elements"][0]["kind"] == "artery");
  CHECK(made.json()["summary"]["length_m"].get<double>() == doctest::Approx(0.1));
  CHECK(holds(runProgram({"edit", curve, "-o", net}).err, "vasa convert makes a network of it"));
  CHECK(runProgram({"check", curve}).exit == 0);
  const auto unit = runProgram({"convert", curve, "--unit", "mm", "-o", net});
  CHECK(unit.exit == 2);
  CHECK_MESSAGE(holds(unit.err, "tells its unit and its axes itself"), unit.err);
}

TEST_CASE("models of 3D Slicer tell their axes in their heads") {
  const Files files;
  // A bow that leads up and, in its middle, forwards: the same in all files once it is upright and faces +Z.
  const auto made = [&](const char* name, const std::string& head, float side) {
    std::string points, rows;
    for (int i = 0; i <= 20; ++i) {
      const float forwards = 30 * std::sin(kPi * float(i) / 20);
      points += "0 " + std::to_string(-side * forwards) + " " + std::to_string(10 * i) + "\n";
    }
    for (int i = 0; i <= 20; ++i) rows += " " + std::to_string(i);
    const auto file =
        files.write(name, "# vtk DataFile Version 4.2\n" + head +
                              "\nASCII\nDATASET POLYDATA\nPOINTS 21 float\n" + points + "LINES 1 22\n21" +
                              rows + "\nCELL_DATA 1\nSCALARS Radius float 1\n" + "LOOKUP_TABLE default\n4\n");
    const auto net = files.path("a.vasa");
    const auto done = runProgram({"convert", file, "--kind", "artery", "-o", net});
    REQUIRE_MESSAGE(done.exit == 0, done.err);
    const auto network = readNetwork(net);
    REQUIRE(network.ok());
    return measure(*network, network->points()).bounds;
  };
  for (const Aabb& box : {made("lps.vtk", "3D Slicer output. SPACE=LPS", 1),
                          made("ras.vtk", "3D Slicer output. SPACE=RAS", -1)}) {
    CHECK(box.extent().y > 0.19f);
    CHECK(box.high.z > 0.02f);
    CHECK(box.low.z > -0.01f);
  }
  CHECK(made("untold.vtk", "vtk output", 1).extent().z > 0.19f);  // along +Z, as it is
}

TEST_CASE("a .vtp file of 3D Slicer tells its axes, however it is packed") {
  const Files files;
  const auto high = [&](const char* space) {
    std::string points, rows;
    for (int i = 0; i <= 20; ++i)
      points += "0 " + std::to_string(-20 + 2 * i) + " " + std::to_string(10 * i) + "\n",
          rows += " " + std::to_string(i);
    const auto array = [](const char* head, const std::string& text) {
      return std::string("<DataArray ") + head + " format=\"ascii\">" + text + "</DataArray>";
    };
    const auto file = files.write(
        "a.vtp",
        "<VTKFile type=\"PolyData\" byte_order=\"LittleEndian\"><PolyData><FieldData><Array type=\"String\" "
        "Name=\"SPACE\" NumberOfTuples=\"1\" " +
            std::string(space) +
            "</Array></FieldData><Piece NumberOfPoints=\"21\" NumberOfLines=\"1\"><PointData>" +
            array("type=\"Float32\" Name=\"Radius\"", "4 4 4 4 4 4 4 4 4 4 4 4 4 4 4 4 4 4 4 4 4") +
            "</PointData><Points>" + array("type=\"Float32\" NumberOfComponents=\"3\"", points) +
            "</Points><Lines>" + array("type=\"Int32\" Name=\"connectivity\"", rows) +
            array("type=\"Int32\" Name=\"offsets\"", "21") + "</Lines></Piece></PolyData></VTKFile>");
    const auto net = files.path("a.vasa");
    const auto done = runProgram({"convert", file, "--kind", "artery", "-o", net});
    REQUIRE_MESSAGE(done.exit == 0, done.err);
    const auto network = readNetwork(net);
    REQUIRE(network.ok());
    // The line rises and, where +Y of the file is the back, leads backwards.
    const auto& points3 = network->points();
    const vec4 low = points3.front().y < points3.back().y ? points3.front() : points3.back();
    CHECK(measure(*network, points3).bounds.extent().y > 0.19f);
    return low.z;
  };
  CHECK(high("format=\"ascii\">76 80 83 0") > 0.01f);
  CHECK(high("format=\"ascii\">82 65 83 0") < -0.01f);
  CHECK(high("format=\"binary\">BAAAAExQUwA=") > 0.01f);
  CHECK(high("format=\"binary\">BAAAAFJBUwA=") < -0.01f);
}

TEST_CASE("what a file's head says of its unit is taken, unless it were no person's") {
  const Files files;
  const auto high = [&](const char* head, float scale) {
    const auto told =
        runProgram({"info", files.write("aorta.obj", head + object("aorta", tube(), scale)), "--json"});
    REQUIRE_MESSAGE(told.exit == 0, told.err);
    return told.json()["high_m"].get<double>();
  };
  const char* const maya = "# This file uses centimeters as units for non-parametric coordinates.\n";
  CHECK(high("", 100) == doctest::Approx(0.01));
  CHECK(high(maya, 100) == doctest::Approx(0.1));
  CHECK(high(maya, 10000) == doctest::Approx(1));
}

TEST_CASE("a stent beside its vessel is left out with the reason, and one alone is doubtful") {
  const Files files;
  const std::string stent = object("coronary stent", tube(), 800, vec3(0, 5, 0));
  const auto both = runProgram({"convert", files.write("a.obj", object("LAD", tube(), 1000) + stent), "-o",
                                files.path("a.vasa"), "--json"});
  REQUIRE_MESSAGE(both.exit == 0, both.err);
  REQUIRE(both.json()["left_out"].size() == 1);
  CHECK(both.json()["left_out"][0]["name"] == "coronary stent");
  CHECK(both.json()["left_out"][0]["why"] == "device");
  CHECK_MESSAGE(holds(both.err, "'coronary stent' (device)"), both.err);
  const auto file = files.write("b.obj", stent);
  const auto alone = runProgram({"convert", file, "-o", files.path("b.vasa"), "--json"});
  REQUIRE_MESSAGE(alone.exit == 0, alone.err);
  CHECK(alone.json()["elements"][0]["status"] == "doubtful");
  CHECK(holds(alone.json()["elements"][0]["reason"], "its name tells of no vessel (device)"));
  const auto meant = runProgram({"convert", file, "--kind", "artery", "-o", files.path("b.vasa"), "--json"});
  CHECK(meant.json()["elements"][0]["status"] == "ok");
}

TEST_CASE("vessels without a body are drawn, checked and exported; nothing moves them") {
  const Files files;
  const auto one = files.write("far.obj", object("artery", tube(), 1, {5, 1, 0})),
             other = files.write("next.obj", object("vein", tube(), 1, {5.02f, 1, 0})),
             net = files.path("n.vasa");
  REQUIRE(runProgram({"convert", one, "--unit", "m", "-o", net}).exit == 0);
  const auto drawn = runProgram({"render", net, "--size", "64x64", "-o", files.path("a.PNG")});
  CHECK_MESSAGE(drawn.exit == 0, drawn.err);
  const auto lines = runProgram({"export", net, "--network", other, "-o", files.path("A.VTP"), "--json"});
  REQUIRE_MESSAGE(lines.exit == 0, lines.err);
  CHECK(lines.json()["vessels"] == 2);
  CHECK(runProgram({"check", net}).exit == 0);
  const auto moved = runProgram({"render", net, "--clip", "walk", "-o", files.path("b.png")});
  CHECK(moved.exit == 2);
  CHECK_MESSAGE(holds(moved.err, "vessels alone do not move; add --body"), moved.err);
  const auto within = runProgram({"check", net, "--body", humanBody().string()});
  CHECK(within.exit == 3);
  CHECK_MESSAGE(holds(within.err, "vasa render FILE.vasa draws them without a body"), within.err);
}

TEST_CASE("a folder in a network's place is told before anything is read") {
  const Files files;
  const auto outcome = runProgram({"convert", "nothing.obj", "-o", files.folder.path().string()});
  CHECK(outcome.exit == 6);
  CHECK_MESSAGE(holds(outcome.err, "is a folder; name a file in it"), outcome.err);
}

TEST_CASE("vessels that lie kilometres away are refused, not rounded") {
  const Files files;
  const auto far = files.write("far.obj", object("aorta", tube(), 1, vec3(5000, 0, 0)));
  const auto net = files.path("a.vasa");
  const auto metres = runProgram({"convert", far, "--unit", "m", "-o", net});
  CHECK(metres.exit == 3);
  CHECK_MESSAGE(holds(metres.err, "far.obj: vessels lie 5000 m from the origin, where places are rounded"),
                metres.err);
  CHECK(!std::filesystem::exists(net));
}

TEST_CASE("vessels below nodes that are named as limbs are vessels, and a person of pieces is a body") {
  const Files files;
  for (const float radius : {0.004f, 0.08f}) {
    GltfBuilder file;
    addMesh(file, tubeBetween({0, 0, 0}, {0, 0.3f, 0}, radius));
    addPersonPieces(file);
    for (auto& node : file.document["nodes"]) node["mesh"] = 0;
    file.add("scenes", {{"nodes", {0}}});
    const auto outcome = runProgram({"info", files.write("limbs.glb", file.glb()), "--json"});
    REQUIRE_MESSAGE(outcome.exit == 0, outcome.err);
    CHECK(outcome.json()["kind"] == (radius < 0.03f ? "surfaces" : "body"));
  }
}

TEST_CASE("what a glTF file hides, or has in another scene, is left out and named") {
  const Files files;
  const nlohmann::json hidden = {{"KHR_node_visibility", {{"visible", false}}}};
  GltfBuilder file;
  addMesh(file, tube());
  file.add("nodes", {{"name", "aorta"}, {"mesh", 0}});
  file.add("nodes", {{"name", "old"}, {"children", {2}}, {"extensions", hidden}});
  file.add("nodes", {{"name", "vena cava"}, {"mesh", 0}, {"translation", {0.1, 0, 0}}});
  file.add("nodes", {{"name", "spare artery"}, {"mesh", 0}, {"translation", {0.2, 0, 0}}});
  file.add("scenes", {{"nodes", {0, 1}}});
  file.add("scenes", {{"nodes", {3}}});
  const auto outcome = runProgram({"info", files.write("a.glb", file.glb()), "--json"});
  REQUIRE_MESSAGE(outcome.exit == 0, outcome.err);
  CHECK(outcome.json()["elements"] == 1);
  CHECK(outcome.json()["element"][0]["name"] == "aorta");
  CHECK_MESSAGE(holds(outcome.err,
                      "a.glb: meshes of 2 nodes are hidden, or not in the scene that the file shows first, "
                      "and left out: 'vena cava' first"),
                outcome.err);
}

TEST_CASE("centimetres are not guessed but named, and micrometres are read as such") {
  const Files files;
  const auto said = [&](float scale) {
    const auto made = runProgram(
        {"convert", files.write("aorta.obj", object("aorta", tube(), scale)), "-o", files.path("a.vasa")});
    CHECK_MESSAGE(made.exit == 0, made.err);
    return made.err;
  };
  CHECK_MESSAGE(holds(said(100), "as in metres they would be 10 m large (in centimetres 0.1 m); --unit says"),
                said(100));
  CHECK(holds(said(1e5f), "read as micrometres, as in millimetres they would be"));
  CHECK(!holds(said(5e3f), "centimetres"));
}

TEST_CASE("a body of two centimetres is warned of") {
  const Files files;
  const auto small = runProgram({"info", files.write("a.glb", personGlb({.unitsAMetre = 0.01f}))});
  REQUIRE_MESSAGE(small.exit == 0, small.err);
  CHECK_MESSAGE(holds(small.err, "mm large, and glTF is in metres"), small.err);
}

TEST_CASE(
    "a clip that scales a joint to nothing is played to its end, and a late frame of a long one is told") {
  const Files files;
  std::string swc;
  for (int i = 0; i <= 10; ++i)
    swc += std::to_string(i + 1) + " 10 0.02 " + std::to_string(1 + 0.03 * i) + " 0 0.006 " +
           std::to_string(i > 0 ? i : -1) + "\n";
  const auto vessel = files.write("v.swc", swc);
  const auto check = [&](const PersonFile& person, const char* frames) {
    return runProgram({"check", "--body", files.write("a.glb", personGlb(person)), "--network", vessel,
                       "--clip", "walk", "--frames", frames});
  };
  const auto vanished = check({.vanishes = true}, "58:60");
  CHECK_MESSAGE((vanished.exit == 0 || vanished.exit == 1), vanished.err);
  CHECK_MESSAGE(
      holds(vanished.err, "the clip \"walk\" scales the joint \"chest\" to more than twice or less"),
      vanished.err);
  const auto late = check({.seconds = 40}, "1200");
  CHECK_MESSAGE(late.exit == 0, late.err);
  CHECK_MESSAGE(
      holds(late.err, "walk: frame 1200 follows from those before it, of which 1200 are solved first"),
      late.err);
}

TEST_CASE("names of columns, and comments, tell units; commas between semicolons are decimal points") {
  const Files files;
  const auto lengthOf = [&](const std::string& file, std::string& told) {
    const auto done = runProgram({"convert", file, "--kind", "artery", "-o", files.path("a.vasa"), "--json"});
    REQUIRE_MESSAGE(done.exit == 0, done.err);
    told = done.err;
    return done.json()["summary"]["length_m"].get<double>();
  };
  std::string told, table = "\xEF\xBB\xBFid;type;x [cm];y [cm];z [cm];radius [cm];parent\r\n";
  for (int i = 0; i <= 10; ++i)
    table += std::to_string(i + 1) + ";10;0,5;" + std::to_string(10 + i) + ",5;0;0,4;" +
             std::to_string(i > 0 ? i : -1) + "\r\n";
  CHECK(lengthOf(files.write("table.swc", table), told) == doctest::Approx(0.1));
  CHECK_MESSAGE(holds(told, "centimetres, as its head says"), told);
  const auto inches = "# Units: inches\n" + object("aorta", tube(), 1 / 0.0254f);
  CHECK(lengthOf(files.write("tube.obj", inches), told) == doctest::Approx(0.1).epsilon(0.1));
  CHECK_MESSAGE(holds(told, "inches, as its head says"), told);
}

TEST_CASE("vessels that are given twice are told, and left out where they are all") {
  const Files files;
  const auto one = files.path("one.vasa"), both = files.path("both.vasa");
  const auto artery = files.write("artery.obj", object("aorta", tube()));
  const auto vein = files.write("vein.obj", object("caval vein", tube(), 1, {0.05f, 0, 0}));
  REQUIRE(runProgram({"convert", artery, "-o", one}).exit == 0);
  REQUIRE(runProgram({"convert", artery, vein, "-o", both}).exit == 0);
  const auto again = runProgram({"check", one, "--network", one, "--json"});
  CHECK(again.exit == 0);
  CHECK_MESSAGE(holds(again.err, "one.vasa: tells the same vessels as "), again.err);
  CHECK(again.json()["summary"]["rest_pairs"] == 0);
  const auto more = runProgram({"check", one, "--network", both});
  CHECK_MESSAGE(holds(more.err, "both.vasa: 1 of its 2 vessels are in "), more.err);
  const auto poses = runProgram({"poses", one});
  CHECK(poses.exit == 2);
  CHECK_MESSAGE(holds(poses.err, "vessels alone have no poses; add --body FILE.glb"), poses.err);
}
