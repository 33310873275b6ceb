#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "collide/network_tubes.h"
#include "collide/tube_list.h"
#include "commands.h"
#include "core/atomic_file.h"
#include "core/cancellation.h"
#include "core/log.h"
#include "frame_output.h"
#include "io/swc.h"
#include "io/vtp.h"
#include "render/look.h"
#include "report.h"
#include "scene/bake.h"
#include "scene/measurements.h"
#include "scene_options.h"
#include "track_option.h"

// vasa export: vessels in motion as files that other programs read.
namespace vasa::cli {
namespace {

struct Options {
  SceneOptions scene;
  std::string output, frames, quads, track, unit = "mm";
  double fps = 0, budgetMegabytes = 100, toleranceMillimetres = 0.05, betweenMillimetres = 1,
         clearanceMillimetres = 5;
  std::uint32_t samples = 2;
  bool noVolume = false, noSlide = false, avoid = true, flat = false;
};

struct Job {
  Scene scene;
  const Clip* clip = nullptr;
  FrameRange range;
  FrameOptions frame;
};

std::string extensionOf(const std::string& file) {
  std::string extension = std::filesystem::path(file).extension().string();
  std::ranges::transform(extension, extension.begin(), [](unsigned char c) { return char(std::tolower(c)); });
  return extension;
}

// Formats that hold one shape get the first frame where none is named and the file's name has no place for
// it.
std::string framesOf(const Options& options) {
  const std::string extension = extensionOf(options.output);
  const bool holdsMotion = extension == ".glb" || extension == ".csv" || extension == ".tubes";
  if (!options.frames.empty() || holdsMotion || options.output.find('{') != std::string::npos)
    return options.frames;
  return "0";
}

Result<Job> prepare(const Options& options) {
  const auto choice = chooseScene(options.scene);
  if (!choice) return choice.error();
  auto scene = loadScene(*choice);
  if (!scene) return scene.error();
  Job job{std::move(*scene),
          nullptr,
          {},
          {.keepVolume = !options.noVolume, .slide = !options.noSlide, .avoid = options.avoid}};
  if (!choice->clip.empty()) {
    const auto clip = findClip(job.scene.body, choice->clip);
    if (!clip) return clip.error();
    job.clip = *clip;
  }
  const auto range = parseFrameRange(framesOf(options), job.clip ? job.clip->frameCount() : 1);
  if (!range) return range.error();
  job.range = *range;
  return job;
}

vec3 linearColour(VesselKind kind) {
  const vec4 colour = colourOf(kind);
  const auto linear = [](float c) {
    return c <= 0.04045f ? c / 12.92f : std::pow((c + 0.055f) / 1.055f, 2.4f);
  };
  return {linear(colour.x), linear(colour.y), linear(colour.z)};
}

Result<BakeOptions> bakeOptions(const Options& options, const Job& job) {
  BakeOptions bake{.first = job.range.first, .last = job.range.last, .frame = job.frame};
  bake.finestThatFits = options.quads.empty();
  if (!options.quads.empty()) {
    const auto quads = parseQuads(options.quads);
    if (!quads) return quads.error();
    if (quads->pixelError > 0)
      return Error{
          Fault::usage,
          "--quads auto: a file has no picture to measure by; give MxN, or nothing for the finest within --budget"};
    bake.shape = {quads->around, quads->along};
  }
  bake.fps = float(options.fps);
  bake.maxBytes = std::size_t(options.budgetMegabytes * 1048576);
  bake.betweenTolerance = float(1e-3 * options.betweenMillimetres);
  bake.mesh = {float(1e-3 * options.toleranceMillimetres), !options.flat, linearColour};
  return bake;
}

Report describe(const Bake& bake) {
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

Result<Report> exportGlb(const Options& options, const Job& job) {
  auto settings = bakeOptions(options, job);
  if (!settings) return settings.error();
  ProgressLine progress("posing");
  settings->progress = [&](std::uint32_t done, std::uint32_t total) { progress.update(done, total); };
  auto made = bake(job.scene, job.clip, *settings);
  if (!made) return Error{made.error().fault, options.output + ": " + made.error().message};
  Report report = describe(*made);
  const std::vector<std::byte> file = encodeGlb(made->mesh);
  if (auto written = writeFileAtomically(options.output, file); !written) return written.error();
  report["file_bytes"] = file.size();
  return report;
}

// One file a frame.
template <class Encode>
Result<Report> exportFrames(const Options& options, const Job& job, Encode encode) {
  const auto pattern = FramePattern::parse(options.output, job.range.last > job.range.first);
  if (!pattern) return pattern.error();
  Report report;
  std::size_t bytes = 0;
  for (std::uint32_t frame = job.range.first; frame <= job.range.last; ++frame) {
    checkpoint();
    const Result<std::string> text = encode(frame, report);
    if (!text) return text.error();
    if (auto written = writeFileAtomically(pattern->of(frame), *text); !written) return written.error();
    bytes += text->size();
  }
  report["file_bytes"] = bytes;
  return report;
}

Result<Report> exportObj(const Options& options, const Job& job) {
  return exportFrames(options, job, [&](std::uint32_t frame, Report& report) -> Result<std::string> {
    auto settings = bakeOptions(options, job);
    if (!settings) return settings.error();
    settings->first = settings->last = frame;
    if (options.quads.empty()) settings->finestThatFits = false, settings->shape = {8, 5};
    settings->maxBytes = std::size_t(1) << 34;
    settings->mesh.normals = true;
    const auto made = bake(job.scene, job.clip, *settings);
    if (!made) return made.error();
    report = describe(*made);
    return encodeObj(made->mesh);
  });
}

Result<Report> exportLines(const Options& options, const Job& job, bool vtp) {
  const ImportFrame frame{options.unit == "mm"   ? 0.001
                          : options.unit == "cm" ? 0.01
                                                 : 1.0,
                          ImportFrame::Up::y};
  FrameMaker maker(job.scene, job.frame);
  return exportFrames(options, job, [&](std::uint32_t number, Report& report) -> Result<std::string> {
    maker.make(job.clip, job.clip ? job.clip->timeOfFrame(number) : 0);
    const Centrelines lines = centrelinesOfNetwork(job.scene.network, maker.points(), options.samples);
    report = {{"lines", lines.lines.size()}, {"samples", lines.sampleCount()}, {"unit", options.unit}};
    return vtp ? encodeVtp(vtpOfCentrelines(lines), frame) : encodeSwc(swcOfCentrelines(lines), frame);
  });
}

std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) out += c == '"' ? "\"\"" : std::string(1, c);
  return out + "\"";
}

Result<Report> exportMeasurements(const Options& options, const Job& job) {
  FrameMaker maker(job.scene, job.frame);
  VesselMeter meter(job.scene.network, float(1e-3 * options.clearanceMillimetres));
  std::string text =
      "frame,time_s,vessel,name,kind,length_m,volume_m3,radius_min_m,radius_mean_m,radius_max_m,curvature_max_per_m,clearance_m\n";
  ProgressLine progress("measuring");
  for (std::uint32_t frame = job.range.first; frame <= job.range.last; ++frame) {
    checkpoint();
    const float time = job.clip ? job.clip->timeOfFrame(frame) : 0;
    maker.make(job.clip, time);
    const std::vector<VesselMeasures> all = meter.run(maker.points());
    for (std::size_t v = 0; v < all.size(); ++v) {
      const Vessel& vessel = job.scene.network.vessels()[v];
      const VesselMeasures& m = all[v];
      text += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{}\n", frame, time, v, quoted(vessel.name),
                          kindName(vessel.kind), m.length, m.volume, m.leastRadius, m.meanRadius,
                          m.greatestRadius, m.greatestCurvature,
                          m.clearance ? fmt::format("{}", *m.clearance) : std::string());
    }
    progress.update(frame - job.range.first + 1, job.range.last - job.range.first + 1);
  }
  if (auto written = writeFileAtomically(options.output, text); !written) return written.error();
  return Report{{"rows", (job.range.last - job.range.first + 1) * job.scene.network.vessels().size()},
                {"file_bytes", text.size()}};
}

// The first frame as pose 0, the last as pose 1; tubes near one another along the network are left out, as
// check does.
Result<Report> exportTubes(const Options& options, const Job& job) {
  const NetworkTubes layout(job.scene.network);
  FrameMaker maker(job.scene, job.frame);
  TubeList list;
  const std::uint32_t frames[] = {job.range.first, job.range.last};
  for (const int pose : {0, 1}) {
    checkpoint();
    maker.make(job.clip, job.clip ? job.clip->timeOfFrame(frames[pose]) : 0);
    list.poses[std::size_t(pose)].resize(layout.count());
    layout.shape(maker.points(), list.poses[std::size_t(pose)]);
  }
  for (const NeighbourPair& pair : layout.neighbours().pairs()) list.excluded.push_back(pair.tubes);
  if (auto written = writeTubeList(options.output, list); !written) return written.error();
  return Report{{"tubes", layout.count()},
                {"excluded", list.excluded.size()},
                {"poses", {frames[0], frames[1]}},
                {"file_bytes", std::filesystem::file_size(options.output)}};
}

Result<Report> exportAs(const Options& options, const std::string& extension) {
  auto job = prepare(options);
  if (!job) return job.error();
  const auto track = TrackFile::open(options.track, job->scene, job->clip, job->frame);
  if (!track) return track.error();
  auto report = extension == ".glb"     ? exportGlb(options, *job)
                : extension == ".obj"   ? exportObj(options, *job)
                : extension == ".csv"   ? exportMeasurements(options, *job)
                : extension == ".tubes" ? exportTubes(options, *job)
                                        : exportLines(options, *job, extension == ".vtp");
  if (!report) return report;
  if (auto saved = track->save(); !saved) return saved.error();
  Report full{{"file", options.output},
              {"clip", job->clip ? job->clip->name : "rest"},
              {"frames", job->range.last - job->range.first + 1},
              {"vessels", job->scene.network.vessels().size()}};
  full.update(*report);
  return full;
}

Result<void> run(const Globals& globals, const Options& options) {
  const std::string extension = extensionOf(options.output);
  constexpr std::string_view kinds[] = {".glb", ".obj", ".vtp", ".swc", ".csv", ".tubes"};
  if (std::ranges::find(kinds, extension) == std::end(kinds))
    return Error{
        Fault::usage,
        options.output + ": unknown kind of file; export writes .glb, .obj, .vtp, .swc, .csv and .tubes"};
  const auto report = exportAs(options, extension);
  if (!report) return report.error();
  if (globals.json) return printJson(*report);
  std::string text;
  for (const auto& [key, value] : report->items()) text += fmt::format("{:<18} {}\n", key, plainText(value));
  return printText(text);
}

}  // namespace

void addExport(CLI::App& app, Command& command) {
  auto options = std::make_shared<Options>();
  CLI::App* sub = app.add_subcommand(
      "export", "Animated surface, posed surface, centre lines or measurements for other programs");
  sub->footer(
      "Examples:\n"
      "  vasa export --clip walk -o walk.glb\n"
      "  vasa export --clip walk -o small.glb --tolerance 0.5 --flat --budget 30\n"
      "  vasa export --clip squat --frames 40 -o squat.obj --quads 12x6\n"
      "  vasa export --clip fist --frames 0:74 -o 'lines/{frame:03}.vtp'\n"
      "  vasa export --clip walk -o walk.csv\n"
      "  vasa export --clip twist --frames 20:40 --no-avoid -o twist.tubes\n"
      ".glb: the vessels as one mesh with a material a kind; the motion as morph targets, so that any viewer plays what\n"
      "is drawn here: a key a frame (or --fps) and more where motion is curved, each vertex within --tolerance at every key;\n"
      "between_error_mm tells how far off it is between keys. The mesh's extras name the vessels, the vertex\n"
      "attribute _VESSEL numbers them. Without --quads, as fine as --budget allows.\n"
      ".obj: one frame's surface. .vtp (VMTK's arrays), .swc: one frame's centre lines. .csv: a row a frame and vessel.\n"
      ".tubes: the first and the last frame as the two poses of a tube list for vasa bench collide.\n"
      "Formats of one frame write the first where none is named.");
  addSceneOptions(*sub, options->scene);
  addTrackOption(*sub, options->track);
  sub->add_option("-o,--output", options->output, "The file: .glb, .obj, .vtp, .swc, .csv or .tubes")
      ->required();
  sub->add_option("--frames", options->frames, "FIRST:LAST frame, both included");
  sub->add_option("--quads", options->quads, "Quads around and along every sweep, MxN");
  sub->add_option("--budget", options->budgetMegabytes, "Largest .glb file [MB]")
      ->check(CLI::Range(0.01, 4000.0))
      ->capture_default_str();
  sub->add_option("--tolerance", options->toleranceMillimetres,
                  "Farthest a vertex of a .glb may be from where it is drawn, in any frame [mm]")
      ->check(CLI::Range(0.001, 100.0))
      ->capture_default_str();
  sub->add_option(
         "--between", options->betweenMillimetres,
         "Keys are added to a .glb where vessels stray farther from the straight way between two frames [mm]")
      ->check(CLI::Range(0.01, 1000.0))
      ->capture_default_str();
  sub->add_option("--fps", options->fps, "Keys a second of a .glb (default: one a frame of the clip)")
      ->check(CLI::Range(0.1, 1000.0));
  sub->add_option("--samples", options->samples, "Samples a sweep of .vtp and .swc")
      ->check(CLI::Range(1, 64))
      ->capture_default_str();
  sub->add_option("--unit", options->unit, "Unit of .vtp and .swc")
      ->check(CLI::IsMember({"mm", "cm", "m"}))
      ->capture_default_str();
  sub->add_option("--clearance", options->clearanceMillimetres,
                  "Clearances beyond this are left empty in .csv [mm]")
      ->check(CLI::Range(0.0, 50.0))
      ->capture_default_str();
  sub->add_flag("--flat", options->flat, "Leave normals out of a .glb: half the size, shaded facet by facet");
  sub->add_flag("--avoid,!--no-avoid", options->avoid,
                "Move vessels apart that run through one another or through bones (the default)");
  sub->add_flag("--no-volume", options->noVolume, "Do not keep the vessels' volumes");
  sub->add_flag("--no-slide", options->noSlide, "Leave every vessel glued to its bed, point by point");
  sub->callback(
      [options, &command] { command.run = [options, &command] { return run(command.globals, *options); }; });
}

}  // namespace vasa::cli
