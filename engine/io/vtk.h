#pragma once
#include <filesystem>

#include "core/result.h"
#include "io/vtp.h"
#include "mesh/mesh_element.h"

// VTK's polygonal data, and unstructured grids that are lines or faces: XML (.vtp, .vtu) and legacy (.vtk,
// ASCII and binary).
namespace vasa {

enum class VtkContent { nothing, lines, surface };

/// What a file is about, told by its counts: lines where it has any, else a surface; that, too, where it has
/// faces and no array tells radii of its lines. Files that cannot be read, or hold neither, hold nothing;
/// reading them says why.
VtkContent vtkContent(const std::filesystem::path& path);

/// The lines of a file of any of these, as readVtp gives them, told apart by what it holds and not by its
/// name. Fails with badInput, naming file and place: no legacy VTK, another data set (with what to do), cells
/// that are neither lines nor faces, data cut short, an index out of range, numbers that are not finite, no
/// lines, no radius. Memory is in proportion to the file.
Result<VtpLines> readVtkLines(const std::filesystem::path& path, const ImportFrame& frame = {});
Result<VtpLines> parseVtkLines(std::span<const std::byte> bytes, const std::string& name,
                               const ImportFrame& frame = {});

/// The polygons and strips of a .vtp, a .vtu or a legacy .vtk file, cut into triangles. Fails as above, and
/// without any.
Result<std::vector<MeshElement>> readVtkSurface(const std::filesystem::path& path,
                                                const ImportFrame& frame = {});
Result<std::vector<MeshElement>> parseVtkSurface(std::span<const std::byte> bytes,
                                                 const std::filesystem::path& path,
                                                 const ImportFrame& frame = {});

}  // namespace vasa
