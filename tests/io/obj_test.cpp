#include "io/obj.h"

#include <doctest/doctest.h>

#include "core/atomic_file.h"
#include "io/reading.h"
#include "support/shared_data.h"

using namespace vasa;

namespace {

using test::contains;

struct ObjFile {
  test::TemporaryFolder folder;
  Result<std::vector<MeshElement>> read(const std::string& text, const ImportFrame& frame = {}) {
    REQUIRE(writeFileAtomically(folder.path() / "vessel.obj", text).ok());
    return readObj(folder.path() / "vessel.obj", frame);
  }
  std::string fault(const std::string& text) {
    const auto read = this->read(text);
    REQUIRE(!read.ok());
    CHECK(read.error().fault == Fault::badInput);
    return read.error().message;
  }
};

constexpr const char* kSquare = "v 0 0 0\nv 1 0 0\nv 1 2 0\nv 0 2 0\n";

}  // namespace

TEST_CASE("an OBJ gives one element an object, polygons cut into triangles, other vertices left out") {
  ObjFile file;
  const auto elements =
      file.read(std::string("# a comment\nmtllib ../../etc/passwd\n") + kSquare +
                "v 9 9 9\nvn 0 0 1\no left vein\nf 1//1 2//1 3//1 4//1\no right\nf -5 -4 -3\n");
  REQUIRE(elements.ok());
  REQUIRE(elements->size() == 2);
  CHECK((*elements)[0].name == "left vein");
  CHECK((*elements)[0].mesh.triangles.size() == 2);
  CHECK((*elements)[0].mesh.positions.size() == 4);
  CHECK((*elements)[0].mesh.area() == doctest::Approx(2));
  CHECK((*elements)[1].name == "right");
  CHECK((*elements)[1].mesh.triangles.size() == 1);
}

TEST_CASE("an OBJ's object knows the material of its first face, what comes before the first object too") {
  ObjFile file;
  const auto elements =
      file.read(std::string(kSquare) +
                "f 1 2 3\nusemtl Portal vein \no a\nf 1 2 3\nusemtl red\nf 1 3 4\no b\nf 1 2 4\n");
  REQUIRE(elements.ok());
  REQUIRE(elements->size() == 3);
  CHECK((*elements)[0].surroundings.empty());
  CHECK((*elements)[1].surroundings == std::vector<std::string>{"Portal vein"});
  CHECK((*elements)[2].surroundings == std::vector<std::string>{"red"});
}

TEST_CASE("an OBJ's group that is named again goes on, within its object") {
  ObjFile file;
  const auto elements =
      file.read(std::string(kSquare) + "g a\nusemtl red\nf 1 2 3\ng b\nf 1 2 4\ng a\nusemtl blue\nf 1 3 4\n");
  REQUIRE(elements.ok());
  REQUIRE(elements->size() == 2);
  CHECK((*elements)[0].name == "a");
  CHECK((*elements)[0].mesh.triangles.size() == 2);
  CHECK((*elements)[0].mesh.positions.size() == 4);
  CHECK((*elements)[0].surroundings == std::vector<std::string>{"red"});
  CHECK((*elements)[1].name == "b");
  CHECK((*elements)[1].mesh.triangles.size() == 1);
  // Groups of others, and groups without a name, are their own.
  const auto apart =
      file.read(std::string(kSquare) +
                "o left\ng default\nf 1 2 3\no right\ng default\nf 1 3 4\ng\nf 1 2 3\ng\nf 1 2 4\n");
  REQUIRE(apart.ok());
  CHECK(apart->size() == 4);
}

TEST_CASE("an OBJ's lines go on behind a backslash, and may end with carriage returns") {
  ObjFile file;
  for (const std::string end : {"\n", "\r\n", "\r"}) {
    std::string text =
        "# C:\\tubes\\\nv 0 0 0\nv 1 \\\n0 0\nv 1 2 0\nusemtl Portal \\\nvein\no a\nf 1 \\\n2 \\\n3\n";
    for (std::size_t at = 0; (at = text.find('\n', at)) != text.npos; at += end.size())
      text.replace(at, 1, end);
    const auto elements = file.read(text);
    if (!elements.ok()) FAIL(elements.error().message);
    CHECK(elements->front().name == "a");
    CHECK(elements->front().mesh.area() == doctest::Approx(1));
    REQUIRE(elements->front().surroundings.size() == 1);
  }
  CHECK(contains(file.fault("v 0 \\\n0 x\n"), "vessel.obj:2: a vertex needs"));
  CHECK(file.read(std::string(kSquare) + "f 1 2 3 \\").ok());
}

TEST_CASE("an OBJ in millimetres with Z up comes out in metres with Y up") {
  ObjFile file;
  const auto elements =
      file.read("v 0 0 0\nv 1000 0 0\nv 0 2000 3000\nf 1 2 3\n", {0.001f, ImportFrame::Up::z});
  REQUIRE(elements.ok());
  CHECK((*elements)[0].name == "vessel");
  CHECK(glm::distance((*elements)[0].mesh.positions[2], vec3(0, 3, -2)) < 1e-6f);
}

TEST_CASE("faults of an OBJ are named with file and line") {
  ObjFile file;
  CHECK(
      contains(file.fault("v 0 0 nan\n"), "vessel.obj:1: a vertex needs three finite numbers, found 'nan'"));
  CHECK(contains(file.fault("v 0 0\n"), "needs three finite numbers"));
  CHECK(contains(file.fault("v 0 0 1e9\n"), "vasa convert --unit"));
  CHECK(contains(file.fault(std::string(kSquare) + "f 1 2\n"),
                 "vessel.obj:5: a face needs at least three corners"));
  CHECK(contains(file.fault(std::string(kSquare) + "f 1 2 7\n"),
                 ":5: face index 7 lies outside the 4 vertices"));
  CHECK(contains(file.fault(std::string(kSquare) + "f 1 2 -9\n"), "face index -9"));
  CHECK(contains(file.fault(std::string(kSquare) + "f 1 2 0\n"),
                 "needs a vertex index, found '0'; indices begin at 1"));
  CHECK(contains(file.fault("v 0,5 0 0\n"), "write decimal points, not commas"));
  CHECK(contains(file.fault(std::string("\xFF\xFEv\0 \0", 6)), "the text is UTF-16; save it as UTF-8"));
  CHECK(contains(file.fault(std::string(kSquare) + "f a b c\n"), "needs a vertex index, found 'a'"));
  CHECK(contains(file.fault(kSquare), "has no faces"));
  CHECK(contains(file.fault(""), "has no faces"));
  CHECK(contains(file.fault(std::string(kSquare) + "f 1 1 1\n"), "lost its area"));
  const auto absent = readObj(file.folder.path() / "absent.obj");
  REQUIRE(!absent.ok());
  CHECK(absent.error().fault == Fault::io);
}

TEST_CASE("a published vessel lands in the house frame") {
  VASA_REQUIRE_SHARED_DATA(data);
  const auto elements = readObj(data / "bp3d/raw_obj/FJ1853.obj", {0.213f, ImportFrame::Up::z});
  REQUIRE(elements.ok());
  REQUIRE(elements->size() == 1);
  const Aabb box = (*elements)[0].mesh.bounds();  // the same vessel in bp3d_veins.glb
  CHECK(glm::distance(box.low, vec3(-0.021459f, 1.062281f, 0.123590f)) < 1e-3f);
  CHECK(glm::distance(box.high, vec3(-0.007088f, 1.111062f, 0.144200f)) < 1e-3f);
}

TEST_CASE("which of an element's triangles have which material is told, in the order of its own faces") {
  const auto elements = parseObj(
      "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nusemtl red\ng tube\nf 1 2 3\nusemtl blue\nf 1 2 4\nf 1 3 4\n"
      "g other\nf 2 3 4\nusemtl red\ng tube\nf 2 3 4\n",
      "x.obj", {});
  REQUIRE(elements);
  REQUIRE(elements->size() == 2);
  const std::vector<MeshMaterial>& tube = (*elements)[0].materials;
  REQUIRE(tube.size() == 3);
  CHECK(tube[0].name == "red");
  CHECK(tube[0].firstTriangle == 0);
  CHECK(tube[1].name == "blue");
  CHECK(tube[1].firstTriangle == 1);
  CHECK(tube[2].name == "red");
  CHECK(tube[2].firstTriangle == 3);
  REQUIRE((*elements)[1].materials.size() == 1);
  CHECK((*elements)[1].materials[0].name == "blue");
}

TEST_CASE("colours of vertices tell what an object is drawn with, where all have one") {
  const auto coloursOf = [](const char* text) {
    const auto elements = parseObj(text, "a.obj");
    REQUIRE(elements.ok());
    std::vector<MeshMaterial> materials = (*elements)[0].materials;
    if (!materials.empty()) CHECK((*elements)[0].colour == materials[0].colour);
    return materials;
  };
  const std::string red = "v 0 0 0 1 0 0\nv 1 0 0 1 0 0\nv 0 1 0 1 0 0\n",
                    blue = "v 0 0 1 0 0 1\nv 1 0 1 0 0 1\nv 0 1 1 0 0 1\n", faces = "f 1 2 3\nf 4 5 6\n";
  const auto both = coloursOf((red + blue + faces).c_str());
  REQUIRE(both.size() == 2);
  CHECK(both[0].colour == vec3(1, 0, 0));
  CHECK(both[1].colour == vec3(0, 0, 1));
  CHECK(both[1].firstTriangle == 1);
  const auto named = coloursOf((red + blue + "usemtl wall\n" + faces).c_str());
  REQUIRE(named.size() == 2);
  CHECK(named[1].name == "wall");
  const auto each = coloursOf((red + blue + "usemtl a\nf 1 2 3\nusemtl b\nf 4 5 6\n").c_str());
  REQUIRE(each.size() == 2);
  CHECK(each[1].name == "b");
  CHECK(each[1].colour == vec3(0, 0, 1));
  const auto bytes = coloursOf(("v 0 0 0 255 0 0\nv 1 0 0 255 0 0\nv 0 1 0 255 0 0\nv 0 0 1 0 0 255\n"
                                "v 1 0 1 0 0 255\nv 0 1 1 0 0 255\n" +
                                faces)
                                   .c_str());
  REQUIRE(bytes.size() == 2);
  CHECK(bytes[0].colour == vec3(1, 0, 0));
  CHECK(coloursOf((red + "v 0 0 1\nv 1 0 1 0 0 1\nv 0 1 1 0 0 1\n" + faces).c_str()).empty());
  CHECK(coloursOf((red + "v 0 0 1 1.0\nv 1 0 1 1.0\nv 0 1 1 1.0\n" + faces).c_str()).empty());
}
