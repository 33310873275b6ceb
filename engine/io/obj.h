#pragma once
#include <filesystem>
#include <string_view>
#include <vector>

#include "core/result.h"
#include "io/import_frame.h"
#include "mesh/mesh_element.h"

namespace vasa {

/// The objects and groups of a Wavefront OBJ file that have faces, in the file's order; polygons are cut into
/// triangles (mesh/polygon.h). A group that is named again within its object goes on; a backslash at its end
/// joins a line to the next. Each element holds the vertices its faces use, in the file's order; nothing is
/// welded. An element without a name takes the file's. Materials are told by name, and by the colours
/// of vertices where all have one; normals, texture
/// coordinates, lines and curves are passed over; nothing but the file itself is opened. Fails with badInput,
/// naming file and line: a vertex that is not three finite numbers or lies too far away, a face with fewer
/// than three or more than 512 corners or an index outside the vertices, more than 100,000 objects and one
/// for 64 bytes, a file without faces.
Result<std::vector<MeshElement>> readObj(const std::filesystem::path& path, const ImportFrame& frame = {});

/// The same from text. @param path  for messages and names
Result<std::vector<MeshElement>> parseObj(std::string_view text, const std::filesystem::path& path,
                                          const ImportFrame& frame = {});

}  // namespace vasa
