#include "io/vtk.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <sstream>

#include "io/gltf_builder.h"
#include "io/reading.h"
#include "support/shared_data.h"

using namespace vasa;
using namespace vasa::test;

namespace {

template <class T>
std::string bigEndian(const std::vector<T>& values) {
  std::string out;
  for (const T& value : values) {
    const auto* bytes = reinterpret_cast<const char*>(&value);
    for (std::size_t i = sizeof(T); i-- > 0;) out += bytes[i];
  }
  return out + "\n";
}

std::string head(const char* kind) {
  return std::string("# vtk DataFile Version 4.2\na title\n") + kind + "\nDATASET POLYDATA\n";
}

// A square and a strip of two triangles beside it.
const std::string kVtkPoints = "POINTS 6 float\n0 0 0 1 0 0 1 1 0\n0 1 0 2 0 0 2 1 0\n";

void expectSurface(const std::string& text) {
  const auto read = parseVtkSurface(bytesOf(text), "a.vtk", kMillimetres);
  if (!read.ok()) FAIL(read.error().message);
  const TriangleMesh& mesh = read->front().mesh;
  CHECK(read->front().name == "a");
  REQUIRE(mesh.positions.size() == 6);
  CHECK(mesh.positions[5] == vec3(0.002f, 0.001f, 0));
  REQUIRE(mesh.triangles.size() == 4);
  for (const uvec3& t : mesh.triangles) {
    const vec3 normal =
        glm::cross(mesh.positions[t.y] - mesh.positions[t.x], mesh.positions[t.z] - mesh.positions[t.x]);
    CHECK(normal.z > 0);
  }
}
void expectVtkFault(const std::string& text, const char* message) {
  expectFault(parseVtkSurface(bytesOf(text), "a.vtk"), message);
}

}  // namespace

TEST_CASE("legacy VTK: radii of points under any name, and of lines") {
  const std::string lines = "LINES 2 6\n2 0 1\n2 2 1\n";
  const auto read = [&](const std::string& data) {
    auto parsed = parseVtkLines(bytesOf(head("ASCII") + kVtkPoints + lines + data), "a.vtk");
    if (!parsed.ok()) FAIL(parsed.error().message);
    return parsed->points[1].w;
  };
  CHECK(read("POINT_DATA 6\nSCALARS RADIUS float 1\nLOOKUP_TABLE default\n1 2 3 1 1 1\n") == 2);
  // Data of the whole file, as some write them: their length tells whose they are.
  CHECK(read("FIELD FieldData 1\nradius 1 6 float\n1 2 3 1 1 1\nMETADATA\nINFORMATION 0\n\n") == 2);
  CHECK(read("FIELD FieldData 1\nradius 1 2 float\n2 4\n") == 3);
  CHECK(read("CELL_DATA 2\nFIELD FieldData 2\nlabel 1 2 string\nthe%20first\n\nradius 1 2 float\n2 4\n") ==
        3);
  CHECK(read("POINT_DATA 6\nFIELD f 2\nflow 1 6 float\n7 7 7 7 7 7\nDiameter 1 6 float\n2 4 6 1 1 1\n") == 2);
  CHECK(read("CELL_DATA 2\nSCALARS EdgeRadius float 1\nLOOKUP_TABLE default\n1 3\n") == 2);
  CHECK(read("POINT_DATA 6\nFIELD f 1\nMax%20Diameter%20(m) 1 6 float\n2 4 6 1 1 1\n") == 2);
  // How sure radii are is none; of two that are as likely the first counts.
  CHECK(
      read(
          "POINT_DATA 6\nFIELD f 2\nStdDevRadius 1 6 float\n7 7 7 7 7 7\nMeanRadius 1 6 float\n1 2 3 1 1 1\n") ==
      2);
  CHECK(
      read(
          "POINT_DATA 6\nFIELD f 2\nOuterRadius 1 6 float\n1 2 3 1 1 1\nInnerRadius 1 6 float\n7 7 7 7 7 7\n") ==
      2);
  CHECK(read("POINT_DATA 6\nSCALARS r float 1\nLOOKUP_TABLE default\n5 0 0 1 1 1\n") == 5);  // across lines
  const auto none =
      parseVtkLines(bytesOf(head("ASCII") + kVtkPoints + lines +
                            "POINT_DATA 6\nSCALARS flow float 1\nLOOKUP_TABLE default\n1 2 3 1 1 1\n"),
                    "a.vtk");
  REQUIRE(!none.ok());
  CHECK_MESSAGE(none.error().message.find("it has flow") != std::string::npos, none.error().message);
}

TEST_CASE("legacy VTK: radii of least or of curves, and what is wrong with one") {
  const std::string lines = "LINES 1 3\n2 0 1\nPOINT_DATA 6\nFIELD f ";
  const auto read = parseVtkLines(
      bytesOf(head("ASCII") + kVtkPoints + lines +
              "2\nCurvatureRadius 1 6 float\n9 9 9 9 9 9\nDiameter_cm 1 6 float\n2 4 6 1 1 1\n"),
      "a.vtk");
  if (!read.ok()) FAIL(read.error().message);
  CHECK(read->points[1].w == 0.02f);
  const auto bad = parseVtkLines(
      bytesOf(head("ASCII") + kVtkPoints + lines + "1\nRadius 1 6 float\n9 -1 9 9 9 9\n"), "a.vtk");
  REQUIRE(!bad.ok());
  CHECK_MESSAGE(
      bad.error().message.find("radius -1 of point 1 must be positive; mend it") != std::string::npos,
      bad.error().message);
  CHECK(bad.error().message.find("--unit") == std::string::npos);
}

TEST_CASE("legacy VTK with carriage returns, and UTF-16") {
  std::string text = head("ASCII") + kVtkPoints + "POLYGONS 1 5\n4 0 1 2 3\nTRIANGLE_STRIPS 1 5\n4 1 4 2 5\n";
  std::ranges::replace(text, '\n', '\r');
  expectSurface(text);
  const TemporaryFolder folder;
  CHECK(vtkContent(writeBytes(folder.path() / "a.vtk", text)) == VtkContent::surface);
  std::string wide = "\xFF\xFE";
  for (const char c : text) wide.append({c, '\0'});
  expectVtkFault(wide, "the text is UTF-16; save it as UTF-8");
}

TEST_CASE("surfaces of legacy VTK: ASCII and binary, cells as before version 5 and since") {
  expectSurface(
      head("ASCII") + kVtkPoints +
      "POLYGONS 1 5\n4 0 1 2 3\nTRIANGLE_STRIPS 1 5\n4 1 4 2 5\nCELL_DATA 2\nSCALARS id int\nLOOKUP_TABLE default\n1 2\n");
  expectSurface(head("ASCII") + "METADATA\nINFORMATION 0\n\n" + kVtkPoints +
                "POLYGONS 2 4\nOFFSETS vtktypeint64\n0 4\nCONNECTIVITY vtktypeint64\n0 1 2 3\n" +
                "TRIANGLE_STRIPS 2 4\nOFFSETS vtktypeint64\n0 4\nCONNECTIVITY vtktypeint64\n1 4 2 5\n");
  const std::string points =
      "POINTS 6 float\n" + bigEndian<float>({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 2, 0, 0, 2, 1, 0});
  expectSurface(head("BINARY") + points + "POLYGONS 1 5\n" + bigEndian<std::int32_t>({4, 0, 1, 2, 3}) +
                "TRIANGLE_STRIPS 1 5\n" + bigEndian<std::int32_t>({4, 1, 4, 2, 5}) +
                "POINT_DATA 6\nNORMALS n float\n" + bigEndian<float>(std::vector<float>(18, 1.0f)));
}

TEST_CASE("surfaces of XML VTK, and which of both a file is about") {
  const std::string xml =
      "<VTKFile type=\"PolyData\"><PolyData><Piece NumberOfPoints=\"6\" NumberOfLines=\"0\" NumberOfPolys=\"1\" NumberOfStrips=\"1\"><Points><DataArray type=\"Float32\" "
      "NumberOfComponents=\"3\" format=\"ascii\">0 0 0 1 0 0 1 1 0 0 1 0 2 0 0 2 1 0</DataArray></Points><Polys><DataArray type=\"Int32\" Name=\"connectivity\" "
      "format=\"ascii\">0 1 2 3</DataArray><DataArray type=\"Int32\" Name=\"offsets\" format=\"ascii\">4</DataArray></Polys><Strips><DataArray type=\"Int32\" "
      "Name=\"connectivity\" format=\"ascii\">1 4 2 5</DataArray><DataArray type=\"Int32\" Name=\"offsets\" format=\"ascii\">4</DataArray></Strips></Piece></PolyData></VTKFile>";
  expectSurface(xml);
  const TemporaryFolder folder;
  CHECK(vtkContent(writeBytes(folder.path() / "a.vtp", xml)) == VtkContent::surface);
  std::string lines = xml;
  lines.replace(lines.find("NumberOfLines=\"0\""), 17, "NumberOfLines=\"2\"");
  for (const char* faces : {"NumberOfPolys=\"", "NumberOfStrips=\""})
    lines[lines.find(faces) + std::string(faces).size()] = '0';
  CHECK(vtkContent(writeBytes(folder.path() / "b.vtp", lines)) == VtkContent::lines);
  CHECK(vtkContent(
            writeBytes(folder.path() / "a.vtk", head("ASCII") + kVtkPoints + "POLYGONS 1 5\n4 0 1 2 3\n")) ==
        VtkContent::surface);
  CHECK(vtkContent(writeBytes(folder.path() / "b.vtk", head("ASCII") + kVtkPoints + "LINES 1 3\n2 0 1\n")) ==
        VtkContent::lines);
  CHECK(vtkContent(writeBytes(folder.path() / "e.vtk", head("ASCII") + kVtkPoints + "Lines 1 3\n2 0 1\n")) ==
        VtkContent::lines);
  CHECK(vtkContent(folder.path() / "none.vtk") == VtkContent::nothing);
  // Edges drawn on a surface, and centre lines within one.
  const std::string both =
      head("ASCII") + kVtkPoints + "LINES 1 3\n2 0 1\nPOLYGONS 1 4\n3 0 1 2\nPOINT_DATA 6\nFIELD f 1\n";
  const std::string six = " 1 6 float\n1 1 1 1 1 1\n";
  CHECK(vtkContent(writeBytes(folder.path() / "c.vtk", both + "flow" + six)) == VtkContent::surface);
  CHECK(vtkContent(writeBytes(folder.path() / "d.vtk", both + "Radius" + six)) == VtkContent::lines);
  const auto xmlOf = [&](const std::string& array) {
    return "<VTKFile type=\"PolyData\"><PolyData><Piece NumberOfPoints=\"3\" NumberOfLines=\"1\" NumberOfPolys=\"1\">"
           "<PointData><DataArray type=\"Float32\" Name=\"" +
           array + "\" format=\"ascii\">1 1 1</DataArray></PointData></Piece></PolyData></VTKFile>";
  };
  CHECK(vtkContent(writeBytes(folder.path() / "c.vtp", xmlOf("flow"))) == VtkContent::surface);
  CHECK(vtkContent(writeBytes(folder.path() / "d.vtp", xmlOf("TubeRadius"))) == VtkContent::lines);
}

TEST_CASE("centre lines of legacy VTK, with radii as fields or scalars") {
  const std::string cells = "POINTS 3 double\n0 0 0 0 1 0 0 2 0\nLINES 1 4\n3 0 1 2\n";
  for (const std::string data :
       {"POINT_DATA 3\nFIELD FieldData 1\nMaximumInscribedSphereRadius 1 3 double\n1 2 3\n",
        "POINT_DATA 3\nSCALARS Radius float 1\nLOOKUP_TABLE default\n1 2 3\n"}) {
    const auto read = parseVtkLines(bytesOf(head("ASCII") + cells + data), "a.vtk");
    if (!read.ok()) FAIL(read.error().message);
    REQUIRE(read->lines.size() == 1);
    CHECK(read->points[2] == vec4(0, 2, 0, 3));
  }
  const auto bare = parseVtkLines(bytesOf(head("ASCII") + cells), "a.vtk");
  REQUIRE(!bare.ok());
  CHECK(bare.error().message.find("MaximumInscribedSphereRadius") != std::string::npos);
}

TEST_CASE("what is wrong with a legacy file is told with its place") {
  expectVtkFault("# vtk DataFile Version 3.0\nx\nASCII\nDATASET STRUCTURED_GRID\n",
                 "line 4: holds STRUCTURED_GRID, not POLYDATA; extract its surface");
  expectVtkFault(head("BINARY") + "POINTS 6 float\nabc", "POINTS: is cut short");
  expectVtkFault(head("ASCII") + kVtkPoints + "POLYGONS 1 5\n4 0 1 2 9\n",
                 "POLYGONS: cell 0 has a point outside the 6");
  expectVtkFault(head("ASCII") + kVtkPoints + "POLYGONS 99999999 5\n",
                 "POLYGONS: promises more than the file holds");
  expectVtkFault(head("ASCII") + kVtkPoints + "POLYGONS 2 5\n4 0 1 2 3\n", "POLYGONS: is cut short");
  expectVtkFault(head("ASCII") + kVtkPoints, "neither lines nor polygons");
  expectVtkFault(head("ASCII") + kVtkPoints + "CURVES 3\n", "CURVES: is no section");
}

namespace {

// Of one kind of cells after the other, as grids have them, in XML or legacy.
std::string grid(bool xml, const std::string& corners, const std::string& types, const std::string& radii) {
  std::istringstream words(corners);
  std::string connectivity, offsets, legacy;
  std::size_t all = 0, cells = 0, numbers = 0;
  for (std::string cell; std::getline(words, cell, ',');) {
    std::istringstream in(cell);
    std::size_t size = 0;
    for (std::string corner; in >> corner; ++size) connectivity += corner + " ";
    offsets += std::to_string(all += size) + " ";
    legacy += std::to_string(size) + " " + cell + "\n";
    ++cells, numbers += size + 1;
  }
  const std::string places = "0 0 0 1 0 0 1 1 0 0 1 0 2 0 0 2 1 0";
  if (!xml)
    return "# vtk DataFile Version 4.2\na title\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 6 float\n" +
           places + "\nCELLS " + std::to_string(cells) + " " + std::to_string(numbers) + "\n" + legacy +
           "CELL_TYPES " + std::to_string(cells) + "\n" + types + "\nCELL_DATA " + std::to_string(cells) +
           "\nSCALARS Radius float 1\nLOOKUP_TABLE default\n" + radii + "\n";
  const auto array = [](const std::string& type, const std::string& name, const std::string& values) {
    return "<DataArray type=\"" + type + "\" Name=\"" + name + "\" format=\"ascii\">" + values +
           "</DataArray>";
  };
  return "<VTKFile type=\"UnstructuredGrid\"><UnstructuredGrid><Piece NumberOfPoints=\"6\" NumberOfCells=\"" +
         std::to_string(cells) + "\"><CellData>" + array("Float32", "Radius", radii) + "</CellData><Points>" +
         "<DataArray type=\"Float32\" NumberOfComponents=\"3\" format=\"ascii\">" + places +
         "</DataArray></Points><Cells>" + array("Int32", "connectivity", connectivity) +
         array("Int32", "offsets", offsets) + array("UInt8", "types", types) +
         "</Cells></Piece></UnstructuredGrid></VTKFile>";
}

}  // namespace

TEST_CASE("grids of lines are centre lines, with what the file tells of each cell, whatever its kind") {
  const TemporaryFolder folder;
  for (const bool xml : {false, true}) {
    // A triangle before the lines and a vertex behind them: polygonal data counts them the other way round.
    const std::string text = grid(xml, "0 1 2,0 3,1 4 5,2", "5 3 4 1", "9 1 2 8");
    const auto read = parseVtkLines(bytesOf(text), "a.vtu");
    if (!read.ok()) FAIL(read.error().message);
    REQUIRE(read->lines.size() == 2);
    CHECK(read->lines[0] == std::vector<std::uint32_t>{0, 3});
    CHECK(read->lines[1] == std::vector<std::uint32_t>{1, 4, 5});
    CHECK(read->points[3] == vec4(0, 1, 0, 1));
    CHECK(read->points[5] == vec4(2, 1, 0, 2));
    CHECK(vtkContent(writeBytes(folder.path() / "a.vtu", text)) == VtkContent::lines);
  }
}

TEST_CASE("grids in several pieces are one") {
  std::string text = grid(true, "0 3,1 4 5", "3 4", "1 2");
  const std::size_t from = text.find("<Piece"), size = text.find("</UnstructuredGrid>") - from;
  std::string more = text.substr(from, size), without = more;
  without.replace(without.find("\"Radius\""), 8, "\"Region\"");
  const auto read = parseVtkLines(bytesOf(text.insert(from, more)), "a.vtu");
  if (!read.ok()) FAIL(read.error().message);
  REQUIRE(read->points.size() == 12);
  REQUIRE(read->lines.size() == 4);
  CHECK(read->lines[3] == std::vector<std::uint32_t>{7, 10, 11});
  CHECK(read->points[10] == read->points[4]);
  // What one piece does not tell, the file does not.
  const auto untold =
      parseVtkLines(bytesOf(grid(true, "0 3,1 4 5", "3 4", "1 2").insert(from, without)), "a.vtu");
  REQUIRE_FALSE(untold.ok());
  CHECK_MESSAGE(untold.error().message.find("no array of radii") != std::string::npos,
                untold.error().message);
}

TEST_CASE("grids of faces are surfaces; pixels go round, solids are refused with what to do") {
  const TemporaryFolder folder;
  for (const bool xml : {false, true}) {
    for (const char* cells : {"0 1 2 3,1 4 2 5", "0 1 3 2,1 4 2 5"}) {
      const std::string text = grid(xml, cells, cells[4] == '2' ? "9 6" : "8 6", "1 1");
      expectSurface(text);
      CHECK(vtkContent(writeBytes(folder.path() / "a.vtu", text)) == VtkContent::surface);
    }
    expectVtkFault(
        grid(xml, "0 1 2,0 1 2 5", "5 10", "1 1"),
        "cell 1: is a solid, or of another kind that is neither line nor face (type 10); extract its "
        "surface or lines (ParaView: Extract Surface)");
    if (xml) expectVtkFault(grid(xml, "0 1 2", "5 5", "1"), "there are 1, and types of 2");
    expectVtkFault(grid(xml, "0 1 9", "5", "1"), "outside the 6");
  }
}
