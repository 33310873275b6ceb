#pragma once
#include <filesystem>
#include <span>
#include <vector>

#include "core/result.h"
#include "io/import_frame.h"
#include "mesh/mesh_element.h"

namespace vasa {

/// The solids of an STL file, ASCII or binary: a file whose length fits its binary count is binary, whatever
/// its first word. Corners at exactly the same place become one vertex, and triangles that lose a corner
/// thereby are dropped. A single solid takes the file's name; of several each its title, and where that is
/// empty or another's, too, the file's name and a number. Stored normals are passed over.
/// Fails with badInput, naming file and place: a file cut short, a coordinate that is not finite or too far
/// away, a facet without three corners, no triangles.
Result<std::vector<MeshElement>> readStl(const std::filesystem::path& path, const ImportFrame& frame = {});

/// The same from memory. @param path  for messages and names
Result<std::vector<MeshElement>> parseStl(std::span<const std::byte> bytes, const std::filesystem::path& path,
                                          const ImportFrame& frame = {});

}  // namespace vasa
