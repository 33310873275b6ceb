#pragma once
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "io/animated_mesh.h"
#include "scene/frame.h"
#include "surface/sweep_template.h"

namespace vasa {

/// What vessels are written as for other programs: an animated surface (.glb), a frame's surface (.obj,
/// .stl), a frame's centre lines (.vtp, .swc), measurements of all frames (.csv), tubes of two frames
/// (.tubes).
enum class ExportKind : std::uint8_t { glb, obj, stl, vtp, swc, csv, tubes };

/// By a file's extension, whatever its case; nothing for others.
std::optional<ExportKind> exportKindOf(const std::filesystem::path& file);
/// Whether one file holds many frames.
constexpr bool holdsMotion(ExportKind kind) {
  return kind == ExportKind::glb || kind == ExportKind::csv || kind == ExportKind::tubes;
}

struct ExportOptions {
  FrameOptions frame;
  std::uint32_t first = 0, last = 0;         ///< frames of the clip, both included
  std::optional<SweepShape> shape;           ///< quads; none: of .glb the finest that fits, else 8 by 5
  float fps = 0;                             ///< keys a second of .glb; 0: one a frame
  std::size_t mostBytes = 128'000'000;       ///< of .glb
  float tolerance = 5e-5f;                   ///< [m] BakeOptions::mesh
  float between = 1e-3f;                     ///< [m] BakeOptions::betweenTolerance
  bool normals = true;                       ///< of .glb
  std::string unit = "mm";                   ///< of .vtp, .swc and .stl: mm, cm or m
  std::uint32_t samples = 2;                 ///< a sweep, of .vtp and .swc
  float clearance = 5e-3f;                   ///< [m] those beyond are not looked for, of .csv
  std::function<vec3(VesselKind)> colourOf;  ///< linear, of .glb
  std::function<void(std::size_t, std::size_t)> progress = {};  ///< done, of how many
};

/// What was written, for reports.
struct ExportFact {
  std::string name;
  std::variant<std::size_t, double, std::string, std::vector<std::size_t>> value;
};

/// Writes a scene's vessels. Each file appears whole or not at all. Fails as bake() and files do; can be
/// cancelled (core/cancellation.h) between frames.
/// @param clip    null: at rest
/// @param fileOf  where a frame goes; of kinds that hold motion the first frame's is asked for
Result<std::vector<ExportFact>> exportVessels(
    const Scene& scene, const Clip* clip, ExportKind kind, const ExportOptions& options,
    const std::function<std::filesystem::path(std::uint32_t)>& fileOf);

}  // namespace vasa
