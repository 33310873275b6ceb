#include <algorithm>
#include <string>

#include "io/vtk_sections.h"
#include "io/vtk_xml.h"

// Unstructured grids as far as they are lines or faces: what polygonal data has in lists of its own, they
// have in one, with a number of VTK's for each cell's kind.
namespace vasa::vtk {
namespace {

using tinyxml2::XMLElement;

constexpr const char* kPlace = "/VTKFile/UnstructuredGrid";
// In the order in which polygonal data counts its cells.
constexpr const char* kKinds[] = {"VERTICES", "LINES", "POLYGONS", "TRIANGLE_STRIPS"};

struct CellKind {
  int list;  // of kKinds
  /// Its corners, of curved ones those that straight ones have, in the order of a polygon; empty: all.
  std::vector<std::size_t> corners;
};

CellKind kindOf(double type, std::size_t cell) {
  switch (type > 0 && type < 256 ? int(type) : 0) {
    case 1:  // a vertex, several
    case 2:
      return {0, {}};
    case 3:  // a line of two points, of several
    case 4:
      return {1, {}};
    case 21:  // a bent edge: its ends, its middle
      return {1, {0, 2, 1}};
    case 5:  // a triangle, polygon, quad
    case 7:
    case 9:
      return {2, {}};
    case 8:  // a pixel, row by row
      return {2, {0, 1, 3, 2}};
    case 22:  // a bent triangle, a bent quad
      return {2, {0, 1, 2}};
    case 23:
      return {2, {0, 1, 2, 3}};
    case 6:
      return {3, {}};
    default:
      breaks("cell " + std::to_string(cell),
             "is a solid, or of another kind that is neither line nor face (type " +
                 std::to_string(std::int64_t(type)) +
                 "); extract its surface or lines (ParaView: Extract Surface) and save them as .vtp");
  }
}

// Numbers of the arrays of one component, behind those of the pieces before.
// @param numbers  of all of them so far
void addData(XmlFile& file, const XMLElement& piece, const char* kind, const Amounts& most,
             std::size_t& numbers, std::vector<Array>& data) {
  const XMLElement* parent = piece.FirstChildElement(kind);
  for (const XMLElement* e = parent ? parent->FirstChildElement("DataArray") : nullptr; e;
       e = e->NextSiblingElement("DataArray")) {
    const std::string name(attribute(*e, "Name"));
    if (const auto components = attribute(*e, "NumberOfComponents");
        name.empty() || (!components.empty() && components != "1"))
      continue;
    const Numbers told = file.numbers(*e, std::string(kPlace) + "/" + kind + "/" + name);
    Amounts::check(std::string(kPlace) + "/" + kind, "numbers", numbers += told.size(), most.cellNumbers);
    auto array = std::ranges::find(data, name, &Array::name);
    if (array == data.end()) array = data.insert(array, {name, {}});
    for (std::size_t i = 0; i < told.size(); ++i) array->values.push_back(told[i]);
  }
}

Numbers arrayOf(XmlFile& file, const XMLElement& piece, const char* parent, const char* name) {
  const std::string place = std::string(kPlace) + "/" + parent + "/" + name;
  const XMLElement* array = arrayNamed(piece.FirstChildElement(parent), name);
  if (!array) breaks(place, "is missing");
  return file.numbers(*array, place);
}

// The cells of a piece, whose points are `count` from `firstPoint` on.
void addCells(XmlFile& file, const XMLElement& piece, std::size_t firstPoint, std::size_t count,
              const Amounts& most, Cells& cells, std::vector<double>& types) {
  const Numbers corners = arrayOf(file, piece, "Cells", "connectivity"),
                ends = arrayOf(file, piece, "Cells", "offsets"),
                told = arrayOf(file, piece, "Cells", "types");
  const std::size_t firstCorner = cells.points.size();
  Amounts::check(std::string(kPlace) + "/Cells/types", "cells",
                 cells.size() + std::max(told.size(), ends.size()), most.lines);
  Amounts::check(std::string(kPlace) + "/Cells/connectivity", "cells' points", firstCorner + corners.size(),
                 most.corners);
  for (std::size_t i = 0; i < told.size(); ++i) types.push_back(told[i]);
  for (std::size_t k = 0; k < corners.size(); ++k) {
    if (!(corners[k] >= 0 && corners[k] < double(count)))
      breaks(std::string(kPlace) + "/Cells/connectivity",
             "value " + std::to_string(k) + " lies outside the " + std::to_string(count) + " points");
    cells.points.push_back(std::uint32_t(firstPoint + std::size_t(corners[k])));
  }
  for (std::size_t i = 0; i < ends.size(); ++i) {
    if (!(ends[i] >= (i > 0 ? ends[i - 1] : 0) && ends[i] <= double(corners.size())))
      breaks(std::string(kPlace) + "/Cells/offsets",
             "value " + std::to_string(i) + " must not fall and not exceed the connectivity");
    cells.ends.push_back(std::uint32_t(firstCorner + std::size_t(ends[i])));
  }
}

}  // namespace

void divideCells(Sections& file, const Cells& cells, std::span<const double> types) {
  if (types.size() != cells.size())
    breaks("cells",
           "there are " + std::to_string(cells.size()) + ", and types of " + std::to_string(types.size()));
  std::vector<std::size_t> order[std::size(kKinds)];
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const CellKind kind = kindOf(types[i], i);
    const auto points = cells[i];
    Cells& list = file.cells[kKinds[kind.list]];
    if (kind.corners.empty()) list.points.insert(list.points.end(), points.begin(), points.end());
    for (const std::size_t corner : kind.corners) {
      if (points.size() < kind.corners.size()) breaks("cell " + std::to_string(i), "has too few points");
      list.points.push_back(points[corner]);
    }
    list.ends.push_back(std::uint32_t(list.points.size()));
    order[kind.list].push_back(i);
  }
  for (Array& array : file.cellData) {
    if (array.values.size() != cells.size()) continue;
    std::vector<double> sorted;
    for (const auto& list : order)
      for (const std::size_t i : list) sorted.push_back(array.values[i]);
    array.values = std::move(sorted);
  }
}

Sections gridSections(std::span<const std::byte> bytes) {
  XmlFile file(bytes);
  const XMLElement& grid = file.data("UnstructuredGrid");
  const XMLElement* piece = grid.FirstChildElement("Piece");
  if (!piece) breaks(kPlace, "is empty; write the file again");
  const Amounts most(bytes.size());
  Sections out;
  Cells cells;
  std::vector<double> types;
  for (std::size_t numbers = 0; piece; piece = piece->NextSiblingElement("Piece")) {
    const XMLElement* points = piece->FirstChildElement("Points");
    const XMLElement* array = points ? points->FirstChildElement("DataArray") : nullptr;
    if (!array) breaks(std::string(kPlace) + "/Points", "is missing");
    const Numbers xyz = file.numbers(*array, std::string(kPlace) + "/Points");
    const std::size_t firstPoint = out.points.size(), count = xyz.size() / 3;
    Amounts::check(std::string(kPlace) + "/Points", "points", firstPoint + count, most.points);
    for (std::size_t i = 0; i + 2 < xyz.size(); i += 3)
      out.points.emplace_back(xyz[i], xyz[i + 1], xyz[i + 2]);
    addData(file, *piece, "PointData", most, numbers, out.pointData);
    addData(file, *piece, "CellData", most, numbers, out.cellData);
    addCells(file, *piece, firstPoint, count, most, cells, types);
  }
  // What not every piece tells has too few numbers by now.
  std::erase_if(out.pointData, [&](const Array& array) { return array.values.size() != out.points.size(); });
  std::erase_if(out.cellData, [&](const Array& array) { return array.values.size() != cells.size(); });
  divideCells(out, cells, types);
  return out;
}

}  // namespace vasa::vtk
