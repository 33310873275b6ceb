#pragma once
#include <filesystem>
#include <optional>
#include <vector>

#include "convert/source.h"
#include "io/import_frame.h"
#include "network/centrelines.h"
#include "scene/reading.h"

// Vessels out of files that other programs wrote.
namespace vasa {

/// What such files leave open.
struct VesselImport {
  ImportFrame frame;               ///< of all but glTF
  std::optional<VesselKind> kind;  ///< of every vessel; none: as the file or its name tells
};

/// By the file's extension: .glb, .gltf, .obj, .stl.
bool holdsSurfaces(const std::filesystem::path& path);
/// .swc, .vtp
bool holdsCentrelines(const std::filesystem::path& path);

/// Fails as readers do, with badInput where there is no triangle, and with Fault::usage for other kinds of file.
Result<std::vector<SourceElement>> readSurfaces(const std::filesystem::path& path, const VesselImport& import = {});
Result<Centrelines> readCentrelines(const std::filesystem::path& path, const VesselImport& import = {});

/// A network out of any file that has vessels: ours (.vasa) as it is, others converted (convert/convert.h). Those
/// without a unit of their own are read as millimetres where in metres they would be taller than kTallestBody.
/// @param bodyHeight  [m] of the body that they belong to; 0: their own
Result<Network> readVessels(const std::filesystem::path& path, float bodyHeight = 0, const ReadingProgress& told = {});

constexpr float kTallestBody = 4;  ///< [m]

}  // namespace vasa
