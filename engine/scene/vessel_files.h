#pragma once
#include <filesystem>
#include <optional>
#include <vector>

#include "convert/source.h"
#include "io/import_frame.h"
#include "math/aabb.h"
#include "network/centrelines.h"
#include "scene/reading.h"

// Vessels out of files that other programs wrote.
namespace vasa {

/// The one rule for files whose formats have no unit: what the file's head says (io/foreign_files.h), unless
/// that makes it taller than kTallestBody; else metres, or millimetres where in metres it would be taller
/// than that or farther from the origin than kFarthestBody, as one vessel of a scan is, or micrometres where
/// in millimetres it would be taller.
/// @param bounds  of all vessels, in the file's unit
/// @param path    of the file, or the first of several
struct LikelyUnit {
  double metres = 1;
  std::string why;  ///< "millimetres, as in metres they would be 706 m large"; empty for metres
};
LikelyUnit likelyUnit(const Aabb& bounds, const std::filesystem::path& path);
constexpr float kTallestBody = 4, kFarthestBody = 40;  ///< [m]
/// Why: "they would be 706 m large", "they would be 31 m large (in centimetres 0.31 m)", which may be meant,
/// or "they would lie 706 m from the origin".
std::string sizeInMetres(const Aabb& bounds);

/// What such files leave open.
struct VesselImport {
  ImportFrame frame;               ///< of all but glTF
  std::optional<VesselKind> kind;  ///< of every vessel; none: as the file or its name tells
};

/// By the file's extension: .glb, .gltf, .obj, .stl; .vtp and .vtk without lines.
bool holdsSurfaces(const std::filesystem::path& path);
/// The same without a skeleton: vessels, or a skin. Looks into glTF files, and fails where these are damaged.
Result<bool> holdsSurfacesAlone(const std::filesystem::path& path);
/// .swc, .mrk.json; .vtp and .vtk with lines.
bool holdsCentrelines(const std::filesystem::path& path);

/// Fails as readers do, with badInput where there is no triangle, and with Fault::usage for other kinds of
/// file.
Result<std::vector<SourceElement>> readSurfaces(const std::filesystem::path& path,
                                                const VesselImport& import = {});
/// The same in the likely unit (likelyUnit), which is said where it is not metres. @param up  of all but glTF
Result<std::vector<SourceElement>> readSurfacesInLikelyUnit(const std::filesystem::path& path,
                                                            ImportFrame::Up up);
/// Takes out organs and the like that have their names (convert/source.h), and says so. @return which
std::vector<LeftOut> leaveOutNamedOthers(std::vector<SourceElement>& sources);
/// All triangles of some surfaces.
TriangleMesh meshOf(const std::vector<SourceElement>& sources);
Result<Centrelines> readCentrelines(const std::filesystem::path& path, const VesselImport& import = {});

/// A .vasa file; of another's kind of file the refusal says what to do with it (io/foreign_files.h).
Result<Network> readNetworkFile(const std::filesystem::path& path);

/// A network out of any file that has vessels: ours (.vasa) as it is, others converted (convert/convert.h).
/// Those without a unit of their own are read in the likely one (likelyUnit), and that is said where it is
/// not metres; elements that are doubtful as vessels (convert/report.h) are warned of.
/// @param bodyHeight  [m] of the body that they belong to; 0: their own
Result<Network> readVessels(const std::filesystem::path& path, float bodyHeight = 0,
                            const ReadingProgress& told = {});

/// Fails with badInput where vessels lie farther than a kilometre from the origin: there places are rounded
/// to a sixteenth of a millimetre and more. @param name  for the message
Result<void> checkReach(const Aabb& bounds, const std::string& name);

/// Around vessels, in the unit that they were read in.
Aabb boundsOf(const std::vector<SourceElement>& sources);
Aabb boundsOf(const Centrelines& lines);

}  // namespace vasa
