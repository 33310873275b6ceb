#include "io/vtk.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <optional>
#include <span>

#include "core/atomic_file.h"
#include "core/cancellation.h"
#include "core/letters.h"
#include "core/log.h"
#include "core/text_file.h"
#include "io/radius_array.h"
#include "io/vtk_sections.h"
#include "io/vtp_data.h"
#include "io/words.h"
#include "mesh/polygon.h"

// What a legacy file's sections (vtk_sections.h) mean here: lines with radii, or a surface.
namespace vasa {
namespace {

using vtk::breaks, vtk::BrokenRule, vtk::Cells, vtk::Sections, vtk::sectionsOf;

vec3 placed(const dvec3& p, const ImportFrame& frame, std::size_t number) {
  if (!(glm::length(p) * frame.metresPerUnit <= kLargestImportedCoordinate))
    breaks("POINTS",
           "point " + std::to_string(number) +
               " is not finite or farther than 1000 km away; give the file's unit with vasa convert --unit");
  return frame.toHouse(p);
}

struct Radii {
  std::string array;
  std::vector<double> values;  // one a point
  double metresPerUnit = 1;
  std::string remark;
};

const std::vector<double>& valuesOf(const std::vector<vtk::Array>& data, const std::string& name) {
  return std::ranges::find(data, name, &vtk::Array::name)->values;
}

// Of points, else of lines; `lines` are the file's cells `kept`, which are told behind `before` others.
Radii radiiOf(const Sections& file, std::span<const std::vector<std::uint32_t>> lines,
              std::span<const std::size_t> kept, std::size_t before, const ImportFrame& frame) {
  std::vector<std::string> names[2];
  for (const auto& [name, values] : file.pointData)
    if (values.size() == file.points.size()) names[0].push_back(name);
  for (const auto& [name, values] : file.cellData)
    if (kept.empty() || values.size() > before + kept.back()) names[1].push_back(name);
  for (const bool ofLines : {false, true}) {
    const auto choice = chooseRadius(names[ofLines]);
    if (!choice) continue;
    Radii radii{names[ofLines][choice->array],
                {},
                choice->factor * (choice->unit > 0 ? choice->unit : frame.metresPerUnit),
                {}};
    radii.remark = radiusRemark(radii.array, *choice, ofLines);
    if (ofLines) {
      const std::vector<double>& all = valuesOf(file.cellData, radii.array);
      std::vector<double> ofLine;
      for (const std::size_t cell : kept) ofLine.push_back(all[before + cell]);
      radii.values = radiiOfPoints(file.points.size(), lines, ofLine);
    } else {
      radii.values = valuesOf(file.pointData, radii.array);
    }
    return radii;
  }
  breaks("POINT_DATA", missingRadius(names[0], names[1]));
}

bool tellsRadii(const Sections& file) {
  std::vector<std::string> names;
  for (const auto* data : {&file.pointData, &file.cellData})
    for (const auto& [name, values] : *data) names.push_back(name);
  return chooseRadius(names).has_value();
}

VtpLines linesOf(const Sections& file, const ImportFrame& frame, std::string& remark) {
  VtpLines out;
  const auto lines = file.cells.find("LINES");
  if (lines == file.cells.end()) breaks("POLYDATA", "has no lines");
  const auto verts = file.cells.find("VERTICES");
  const std::size_t before = verts == file.cells.end() ? 0 : verts->second.size();
  std::vector<std::size_t> kept;
  for (std::size_t i = 0; i < lines->second.size(); ++i)
    if (const auto line = lines->second[i]; line.size() > 1)
      kept.push_back(i), out.lines.emplace_back(line.begin(), line.end());
  const Radii radii = radiiOf(file, out.lines, kept, before, frame);
  remark = radii.remark;
  for (std::size_t i = 0; i < file.points.size(); ++i) {
    if (const std::string fault = radiusFault(radii.values[i], radii.metresPerUnit, i); !fault.empty())
      breaks(radii.array, fault);
    out.points.push_back(
        vec4(placed(file.points[i], frame, i), float(radii.values[i] * radii.metresPerUnit)));
  }
  for (const auto& [name, values] : file.cellData) {
    if (values.size() < before + lines->second.size()) continue;
    VtpLines::CellArray array{name, {}};
    for (const std::size_t i : kept)
      array.values.push_back(std::int32_t(std::clamp(values[before + i], -2147483648.0, 2147483647.0)));
    out.cellArrays.push_back(std::move(array));
  }
  if (out.lines.empty()) breaks("LINES", "has no lines of two points or more; give centre lines");
  const auto mended = mendRadii(out.lines, out.points);
  if (!mended) breaks(radii.array, "has no radius above zero");
  if (*mended > 0)
    remark += (remark.empty() ? "" : "; ") + std::to_string(*mended) +
              " points without a radius take a neighbour's";
  return out;
}

TriangleMesh surfaceOf(const Sections& file, const ImportFrame& frame) {
  TriangleMesh mesh;
  for (std::size_t i = 0; i < file.points.size(); ++i)
    mesh.positions.push_back(placed(file.points[i], frame, i));
  const auto cellsOf = [&](const char* name) -> const Cells& {
    static const Cells none;
    const auto found = file.cells.find(name);
    return found == file.cells.end() ? none : found->second;
  };
  const Cells &polygons = cellsOf("POLYGONS"), &strips = cellsOf("TRIANGLE_STRIPS");
  for (std::size_t i = 0; i < polygons.size(); ++i) {
    const auto polygon = polygons[i];
    if (polygon.size() > kMostCorners)
      breaks("POLYGONS",
             "a face has more than " + std::to_string(kMostCorners) + " corners; cut it into triangles");
    addPolygon(polygon, mesh);
  }
  for (std::size_t i = 0; i < strips.size(); ++i) addStrip(strips[i], mesh);
  return mesh;
}

std::string_view textOf(std::span<const std::byte> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}
// Some editors put a mark before it.
bool isLegacy(std::string_view text) { return text.substr(0, 17).find("# vtk DataFile") != text.npos; }

bool isXml(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  return first != text.npos && text[first] == '<';
}
bool isGrid(std::string_view text) {
  const std::string_view head = text.substr(0, 4096);
  return head.find("<VTKFile") != head.npos && head.find("UnstructuredGrid") != head.npos;
}

// Of all but XML's polygonal data.
Sections sectionsIn(std::span<const std::byte> bytes, std::string_view plain) {
  return isGrid(plain) ? vtk::gridSections(bytes) : sectionsOf(plain);
}

// Edges that some program drew on a surface. What cannot be read is not without: reading says why.
bool withoutRadii(std::span<const std::byte> bytes, bool legacy, std::string_view text) {
  if (!legacy) return !vtpTellsRadii(bytes);
  try {
    return !tellsRadii(sectionsOf(text));
  } catch (const BrokenRule&) {
    return false;
  }
}

}  // namespace

void addPolygon(std::span<const std::uint32_t> corners, TriangleMesh& mesh) {
  if (corners.size() < 3) return;
  std::vector<vec3> places;
  for (const std::uint32_t corner : corners) places.push_back(mesh.positions[corner]);
  std::vector<uvec3> cut;
  cutPolygon(places, cut);
  for (const uvec3& t : cut) mesh.triangles.push_back({corners[t.x], corners[t.y], corners[t.z]});
}

void addStrip(std::span<const std::uint32_t> corners, TriangleMesh& mesh) {
  for (std::size_t i = 0; i + 2 < corners.size(); ++i)
    mesh.triangles.push_back(i % 2 ? uvec3(corners[i + 1], corners[i], corners[i + 2])
                                   : uvec3(corners[i], corners[i + 1], corners[i + 2]));
}

VtkContent vtkContent(const std::filesystem::path& path) {
  const auto bytes = readFile(path, vtk::kMaximumBytes);
  if (!bytes) return VtkContent::nothing;
  std::string_view text = textOf(*bytes);
  std::string kept;
  const bool legacy = isLegacy(text);
  if (legacy) {
    const auto plain = plainText(text, {}, kept);
    if (!plain) return VtkContent::nothing;
    text = *plain;
  }
  if (isGrid(text) || (legacy && lowerCase(text.substr(0, 1024)).find("unstructured_grid") != text.npos)) {
    try {
      const Sections file = sectionsIn(*bytes, text);
      const bool lines = file.cells.contains("LINES"),
                 faces = file.cells.contains("POLYGONS") || file.cells.contains("TRIANGLE_STRIPS");
      if (lines && !(faces && !tellsRadii(file))) return VtkContent::lines;
      return faces ? VtkContent::surface : VtkContent::nothing;
    } catch (const BrokenRule&) {
      return VtkContent::nothing;
    }
  }
  std::string_view body = text;
  for (int line = 0; legacy && line < 2; ++line)  // the second is a title, in any words
    body.remove_prefix(std::min(body.find('\n', 1), body.size()));
  const auto counted = [&](std::string_view mark, char quote) {
    const auto same = [](char a, char b) { return lowerCase(a) == lowerCase(b); };
    for (auto at = body.begin();;) {
      at = std::search(at, body.end(), mark.begin(), mark.end(), same);
      if (at == body.end()) return false;
      at += std::ptrdiff_t(mark.size());
      const std::string_view rest = std::string_view(at, body.end()).substr(0, 24);
      if (quote && (rest.empty() || (rest[0] != '"' && rest[0] != '\''))) continue;
      const std::size_t digit = rest.find_first_of("123456789"), other = rest.find_first_not_of(" \"'0");
      if (digit != rest.npos && digit == other) return true;
    }
  };
  const bool lines = legacy ? counted("\nLINES ", 0) : counted("NumberOfLines=", '"'),
             faces = legacy ? counted("\nPOLYGONS ", 0) || counted("\nTRIANGLE_STRIPS ", 0)
                            : counted("NumberOfPolys=", '"') || counted("NumberOfStrips=", '"');
  if (lines && !(faces && withoutRadii(*bytes, legacy, text))) return VtkContent::lines;
  return faces ? VtkContent::surface : VtkContent::nothing;
}

Result<VtpLines> parseVtkLines(std::span<const std::byte> bytes, const std::string& name,
                               const ImportFrame& frame) {
  std::string kept;
  const auto plain = plainText(textOf(bytes), name, kept);
  if (!plain) return plain.error();
  if (isXml(*plain) && !isGrid(*plain)) return parseVtp(bytes, name, frame);
  try {
    std::string remark;
    VtpLines lines = linesOf(sectionsIn(bytes, *plain), frame, remark);
    if (!remark.empty()) logWarning(name + ": " + remark);
    return lines;
  } catch (const BrokenRule& broken) {
    return badInput(name + ": " + broken.place + ": " + broken.rule);
  }
}

Result<VtpLines> readVtkLines(const std::filesystem::path& path, const ImportFrame& frame) {
  const auto bytes = readFile(path, vtk::kMaximumBytes);
  if (!bytes) return bytes.error();
  return parseVtkLines(*bytes, path.string(), frame);
}

Result<std::vector<MeshElement>> parseVtkSurface(std::span<const std::byte> bytes,
                                                 const std::filesystem::path& path,
                                                 const ImportFrame& frame) {
  TriangleMesh mesh;
  if (isLegacy(textOf(bytes)) || isGrid(textOf(bytes))) {
    std::string kept;
    const auto plain = plainText(textOf(bytes), path.string(), kept);
    if (!plain) return plain.error();
    try {
      mesh = surfaceOf(sectionsIn(bytes, *plain), frame);
    } catch (const BrokenRule& broken) {
      return badInput(path.string() + ": " + broken.place + ": " + broken.rule);
    }
  } else {
    auto read = parseVtpSurface(bytes, path.string(), frame);
    if (!read) return read.error();
    mesh = std::move(*read);
  }
  if (mesh.triangles.empty())
    return badInput(path.string() +
                    ": the file has neither lines nor polygons; save centre lines with radii, or a surface");
  return std::vector<MeshElement>{{path.stem().string(), {}, {}, std::move(mesh), {}, {}}};
}

Result<std::vector<MeshElement>> readVtkSurface(const std::filesystem::path& path, const ImportFrame& frame) {
  const auto bytes = readFile(path, vtk::kMaximumBytes);
  if (!bytes) return bytes.error();
  return parseVtkSurface(*bytes, path, frame);
}

}  // namespace vasa
