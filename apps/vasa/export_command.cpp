#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include "commands.h"
#include "core/log.h"
#include "frame_output.h"
#include "render/look.h"
#include "report.h"
#include "scene/exporting.h"
#include "scene_options.h"
#include "tissue_options.h"
#include "track_option.h"

// vasa export: vessels in motion as files that other programs read.
namespace vasa::cli {
namespace export_command {

struct Options {
  SceneOptions scene;
  std::string output, frames, quads, track, unit = "mm";
  double fps = 0, budgetMegabytes = 128, toleranceMillimetres = 0.05, betweenMillimetres = 1,
         clearanceMillimetres = 5;
  std::uint32_t samples = 2;
  TissueOptions tissue;
  bool avoid = true, flat = false;
  std::function<bool(const char*)> isGiven;
};

// An option that a kind of file has no use for would be passed over without a word.
Result<void> refuseUseless(const Options& options, ExportKind kind) {
  using enum ExportKind;
  const struct {
    const char* option;
    std::vector<ExportKind> kinds;
    const char* of;
  } uses[] = {{"--quads", {glb, obj, stl}, ".glb, .obj and .stl"},
              {"--budget", {glb}, ".glb"},
              {"--tolerance", {glb}, ".glb"},
              {"--between", {glb}, ".glb"},
              {"--fps", {glb}, ".glb"},
              {"--flat", {glb}, ".glb"},
              {"--samples", {vtp, swc}, ".vtp and .swc"},
              {"--unit", {vtp, swc, stl}, ".vtp, .swc and .stl"},
              {"--clearance", {csv}, ".csv"}};
  for (const auto& [option, kinds, of] : uses)
    if (options.isGiven(option) && std::ranges::find(kinds, kind) == kinds.end())
      return Error{Fault::usage, fmt::format("{} is of {} files, and {} is none; leave it out", option, of,
                                             options.output)};
  return {};
}

struct Job {
  Scene scene;
  const Clip* clip = nullptr;
  FrameRange range;
  FrameOptions frame;
};

// Formats that hold one shape get the first frame where none is named and the file's name has no place for
// it.
std::string framesOf(const Options& options) {
  const auto kind = exportKindOf(options.output);
  if (!options.frames.empty() || (kind && holdsMotion(*kind)) ||
      options.output.find('{') != std::string::npos)
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
          {.keep = options.tissue.kept(), .slide = !options.tissue.noSlide, .avoid = options.avoid}};
  const auto clip = sceneClip(job.scene, *choice);
  if (!clip) return clip.error();
  job.clip = *clip;
  const auto range = parseFrameRange(framesOf(options), job.clip ? job.clip->frameCount() : 1);
  if (!range) return range.error();
  job.range = *range;
  return job;
}

Result<ExportOptions> exportOptions(const Options& options, const Job& job) {
  ExportOptions settings{.frame = job.frame, .first = job.range.first, .last = job.range.last};
  if (!options.quads.empty()) {
    const auto quads = parseQuads(options.quads);
    if (!quads) return quads.error();
    if (quads->pixelError > 0)
      return Error{
          Fault::usage,
          "--quads auto: a file has no picture to measure by; give MxN, or nothing for the finest within --budget"};
    settings.shape = SweepShape{quads->around, quads->along};
  }
  settings.fps = float(options.fps);
  settings.mostBytes = std::size_t(options.budgetMegabytes * 1e6);
  settings.tolerance = float(1e-3 * options.toleranceMillimetres);
  settings.between = float(1e-3 * options.betweenMillimetres);
  settings.normals = !options.flat;
  settings.unit = options.unit;
  settings.samples = options.samples;
  settings.clearance = float(1e-3 * options.clearanceMillimetres);
  settings.colourOf = linearColourOf;
  return settings;
}

Result<Report> exportAs(const Options& options, ExportKind kind) {
  auto job = prepare(options);
  if (!job) return job.error();
  const auto track = TrackFile::open(options.track, job->scene, job->clip, job->frame);
  if (!track) return track.error();
  auto settings = exportOptions(options, *job);
  if (!settings) return settings.error();
  ProgressLine progress("exporting");
  settings->progress = [&](std::size_t done, std::size_t total) { progress.update(done, total); };
  const auto pattern =
      FramePattern::parse(options.output, !holdsMotion(kind) && job->range.last > job->range.first);
  if (!pattern && !holdsMotion(kind)) return pattern.error();
  const auto fileOf = [&](std::uint32_t frame) -> std::filesystem::path {
    return holdsMotion(kind) ? std::filesystem::path(options.output) : pattern->of(frame);
  };
  const auto facts = exportVessels(job->scene, job->clip, kind, *settings, fileOf);
  if (!facts) return facts.error();
  if (auto saved = track->save(); !saved) return saved.error();
  Report full{{"file", options.output},
              {"clip", job->clip ? job->clip->name : "rest"},
              {"frames", job->range.last - job->range.first + 1},
              {"vessels", job->scene.network.vessels().size()}};
  for (const ExportFact& fact : *facts)
    std::visit([&](const auto& value) { full[fact.name] = value; }, fact.value);
  if (const double between = full.value("between_error_mm", 0.0); between > options.betweenMillimetres)
    logWarning(fmt::format(
        "{}: between two keys vertices stray up to {:.1f} mm, more than --between {:g}: something small moves all at once "
        "there, and more keys (--fps) only shorten how long that shows",
        options.output, between, options.betweenMillimetres));
  return full;
}

Result<void> run(const Globals& globals, const Options& options) {
  const auto kind = exportKindOf(options.output);
  if (!kind)
    return Error{Fault::usage,
                 options.output +
                     ": unknown kind of file; export writes .glb, .obj, .stl, .vtp, .swc, .csv and .tubes"};
  if (holdsMotion(*kind) && options.output.find("{frame") != std::string::npos)
    return Error{Fault::usage, "-o " + options.output +
                                   ": this kind of file holds all frames; leave {frame} out of its name"};
  if (auto fine = refuseUseless(options, *kind); !fine) return fine.error();
  const auto report = exportAs(options, *kind);
  if (!report) return report.error();
  if (globals.json) return printJson(*report);
  std::string text;
  for (const auto& [key, value] : report->items()) text += fmt::format("{:<18} {}\n", key, plainText(value));
  return printText(text);
}

}  // namespace export_command

void addExport(CLI::App& app, Command& command) {
  using namespace export_command;
  auto options = std::make_shared<Options>();
  CLI::App* sub = app.add_subcommand(
      "export", "Animated surface, posed surface, centre lines or measurements for other programs");
  options->isGiven = [sub](const char* option) { return sub->count(option) > 0; };
  sub->footer(
      "Examples:\n"
      "  vasa export --clip walk -o walk.glb\n"
      "  vasa export --clip walk -o small.glb --tolerance 0.5 --flat --budget 40\n"
      "  vasa export --clip squat --frames 40 -o squat.obj --quads 12x6\n"
      "  vasa export --clip fist --frames 0:74 -o 'lines/{frame:03}.vtp'\n"
      "  vasa export --clip walk -o walk.csv\n"
      "  vasa export --clip twist --frames 20:40 --no-avoid -o twist.tubes\n"
      ".glb: the vessels as one mesh with a material a kind; the motion as morph targets, so that any viewer plays what\n"
      "is drawn here: a key a frame (or --fps) and more where motion is curved, each vertex within --tolerance at every key;\n"
      "between_error_mm tells how far off it is between keys. The mesh's extras name the vessels, the vertex\n"
      "attribute _VESSEL numbers them: vasa convert reads them back one by one. Without --quads, as fine as --budget allows.\n"
      ".obj, .stl: one frame's surface. .vtp (VMTK's arrays), .swc: one frame's centre lines. .csv: a row a frame and vessel.\n"
      ".tubes: the first and the last frame as the two poses of a tube list for vasa bench collide.\n"
      "Formats of one frame write the first where none is named.");
  addSceneOptions(*sub, options->scene);
  addTrackOption(*sub, options->track);
  sub->add_option("-o,--output", options->output, "The file: .glb, .obj, .stl, .vtp, .swc, .csv or .tubes")
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
  sub->add_option("--unit", options->unit, "Unit of .vtp, .swc and .stl")
      ->check(CLI::IsMember({"mm", "cm", "m"}))
      ->capture_default_str();
  sub->add_option("--clearance", options->clearanceMillimetres,
                  "Clearances beyond this are left empty in .csv [mm]")
      ->check(CLI::Range(0.0, 50.0))
      ->capture_default_str();
  sub->add_flag("--flat", options->flat, "Leave normals out of a .glb: half the size, shaded facet by facet");
  sub->add_flag("--avoid,!--no-avoid", options->avoid,
                "Move vessels apart that run through one another or through bones (the default)");
  addTissueOptions(*sub, options->tissue);
  sub->callback(
      [options, &command] { command.run = [options, &command] { return run(command.globals, *options); }; });
}

}  // namespace vasa::cli
