#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "core/result.h"
#include "io/import_frame.h"
#include "mesh/triangle_mesh.h"
#include "network/centrelines.h"

// VTK's XML PolyData, as far as centre lines go: lines over points with a radius, and whole numbers a line.
namespace vasa {

struct VtpLines {
  /// A whole number for each line; VMTK's names are CenterlineIds, TractIds, GroupIds, Blanking.
  struct CellArray {
    std::string name;
    std::vector<std::int32_t> values;
  };
  std::vector<vec4> points;                       ///< (x, y, z, r) [m]
  std::vector<std::vector<std::uint32_t>> lines;  ///< point numbers, at least 2 each
  std::vector<CellArray> cellArrays;
  std::vector<std::string> names;  ///< of vessels, by the cell array VesselIds; ours, others have none

  const CellArray* find(std::string_view name) const;
};

/// Reads the lines of a .vtp file: data in the text, in base64 or appended, plain or zlib-compressed, of any
/// numeric type and byte order. The radius is the point array MaximumInscribedSphereRadius, or else another
/// one (io/radius_array.h); a radius of zero becomes that of the nearest point of its line that has one, with
/// a warning. Verts, strips, polygons and other arrays are passed over. Fails with badInput, naming file and
/// place: XML that is not well formed, no PolyData, data cut short or not decodable, counts that disagree, a
/// point index out of range, a value that is not finite or a radius below zero, no lines, no radius. More
/// than a file of so many bytes may ask for is refused before it is unpacked: six times as many bytes of data
/// and 16 MiB, a point for 4 bytes and 500,000, a line for 16 and 100,000 (io/read_limits.h).
Result<VtpLines> readVtp(const std::filesystem::path& path, const ImportFrame& frame = {});

/// The same from memory. @param name  for messages
Result<VtpLines> parseVtp(std::span<const std::byte> bytes, const std::string& name,
                          const ImportFrame& frame = {});

/// Whether a piece with lines has an array of radii; true, too, where the file cannot be read.
bool vtpTellsRadii(std::span<const std::byte> bytes);

/// What 3D Slicer says of a file's axes, in any encoding: "LPS" or "RAS"; empty where nothing is said, or it
/// cannot be read.
std::string vtpSpace(std::span<const std::byte> bytes);

/// The polygons and strips of such a file, cut into triangles; empty where there are none. Fails in the same
/// way.
Result<TriangleMesh> parseVtpSurface(std::span<const std::byte> bytes, const std::string& name,
                                     const ImportFrame& frame = {});

/// Adds a face, or a strip of triangles, to a mesh that has its corners already.
void addPolygon(std::span<const std::uint32_t> corners, TriangleMesh& mesh);
void addStrip(std::span<const std::uint32_t> corners, TriangleMesh& mesh);

/// The text of a file, read back as the same lines: binary, base64, not compressed, little-endian; points and
/// radii as 64-bit floats, so that nothing is lost to the change of unit.
std::string encodeVtp(const VtpLines& lines, const ImportFrame& frame = {});

/// The lines as vessels. Files of ours (VesselIds): a line a vessel. VMTK's: tracts of one centre line are
/// put together again, and what several centre lines have in common (every one starts at the inlet) becomes
/// one vessel, that of the longest; the others leave its side where they part from it. Others' (without
/// CenterlineIds): pieces that share points are put together first (io/chain_lines.h). Ends at exactly the
/// place of another line's sample are joined there. Fails with badInput where lines lie so close that telling
/// them apart takes more than 1,000 comparisons a point and 10^8.
Result<Centrelines> centrelinesOfVtp(const VtpLines& lines, const std::string& name, VesselKind kind);

/// Arrays CenterlineIds, GroupIds and TractIds number the lines (a group each, no tract divided), Blanking is
/// 0, VesselIds and VesselKinds are ours.
VtpLines vtpOfCentrelines(const Centrelines& centrelines);

}  // namespace vasa
