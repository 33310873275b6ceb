#include "scene/exporting.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "collide/network_tubes.h"
#include "collide/tube_list.h"
#include "core/atomic_file.h"
#include "core/cancellation.h"
#include "io/csv.h"
#include "io/foreign_files.h"
#include "io/swc.h"
#include "io/vtp.h"
#include "scene/bake.h"
#include "scene/measurements.h"

namespace vasa {
namespace {

using Facts = std::vector<ExportFact>;

struct Job {
  const Scene& scene;
  const Clip* clip;
  const ExportOptions& options;
  const std::function<std::filesystem::path(std::uint32_t)>& fileOf;

  float timeOf(std::uint32_t frame) const { return clip ? clip->timeOfFrame(frame) : 0; }
  std::uint32_t count() const { return options.last - options.first + 1; }
  void tell(std::size_t done, std::size_t total) const {
    if (options.progress) options.progress(done, total);
  }
};

double metresOf(const std::string& unit) { return unit == "mm" ? 0.001 : unit == "cm" ? 0.01 : 1.0; }

BakeOptions bakeOptions(const Job& job) {
  const ExportOptions& options = job.options;
  BakeOptions bake{.first = options.first, .last = options.last, .fps = options.fps, .frame = options.frame};
  bake.finestThatFits = !options.shape;
  if (options.shape) bake.shape = *options.shape;
  bake.maxBytes = options.mostBytes;
  bake.betweenTolerance = options.between;
  bake.mesh = {options.tolerance, options.normals, options.colourOf};
  return bake;
}

Facts describe(const Bake& bake) {
  std::size_t triangles = 0;
  for (const auto& part : bake.mesh.parts) triangles += part.triangles.size();
  return {{"quads", fmt::format("{}x{}", bake.shape.around, bake.shape.along)},
          {"vertices", bake.mesh.positions.size()},
          {"triangles", triangles},
          {"shapes", bake.mesh.shapes.size()},
          {"keys", bake.mesh.times.size()},
          {"error_mm", 1e3 * bake.error},
          {"between_error_mm", 1e3 * bake.betweenError}};
}

Result<Facts> exportGlb(const Job& job) {
  BakeOptions settings = bakeOptions(job);
  settings.progress = [&](std::uint32_t done, std::uint32_t total) { job.tell(done, total); };
  const auto path = job.fileOf(job.options.first);
  auto made = bake(job.scene, job.clip, settings);
  if (!made) return Error{made.error().fault, path.string() + ": " + made.error().message};
  Facts facts = describe(*made);
  const std::vector<std::byte> file = encodeGlb(made->mesh);
  if (auto written = writeFileAtomically(path, file); !written) return written.error();
  facts.push_back({"file_bytes", file.size()});
  return facts;
}

// One file a frame. @param encode  of a frame: its bytes or text, and what there is to tell of it
template <class Encode>
Result<Facts> exportFrames(const Job& job, Encode encode) {
  Facts facts;
  std::size_t bytes = 0;
  for (std::uint32_t frame = job.options.first; frame <= job.options.last; ++frame) {
    checkpoint();
    const auto file = encode(frame, facts);
    if (!file) return file.error();
    if (auto written = writeFileAtomically(job.fileOf(frame), *file); !written) return written.error();
    bytes += file->size();
    job.tell(frame - job.options.first + 1, job.count());
  }
  facts.push_back({"file_bytes", bytes});
  return facts;
}

Result<AnimatedMesh> surfaceAt(const Job& job, std::uint32_t frame, Facts& facts) {
  BakeOptions settings = bakeOptions(job);
  settings.first = settings.last = frame;
  if (!job.options.shape) settings.finestThatFits = false, settings.shape = {8, 5};
  settings.maxBytes = std::size_t(1) << 34;
  settings.mesh.normals = true;
  auto made = bake(job.scene, job.clip, settings);
  if (!made) return made.error();
  facts = describe(*made);
  return std::move(made->mesh);
}

Result<Facts> exportObj(const Job& job) {
  return exportFrames(job, [&](std::uint32_t frame, Facts& facts) -> Result<std::string> {
    const auto mesh = surfaceAt(job, frame, facts);
    if (!mesh) return mesh.error();
    return encodeObj(*mesh);
  });
}

Result<Facts> exportStl(const Job& job) {
  return exportFrames(job, [&](std::uint32_t frame, Facts& facts) -> Result<std::vector<std::byte>> {
    const auto mesh = surfaceAt(job, frame, facts);
    if (!mesh) return mesh.error();
    facts.push_back({"unit", job.options.unit});
    return encodeStl(*mesh, metresOf(job.options.unit));
  });
}

template <bool vtp>
Result<Facts> exportLines(const Job& job) {
  const ImportFrame frame{metresOf(job.options.unit), ImportFrame::Up::y};
  FrameMaker maker(job.scene, job.options.frame);
  return exportFrames(job, [&](std::uint32_t number, Facts& facts) -> Result<std::string> {
    maker.make(job.clip, job.timeOf(number));
    const Centrelines lines = centrelinesOfNetwork(job.scene.network, maker.points(), job.options.samples);
    facts = {{"lines", lines.lines.size()}, {"samples", lines.sampleCount()}, {"unit", job.options.unit}};
    return vtp ? encodeVtp(vtpOfCentrelines(lines), frame) : encodeSwc(swcOfCentrelines(lines), frame);
  });
}

Result<Facts> exportMeasurements(const Job& job) {
  FrameMaker maker(job.scene, job.options.frame);
  VesselMeter meter(job.scene.network, job.options.clearance);
  std::string text =
      "frame,time_s,vessel,name,kind,length_m,volume_m3,radius_min_m,radius_mean_m,radius_max_m,curvature_max_per_m,clearance_m\n";
  for (std::uint32_t frame = job.options.first; frame <= job.options.last; ++frame) {
    checkpoint();
    const float time = job.timeOf(frame);
    maker.make(job.clip, time);
    const std::vector<VesselMeasures> all = meter.run(maker.points());
    for (std::size_t v = 0; v < all.size(); ++v) {
      const Vessel& vessel = job.scene.network.vessels()[v];
      const VesselMeasures& m = all[v];
      text += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{}\n", frame, time, v, csv::cell(vessel.name),
                          kindName(vessel.kind), m.length, m.volume, m.leastRadius, m.meanRadius,
                          m.greatestRadius, m.greatestCurvature,
                          m.clearance ? fmt::format("{}", *m.clearance) : std::string());
    }
    job.tell(frame - job.options.first + 1, job.count());
  }
  if (auto written = writeFileAtomically(job.fileOf(job.options.first), text); !written)
    return written.error();
  return Facts{{"rows", job.count() * job.scene.network.vessels().size()}, {"file_bytes", text.size()}};
}

// The first frame as pose 0, the last as pose 1; tubes near one another along the network are left out, as
// check does.
Result<Facts> exportTubes(const Job& job) {
  const NetworkTubes layout(job.scene.network);
  FrameMaker maker(job.scene, job.options.frame);
  TubeList list;
  const std::array<std::uint32_t, 2> frames{job.options.first, job.options.last};
  for (const std::size_t pose : {0, 1}) {
    checkpoint();
    maker.make(job.clip, job.timeOf(frames[pose]));
    list.poses[pose].resize(layout.count());
    layout.shape(maker.points(), list.poses[pose]);
    job.tell(pose + 1, 2);
  }
  for (std::uint32_t i = 0; i < layout.count(); ++i)
    for (const std::uint32_t j : layout.neighbours().partnersOf(i))
      if (i < j) list.excluded.push_back({i, j});
  const auto path = job.fileOf(job.options.first);
  if (auto written = writeTubeList(path, list); !written) return written.error();
  return Facts{{"tubes", std::size_t(layout.count())},
               {"excluded", list.excluded.size()},
               {"poses", std::vector<std::size_t>{frames[0], frames[1]}},
               {"file_bytes", std::size_t(std::filesystem::file_size(path))}};
}

struct Format {
  std::string_view extension;
  Result<Facts> (*write)(const Job&);
};
// By ExportKind.
constexpr std::array kFormats{
    Format{".glb", exportGlb},         Format{".obj", exportObj},          Format{".stl", exportStl},
    Format{".vtp", exportLines<true>}, Format{".swc", exportLines<false>}, Format{".csv", exportMeasurements},
    Format{".tubes", exportTubes},
};

}  // namespace

std::optional<ExportKind> exportKindOf(const std::filesystem::path& file) {
  const auto found = std::ranges::find(kFormats, extensionOf(file), &Format::extension);
  if (found == kFormats.end()) return std::nullopt;
  return ExportKind(found - kFormats.begin());
}

Result<std::vector<ExportFact>> exportVessels(
    const Scene& scene, const Clip* clip, ExportKind kind, const ExportOptions& options,
    const std::function<std::filesystem::path(std::uint32_t)>& fileOf) {
  return kFormats[std::size_t(kind)].write({scene, clip, options, fileOf});
}

}  // namespace vasa
