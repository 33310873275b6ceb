#include "io/vtp.h"

#include <tinyxml2.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

#include "core/atomic_file.h"
#include "core/log.h"
#include "io/radius_array.h"
#include "io/vtk_xml.h"
#include "io/words.h"
#include "mesh/polygon.h"

namespace vasa {
namespace {

using tinyxml2::XMLElement;
using vtk::Amounts;
using vtk::arrayNamed;
using vtk::attribute;
using vtk::breaks;
using vtk::BrokenRule;
using vtk::Numbers;

constexpr std::size_t kMostCellArrays = 100;

class VtpReader {
 public:
  VtpReader(std::span<const std::byte> bytes, const ImportFrame& frame)
      : frame_(frame), most_(bytes.size()), file_(bytes) {}

  VtpLines run() {
    const XMLElement& data = file_.polyData();
    if (const XMLElement* fields = data.FirstChildElement("FieldData")) readNames(*fields);
    int number = 0;
    for (const XMLElement* piece = data.FirstChildElement("Piece"); piece;
         piece = piece->NextSiblingElement("Piece"))
      readPiece(*piece, "/VTKFile/PolyData/Piece[" + std::to_string(number++) + "]");
    if (out_.lines.empty())
      breaks("/VTKFile/PolyData", "has no lines of two points or more; give centre lines");
    const auto mended = mendRadii(out_.lines, out_.points);
    if (!mended) breaks("/VTKFile/PolyData", "has no radius above zero");
    if (*mended > 0)
      remark += (remark.empty() ? "" : "; ") + std::to_string(*mended) +
                " points without a radius take a neighbour's";
    return std::move(out_);
  }
  TriangleMesh surface() {
    TriangleMesh mesh;
    int number = 0;
    const XMLElement& data = file_.polyData();
    for (const XMLElement* piece = data.FirstChildElement("Piece"); piece;
         piece = piece->NextSiblingElement("Piece"))
      readFaces(*piece, "/VTKFile/PolyData/Piece[" + std::to_string(number++) + "]", mesh);
    return mesh;
  }
  bool tellsRadii() {
    const XMLElement& data = file_.polyData();
    for (const XMLElement* piece = data.FirstChildElement("Piece"); piece;
         piece = piece->NextSiblingElement("Piece"))
      if (vtk::countOf(*piece, "NumberOfLines", "/VTKFile/PolyData/Piece") > 0)
        for (const char* kind : {"PointData", "CellData"})
          if (chooseRadius(scalarsOf(piece->FirstChildElement(kind)).names)) return true;
    return false;
  }
  std::string space() {
    const XMLElement* fields = file_.polyData().FirstChildElement("FieldData");
    const XMLElement* array = vtk::arrayNamed(fields, "SPACE", vtk::kNoNumbers);
    std::string text;
    if (!array) return text;
    const Numbers letters = file_.letters(*array, "/VTKFile/PolyData/FieldData/SPACE");
    for (std::size_t i = 0; i < letters.size() && letters[i] > 0 && letters[i] < 128; ++i)
      text += char(letters[i]);
    return text;
  }
  std::string remark;  ///< on what was read

 private:
  void readFaces(const XMLElement& piece, const std::string& place, TriangleMesh& mesh) {
    const auto points = std::size_t(vtk::countOf(piece, "NumberOfPoints", place));
    const auto base = std::uint32_t(mesh.positions.size());
    Amounts::check(place + "/NumberOfPoints", "points", base + points, most_.points);
    const Numbers xyz = coordinates(piece, points, place);
    for (std::size_t i = 0; i < points; ++i) mesh.positions.push_back(placeOf(xyz, i, place));
    for (const auto& [name, amount] :
         {std::pair("Polys", "NumberOfPolys"), std::pair("Strips", "NumberOfStrips")}) {
      const auto cells = std::size_t(vtk::countOf(piece, amount, place));
      if (cells == 0) continue;
      Amounts::check(place + "/" + amount, "faces", mesh.triangles.size() + cells, most_.corners);
      const bool polygons = name == std::string_view("Polys");
      readCellLists(piece, name, points, cells, base, place, [&](std::vector<std::uint32_t> corners) {
        if (corners.size() > kMostCorners && polygons)
          breaks(place + "/Polys",
                 "a face has more than " + std::to_string(kMostCorners) + " corners; cut it into triangles");
        polygons ? addPolygon(corners, mesh) : addStrip(corners, mesh);
      });
    }
  }

  Numbers coordinates(const XMLElement& piece, std::size_t count, const std::string& place) {
    const XMLElement* points = piece.FirstChildElement("Points");
    const XMLElement* array = points ? points->FirstChildElement("DataArray") : nullptr;
    if (!array) breaks(place + "/Points", "is missing");
    Numbers xyz = file_.numbers(*array, place + "/Points");
    if (xyz.size() != 3 * count)
      breaks(place + "/Points", "holds " + std::to_string(xyz.size()) + " numbers, not three for each of " +
                                    std::to_string(count) + " points");
    return xyz;
  }
  vec3 placeOf(const Numbers& xyz, std::size_t i, const std::string& place) const {
    const dvec3 p(xyz[3 * i], xyz[3 * i + 1], xyz[3 * i + 2]);
    if (!(glm::length(p) * frame_.metresPerUnit <= kLargestImportedCoordinate))
      breaks(
          place + "/Points",
          "point " + std::to_string(i) +
              " is not finite or farther than 1000 km away; give the file's unit with vasa convert --unit");
    return frame_.toHouse(p);
  }

  void readNames(const XMLElement& fields) {
    const std::string place = "/VTKFile/PolyData/FieldData/VesselNames";
    const XMLElement* array = vtk::arrayNamed(&fields, "VesselNames", vtk::kNoNumbers);
    if (!array || attribute(*array, "type") != "String") return;
    const Numbers letters = file_.letters(*array, place);
    std::string text;
    for (std::size_t i = 0; i < letters.size(); ++i) {
      const double letter = letters[i];
      if (letter == 0)
        Amounts::check(place, "names", out_.names.size() + 1, most_.names),
            out_.names.push_back(std::exchange(text, {}));
      else if (letter >= 1 && letter < 256)
        text += char(static_cast<unsigned char>(letter));
    }
  }

  void readPiece(const XMLElement& piece, const std::string& place) {
    const std::int64_t points = vtk::countOf(piece, "NumberOfPoints", place),
                       lines = vtk::countOf(piece, "NumberOfLines", place);
    if (lines == 0) return;
    const auto base = std::uint32_t(out_.points.size());
    Amounts::check(place + "/NumberOfPoints", "points", base + std::size_t(points), most_.points);
    Amounts::check(place + "/NumberOfLines", "lines", out_.lines.size() + std::size_t(lines), most_.lines);
    readPoints(piece, std::size_t(points), place);
    const std::size_t firstLine = out_.lines.size();
    const auto verts = std::size_t(vtk::countOf(piece, "NumberOfVerts", place));
    const std::vector<bool> kept = readLines(piece, std::size_t(points), std::size_t(lines), base, place);
    readRadii(piece, base, firstLine, kept, verts, place);
    readCells(piece, kept, verts, place);
  }

  void readPoints(const XMLElement& piece, std::size_t count, const std::string& place) {
    const Numbers xyz = coordinates(piece, count, place);
    for (std::size_t i = 0; i < count; ++i) out_.points.push_back(vec4(placeOf(xyz, i, place), 0));
  }

  struct Named {
    std::vector<std::string> names;
    std::vector<const XMLElement*> arrays;
  };
  static Named scalarsOf(const XMLElement* parent) {
    Named found;
    for (const XMLElement* e = parent ? parent->FirstChildElement("DataArray") : nullptr; e;
         e = e->NextSiblingElement("DataArray"))
      if (const auto components = attribute(*e, "NumberOfComponents");
          components.empty() || components == "1")
        found.names.emplace_back(attribute(*e, "Name")), found.arrays.push_back(e);
    return found;
  }

  // Of points, else of lines: those that the piece added from `firstLine` on, of which not all were kept.
  void readRadii(const XMLElement& piece, std::uint32_t firstPoint, std::size_t firstLine,
                 const std::vector<bool>& kept, std::size_t verts, const std::string& place) {
    const Named ofPoints = scalarsOf(piece.FirstChildElement("PointData")),
                ofLines = scalarsOf(piece.FirstChildElement("CellData"));
    const auto byPoint = chooseRadius(ofPoints.names), byLine = chooseRadius(ofLines.names);
    if (!byPoint && !byLine) breaks(place + "/PointData", missingRadius(ofPoints.names, ofLines.names));
    const RadiusChoice choice = byPoint ? *byPoint : *byLine;
    const std::string& name = (byPoint ? ofPoints : ofLines).names[choice.array];
    const std::string own = place + (byPoint ? "/PointData/" : "/CellData/") + name;
    const Numbers told = file_.numbers(*(byPoint ? ofPoints : ofLines).arrays[choice.array], own);
    const std::size_t points = out_.points.size() - firstPoint;
    if (byPoint ? told.size() != points : told.size() < verts + kept.size())
      breaks(own, "holds " + std::to_string(told.size()) + " numbers for " +
                      (byPoint ? std::to_string(points) + " points"
                               : std::to_string(verts + kept.size()) + " cells"));
    std::vector<double> radii;
    if (byPoint)
      for (std::size_t i = 0; i < points; ++i) radii.push_back(told[i]);
    else {
      std::vector<double> ofLine;
      for (std::size_t i = 0; i < kept.size(); ++i)
        if (kept[i]) ofLine.push_back(told[verts + i]);
      radii = radiiOfPoints(out_.points.size(), std::span(out_.lines).subspan(firstLine), ofLine);
      radii.erase(radii.begin(), radii.begin() + firstPoint);
    }
    const double metresPerUnit = choice.factor * (choice.unit > 0 ? choice.unit : frame_.metresPerUnit);
    for (std::size_t i = 0; i < points; ++i) {
      if (const std::string fault = radiusFault(radii[i], metresPerUnit, i); !fault.empty())
        breaks(own, fault);
      out_.points[firstPoint + i].w = float(radii[i] * metresPerUnit);
    }
    remark = radiusRemark(name, choice, !byPoint);
  }

  std::vector<bool> readLines(const XMLElement& piece, std::size_t points, std::size_t lines,
                              std::uint32_t base, const std::string& piecePlace) {
    std::vector<bool> kept;
    readCellLists(piece, "Lines", points, lines, base, piecePlace, [&](std::vector<std::uint32_t> line) {
      kept.push_back(line.size() > 1);
      if (kept.back()) out_.lines.push_back(std::move(line));
    });
    return kept;
  }

  template <class Take>
  void readCellLists(const XMLElement& piece, const char* kind, std::size_t points, std::size_t cells,
                     std::uint32_t base, const std::string& piecePlace, Take take) {
    const std::string place = piecePlace + "/" + kind;
    const XMLElement* element = piece.FirstChildElement(kind);
    const XMLElement *connectivity = arrayNamed(element, "connectivity"),
                     *offsets = arrayNamed(element, "offsets");
    if (!connectivity || !offsets) breaks(place, "needs the arrays connectivity and offsets");
    const Numbers numbersOfPoints = file_.numbers(*connectivity, place + "/connectivity");
    const Numbers ends = file_.numbers(*offsets, place + "/offsets");
    if (ends.size() != cells)
      breaks(place + "/offsets", "holds " + std::to_string(ends.size()) + " numbers for " +
                                     std::to_string(cells) +
                                     (kind == std::string_view("Lines") ? " lines" : " faces"));
    double start = 0;
    for (std::size_t i = 0; i < cells; ++i) {
      if (!(ends[i] >= start && ends[i] <= double(numbersOfPoints.size())))
        breaks(place + "/offsets",
               "value " + std::to_string(i) + " must not fall and not exceed the connectivity");
      corners_ += std::size_t(ends[i] - start);
      Amounts::check(place + "/connectivity", "lines' points", corners_, most_.corners);
      std::vector<std::uint32_t> cell;
      cell.reserve(std::size_t(ends[i] - start));
      for (auto k = std::size_t(start); k < std::size_t(ends[i]); ++k) {
        const double point = numbersOfPoints[k];
        if (!(point >= 0 && point < double(points)))
          breaks(place + "/connectivity",
                 "value " + std::to_string(k) + " lies outside the " + std::to_string(points) + " points");
        cell.push_back(base + std::uint32_t(point));
      }
      start = ends[i];
      take(std::move(cell));
    }
  }

  // Whole numbers a line; cells are counted verts first.
  void readCells(const XMLElement& piece, const std::vector<bool>& kept, std::size_t verts,
                 const std::string& place) {
    const XMLElement* data = piece.FirstChildElement("CellData");
    const std::size_t before = out_.lines.size() - std::size_t(std::ranges::count(kept, true));
    for (const XMLElement* e = data ? data->FirstChildElement("DataArray") : nullptr; e;
         e = e->NextSiblingElement("DataArray")) {
      const auto scalar = vtp::scalarNamed(attribute(*e, "type"));
      const std::string name(attribute(*e, "Name"));
      const std::string_view components = attribute(*e, "NumberOfComponents");
      if (!scalar || *scalar >= vtp::Scalar::float32 || name.empty() ||
          !(components.empty() || components == "1"))
        continue;
      const Numbers values = file_.numbers(*e, place + "/CellData/" + name);
      if (values.size() < verts + kept.size())
        breaks(place + "/CellData/" + name, "has fewer numbers than there are cells");
      auto array = std::ranges::find(out_.cellArrays, name, &VtpLines::CellArray::name);
      if (array == out_.cellArrays.end()) array = out_.cellArrays.insert(array, {name, {}});
      Amounts::check(place + "/CellData", "arrays of cells", out_.cellArrays.size(), kMostCellArrays);
      Amounts::check(place + "/CellData", "cells' numbers", out_.cellArrays.size() * out_.lines.size(),
                     most_.cellNumbers);
      array->values.resize(before, 0);
      for (std::size_t i = 0; i < kept.size(); ++i)
        if (kept[i])
          array->values.push_back(std::int32_t(std::clamp(values[verts + i], -2147483648.0, 2147483647.0)));
    }
    for (auto& array : out_.cellArrays) array.values.resize(out_.lines.size(), 0);
  }

  ImportFrame frame_;
  Amounts most_;
  vtk::XmlFile file_;
  std::size_t corners_ = 0;
  VtpLines out_;
};

}  // namespace

const VtpLines::CellArray* VtpLines::find(std::string_view name) const {
  const auto found = std::ranges::find(cellArrays, name, &CellArray::name);
  return found == cellArrays.end() ? nullptr : &*found;
}

bool vtpTellsRadii(std::span<const std::byte> bytes) {
  try {
    return VtpReader(bytes, {}).tellsRadii();
  } catch (const BrokenRule&) {
    return true;
  }
}

std::string vtpSpace(std::span<const std::byte> bytes) {
  try {
    return VtpReader(bytes, {}).space();
  } catch (const BrokenRule&) {
    return {};
  }
}

Result<VtpLines> parseVtp(std::span<const std::byte> bytes, const std::string& name,
                          const ImportFrame& frame) {
  try {
    VtpReader reader(bytes, frame);
    VtpLines lines = reader.run();
    if (!reader.remark.empty()) logWarning(name + ": " + reader.remark);
    return lines;
  } catch (const BrokenRule& broken) {
    return badInput(name + ": " + broken.place + ": " + broken.rule);
  }
}

Result<TriangleMesh> parseVtpSurface(std::span<const std::byte> bytes, const std::string& name,
                                     const ImportFrame& frame) {
  try {
    return VtpReader(bytes, frame).surface();
  } catch (const BrokenRule& broken) {
    return badInput(name + ": " + broken.place + ": " + broken.rule);
  }
}

Result<VtpLines> readVtp(const std::filesystem::path& path, const ImportFrame& frame) {
  const auto bytes = readFile(path, vtk::kMaximumBytes);
  if (!bytes) return bytes.error();
  return parseVtp(*bytes, path.string(), frame);
}

}  // namespace vasa
