#include <bit>

#include "io/base64.h"
#include "io/vtp.h"
#include "io/vtp_data.h"

namespace vasa {
namespace {

static_assert(std::endian::native == std::endian::little, "blocks are written as they lie in memory");

template <class T>
std::string block(const std::vector<T>& values) {
  const auto length = std::uint32_t(values.size() * sizeof(T));
  std::vector<std::byte> bytes;
  const auto header = std::as_bytes(std::span(&length, 1)), content = std::as_bytes(std::span(values));
  bytes.insert(bytes.end(), header.begin(), header.end());
  bytes.insert(bytes.end(), content.begin(), content.end());
  return encodeBase64(bytes);
}

// An attribute's text: what XML might take for its own goes by number.
std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    const auto code = static_cast<unsigned char>(c);
    if (code < 0x20 || c == '<' || c == '>' || c == '&' || c == '"' || c == '\'')
      out += "&#" + std::to_string(code) + ";";
    else
      out += c;
  }
  return out;
}

template <class T>
std::string array(const char* type, const std::string& name, const std::vector<T>& values,
                  int components = 1) {
  std::string text = std::string("        <DataArray type=\"") + type + "\" Name=\"" + escaped(name) + "\"";
  if (components > 1) text += " NumberOfComponents=\"" + std::to_string(components) + "\"";
  return text + " format=\"binary\">\n          " + block(values) + "\n        </DataArray>\n";
}

std::string cells(const char* kind, const std::vector<std::int64_t>& connectivity,
                  const std::vector<std::int64_t>& offsets) {
  return std::string("      <") + kind + ">\n" + array("Int64", "connectivity", connectivity) +
         array("Int64", "offsets", offsets) + "      </" + kind + ">\n";
}

// VTK keeps strings as the numbers of their bytes, a zero after each.
std::string nameField(const std::vector<std::string>& names) {
  if (names.empty()) return {};
  std::string text = "    <FieldData>\n      <Array type=\"String\" Name=\"VesselNames\" NumberOfTuples=\"" +
                     std::to_string(names.size()) + "\" format=\"ascii\">\n";
  for (const std::string& name : names) {
    text += "        ";
    for (const unsigned char c : name) text += std::to_string(c) + " ";
    text += "0\n";
  }
  return text + "      </Array>\n    </FieldData>\n";
}

}  // namespace

std::string encodeVtp(const VtpLines& lines, const ImportFrame& frame) {
  std::vector<double> points, radii;
  for (const vec4& p : lines.points) {
    const dvec3 place = frame.toFile(vec3(p));
    points.insert(points.end(), {place.x, place.y, place.z});
    radii.push_back(double(p.w) / frame.metresPerUnit);
  }
  std::vector<std::int64_t> connectivity, offsets;
  for (const auto& line : lines.lines) {
    connectivity.insert(connectivity.end(), line.begin(), line.end());
    offsets.push_back(std::int64_t(connectivity.size()));
  }
  std::string text =
      "<?xml version=\"1.0\"?>\n"
      "<VTKFile type=\"PolyData\" version=\"0.1\" byte_order=\"LittleEndian\" header_type=\"UInt32\">\n"
      "  <PolyData>\n" +
      nameField(lines.names) + "    <Piece NumberOfPoints=\"" + std::to_string(lines.points.size()) +
      "\" NumberOfVerts=\"0\" NumberOfLines=\"" + std::to_string(lines.lines.size()) +
      "\" NumberOfStrips=\"0\" NumberOfPolys=\"0\">\n";
  text += "      <PointData>\n" + array("Float64", "MaximumInscribedSphereRadius", radii) +
          "      </PointData>\n";
  text += "      <CellData>\n";
  for (const auto& cellArray : lines.cellArrays) text += array("Int32", cellArray.name, cellArray.values);
  text += "      </CellData>\n";
  text += "      <Points>\n" + array("Float64", "Points", points, 3) + "      </Points>\n";
  text += cells("Verts", {}, {}) + cells("Lines", connectivity, offsets) + cells("Strips", {}, {}) +
          cells("Polys", {}, {});
  return text + "    </Piece>\n  </PolyData>\n</VTKFile>\n";
}

}  // namespace vasa
