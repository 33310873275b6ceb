#include "io/stl.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cctype>
#include <cstring>
#include <limits>

#include "core/atomic_file.h"
#include "io/reading.h"
#include "support/shared_data.h"

using namespace vasa;

namespace {

using test::contains;

struct StlFile {
  test::TemporaryFolder folder;
  Result<std::vector<MeshElement>> read(const std::string& text, const ImportFrame& frame = {}) {
    REQUIRE(writeFileAtomically(folder.path() / "vessel.stl", text).ok());
    return readStl(folder.path() / "vessel.stl", frame);
  }
  std::string fault(const std::string& text) {
    const auto read = this->read(text);
    REQUIRE(!read.ok());
    CHECK(read.error().fault == Fault::badInput);
    return read.error().message;
  }
};

std::string facet(const std::string& a, const std::string& b, const std::string& c) {
  return "facet normal 0 0 1\n outer loop\n  vertex " + a + "\n  vertex " + b + "\n  vertex " + c +
         "\n endloop\nendfacet\n";
}

std::string binary(const std::vector<std::array<vec3, 3>>& triangles, std::uint32_t promised) {
  std::string bytes(80, 's');
  bytes.replace(0, 5, "solid");
  const auto put = [&bytes](const void* at, std::size_t size) {
    bytes.append(static_cast<const char*>(at), size);
  };
  put(&promised, 4);
  for (const auto& triangle : triangles) {
    const vec3 normal(0);
    put(&normal, 12);
    for (const vec3& corner : triangle) put(&corner, 12);
    bytes.append(2, '\0');
  }
  return bytes;
}

const std::vector<std::array<vec3, 3>> kTwo{{vec3(0, 0, 0), vec3(1, 0, 0), vec3(0, 1, 0)},
                                            {vec3(1, 0, 0), vec3(1, 1, 0), vec3(0, 1, -0.0f)}};

}  // namespace

TEST_CASE("ASCII STL: one element a solid, equal corners shared") {
  StlFile file;
  const auto elements =
      file.read("solid left vein\n" + facet("0 0 0", "1 0 0", "0 1 0") + facet("1 0 0", "1 1 0", "0 1 -0") +
                "endsolid left vein\nsolid\n" + facet("0 0 0", "+1e0 0 0", "0 1 0") +
                facet("0 0 0", "0 0 0", "1 1 1") + "endsolid\n");
  REQUIRE(elements.ok());
  REQUIRE(elements->size() == 2);
  CHECK((*elements)[0].name == "left vein");
  CHECK((*elements)[0].mesh.positions.size() == 4);
  CHECK((*elements)[0].mesh.triangles.size() == 2);
  CHECK((*elements)[1].name == "vessel 1");
  CHECK((*elements)[1].mesh.triangles.size() == 1);
}

TEST_CASE("solids of an ASCII STL: one bears the file's name, of several each has its own") {
  StlFile file;
  const auto namesOf = [&](const std::vector<std::string>& titles) {
    std::string text;
    for (const std::string& title : titles)
      text += "solid " + title + "\n" + facet("0 0 0", "1 0 0", "0 1 0") + "endsolid\n";
    const auto elements = file.read(text);
    if (!elements.ok()) FAIL(elements.error().message);
    std::vector<std::string> names;
    for (const MeshElement& element : *elements) names.push_back(element.name);
    return names;
  };
  using Names = std::vector<std::string>;
  CHECK(namesOf({"Exported from Blender-2.82 (sub 7)"}) == Names{"vessel"});
  CHECK(namesOf({"aorta", "left vein"}) == Names{"aorta", "left vein"});
  CHECK(namesOf({"vcg", "vcg", "aorta", "", "vessel 2"}) ==
        Names{"vessel 1", "vessel 3", "aorta", "vessel 4", "vessel 2"});
}

TEST_CASE("ASCII STL: carriage returns end lines, UTF-16 is named") {
  StlFile file;
  std::string text = "solid a\n" + facet("0 0 0", "1 0 0", "0 1 x");
  std::ranges::replace(text, '\n', '\r');
  CHECK(contains(file.fault(text), ":6: a corner needs three finite numbers"));
  std::string wide;
  for (const char c : text) wide.append({c, '\0'});
  CHECK(contains(file.fault(wide), "the text is UTF-16; save it as UTF-8"));
}

TEST_CASE("STL of others: words in capitals; binary with bytes behind its triangles, or cut short") {
  StlFile file;
  std::string text = "solid a\n" + facet("0 0 0", "1 0 0", "0 1 0") + "endsolid a\n";
  for (char& c : text) c = char(std::toupper(static_cast<unsigned char>(c)));
  CHECK(file.read(text).ok());
  const std::string bytes = binary({{vec3(0), vec3(1, 0, 0), vec3(0, 1, 0)}}, 1);
  const auto longer = file.read(bytes + std::string(7, '\0'));
  REQUIRE(longer.ok());
  CHECK(longer->front().mesh.triangles.size() == 1);
  CHECK(contains(file.fault(bytes.substr(0, bytes.size() - 9)), "cut short"));
  const auto unnumbered = file.read(binary(kTwo, 0));  // of a program that wrote as it went
  REQUIRE(unnumbered.ok());
  CHECK(unnumbered->front().mesh.triangles.size() == 2);
}

TEST_CASE("a binary STL that begins with the word solid is read as binary") {
  StlFile file;
  const auto elements = file.read(binary(kTwo, 2), {0.001f, ImportFrame::Up::z});
  REQUIRE(elements.ok());
  REQUIRE(elements->size() == 1);
  CHECK((*elements)[0].mesh.positions.size() == 4);
  CHECK((*elements)[0].mesh.positions[2] == vec3(0, 0, -0.001f));
}

TEST_CASE("faults of an STL are named with file and place") {
  StlFile file;
  std::string cut = binary(kTwo, 3);
  cut[0] = 'x';
  CHECK(contains(file.fault(cut), "cut short: it promises 3 triangles and holds 2"));
  auto bad = kTwo;
  bad[1][2].y = std::numeric_limits<float>::quiet_NaN();
  CHECK(contains(file.fault(binary(bad, 2)), "triangle 1: a coordinate is not finite"));
  bad[1][2].y = 1e9f;
  CHECK(contains(file.fault(binary(bad, 2)), "vasa convert --unit"));
  CHECK(contains(file.fault("not an STL"), "neither ASCII nor binary STL"));
  CHECK(contains(file.fault(binary({}, 0)), "no triangles with an area"));
  CHECK(contains(file.fault("solid a\nendsolid a\n"), "no triangles with an area"));
  CHECK(contains(file.fault("solid a\nfacet normal 0 0 1\nendfacet\n"), "a facet without 'outer loop'"));
  CHECK(contains(file.fault("solid a\n" + facet("0 0 0", "1 0 0", "0 1 x")),
                 ":6: a corner needs three finite numbers"));
  CHECK(contains(file.fault("solid a\n" + facet("0 0 0", "1 0 0", "0 1,5 0")),
                 "found '1,5'; write decimal points, not commas"));
  CHECK(contains(file.fault("solid a\n" + facet("0 0 0", "1 0 0", "0 nan 0")),
                 ":6: a coordinate is not finite"));
  CHECK(contains(file.fault("solid a\n" + facet("0 0 0", "1 0 0", "0 1 0\n vertex 1 1 1")),
                 "more than three corners"));
  CHECK(contains(file.fault("solid a\nfacet\nouter loop\nvertex 0 0 0\nendloop\n"),
                 "needs three corners, found 'endloop'"));
  CHECK(contains(file.fault("solid a\n" + facet("0 0 0", "1 0 0", "0 1 0")), "ends before 'endsolid'"));
  CHECK(contains(file.fault("solid a\nrubbish\n"), "expected 'facet' or 'endsolid', found 'rubbish'"));
}

TEST_CASE("the VMTK aorta is read and closed") {
  VASA_REQUIRE_SHARED_DATA(data);
  const auto elements = readStl(data / "centerlines/vmtk/aorta-surface.stl", {0.001f, ImportFrame::Up::z});
  REQUIRE(elements.ok());
  const TriangleMesh& mesh = (*elements)[0].mesh;
  CHECK(mesh.triangles.size() > 10000);
  CHECK(mesh.positions.size() * 2 == mesh.triangles.size() + 4);  // a closed surface of genus 0
}
