#include "io/vtk.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <optional>
#include <span>

#include "core/atomic_file.h"
#include "core/cancellation.h"
#include "core/log.h"
#include "io/radius_array.h"
#include "io/vtk_sections.h"
#include "io/vtp_data.h"
#include "io/words.h"
#include "mesh/polygon.h"

// What a legacy file's sections (vtk_sections.h) mean here: lines with radii, or a surface.
namespace vasa {
namespace {

using vtk::breaks, vtk::BrokenRule, vtk::Cells, vtk::Sections, vtk::sectionsOf;

constexpr std::size_t kMaximumBytes = std::size_t(1) << 28;
constexpr std::size_t kMostCorners = 512;  // as for .obj: cutting a polygon takes the square of them at worst

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
  std::string remark;
};

// Of points, else of lines; `lines` are the file's cells `kept`, which are told behind `before` others.
Radii radiiOf(const Sections& file, std::span<const std::vector<std::uint32_t>> lines,
              std::span<const std::size_t> kept, std::size_t before) {
  std::vector<std::string> names[2];
  for (const auto& [name, values] : file.pointData)
    if (values.size() == file.points.size()) names[0].push_back(name);
  for (const auto& [name, values] : file.cellData)
    if (kept.empty() || values.size() > before + kept.back()) names[1].push_back(name);
  for (const bool ofLines : {false, true}) {
    const auto choice = chooseRadius(names[ofLines]);
    if (!choice) continue;
    Radii radii{names[ofLines][choice->array], {}, {}};
    radii.remark = radiusRemark(radii.array, *choice, ofLines);
    if (ofLines) {
      const std::vector<double>& all = file.cellData.at(radii.array);
      std::vector<double> ofLine;
      for (const std::size_t cell : kept) ofLine.push_back(all[before + cell]);
      radii.values = radiiOfPoints(file.points.size(), lines, ofLine);
    } else {
      radii.values = file.pointData.at(radii.array);
    }
    for (double& value : radii.values) value *= choice->factor;
    return radii;
  }
  breaks("POINT_DATA", missingRadius(names[0], names[1]));
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
  const Radii radii = radiiOf(file, out.lines, kept, before);
  remark = radii.remark;
  for (std::size_t i = 0; i < file.points.size(); ++i) {
    if (!(radii.values[i] >= 0)) breaks(radii.array, "of point " + std::to_string(i) + " must be positive");
    out.points.push_back(
        vec4(placed(file.points[i], frame, i), float(radii.values[i] * frame.metresPerUnit)));
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
  const auto bytes = readFile(path, kMaximumBytes);
  if (!bytes) return VtkContent::nothing;
  const std::string_view text(reinterpret_cast<const char*>(bytes->data()), bytes->size());
  const auto counted = [&](std::string_view mark, char quote) {
    for (std::size_t at = text.find(mark); at != text.npos; at = text.find(mark, at + mark.size())) {
      std::string_view rest = text.substr(at + mark.size(), 24);
      if (quote && (rest.empty() || (rest[0] != '"' && rest[0] != '\''))) continue;
      const std::size_t digit = rest.find_first_of("123456789"), other = rest.find_first_not_of(" \"'0");
      if (digit != rest.npos && digit == other) return true;
    }
    return false;
  };
  if (text.starts_with("# vtk DataFile")) {
    if (counted("\nLINES ", 0)) return VtkContent::lines;
    return counted("\nPOLYGONS ", 0) || counted("\nTRIANGLE_STRIPS ", 0) ? VtkContent::surface
                                                                         : VtkContent::nothing;
  }
  if (counted("NumberOfLines=", '"')) return VtkContent::lines;
  return counted("NumberOfPolys=", '"') || counted("NumberOfStrips=", '"') ? VtkContent::surface
                                                                           : VtkContent::nothing;
}

Result<VtpLines> parseVtkLines(std::span<const std::byte> bytes, const std::string& name,
                               const ImportFrame& frame) {
  try {
    std::string remark;
    VtpLines lines = linesOf(sectionsOf(bytes), frame, remark);
    if (!remark.empty()) logWarning(name + ": " + remark);
    return lines;
  } catch (const BrokenRule& broken) {
    return badInput(name + ": " + broken.place + ": " + broken.rule);
  }
}

Result<VtpLines> readVtkLines(const std::filesystem::path& path, const ImportFrame& frame) {
  const auto bytes = readFile(path, kMaximumBytes);
  if (!bytes) return bytes.error();
  return parseVtkLines(*bytes, path.string(), frame);
}

Result<std::vector<MeshElement>> parseVtkSurface(std::span<const std::byte> bytes,
                                                 const std::filesystem::path& path,
                                                 const ImportFrame& frame) {
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  TriangleMesh mesh;
  if (text.starts_with("# vtk DataFile")) {
    try {
      mesh = surfaceOf(sectionsOf(bytes), frame);
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
  const auto bytes = readFile(path, kMaximumBytes);
  if (!bytes) return bytes.error();
  return parseVtkSurface(*bytes, path, frame);
}

}  // namespace vasa
