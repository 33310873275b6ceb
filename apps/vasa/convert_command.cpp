#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <iterator>
#include <map>

#include "above_zero.h"
#include "commands.h"
#include "convert/centreline_report.h"
#include "convert/convert.h"
#include "convert/keep_patches.h"
#include "convert_report.h"
#include "core/log.h"
#include "io/foreign_files.h"
#include "io/markups.h"
#include "network/file.h"
#include "network/join_lines.h"
#include "network_output.h"
#include "rest_report.h"
#include "scene/vessel_files.h"

// vasa convert: surfaces of vessels -> one network of sweeps.
namespace vasa::cli {
namespace convert_command {

// Rounding is taken for granted where it is this small beside the fit's least tolerance.
constexpr float kRoundingShare = 0.5f;

constexpr const char* kApart =
    ": surfaces and centre lines are converted apart; write two networks and give both to --network";

struct Options {
  std::vector<std::string> meshes;
  std::string output;
  std::string kind;
  std::string up = "y";
  std::string unit;
  double scale = 0;  // 0: as --unit says, else the likely one
  float bodyHeight = 0;
  float tolerance = 0;
  bool exact = false, quantise = false, noBridges = false, keepPatches = false, interpolate = false,
       part = true;
};

const std::map<std::string, VesselKind> kKinds{{"artery", VesselKind::artery},
                                               {"vein", VesselKind::vein},
                                               {"portal", VesselKind::portalVein},
                                               {"lymphatic", VesselKind::lymphatic},
                                               {"other", VesselKind::other}};

VesselImport importOf(const Options& options, double metresPerUnit) {
  VesselImport import{{metresPerUnit, options.up == "z" ? ImportFrame::Up::z : ImportFrame::Up::y}, {}};
  if (!options.kind.empty()) import.kind = kKinds.at(options.kind);
  return import;
}

Result<std::vector<SourceElement>> readSources(const Options& options, double metresPerUnit) {
  std::vector<SourceElement> sources;
  for (const std::string& file : options.meshes) {
    if (holdsCentrelines(file)) return Error{Fault::usage, file + kApart};
    auto read = readSurfaces(file, importOf(options, metresPerUnit));
    if (!read) return read.error();
    // Metres by definition, but not in every exporter's hands.
    if (isGltfFile(file) && !options.unit.empty())
      for (SourceElement& source : *read)
        for (vec3& p : source.element.mesh.positions) p *= float(metresPerUnit);
    std::ranges::move(*read, std::back_inserter(sources));
  }
  return sources;
}

// As told, else all files in the likely unit, and that is said.
template <class Read>
auto readInUnit(const Options& options, Read read) -> decltype(read(1.0)) {
  if (options.scale > 0) {
    if (std::ranges::all_of(options.meshes, isGltfFile))
      return Error{Fault::usage,
                   "--scale is for files without a unit, and glTF is in metres; --unit mm says otherwise"};
    return read(options.scale);
  }
  if (!options.unit.empty()) return read(metresOfUnit(options.unit));
  HeldWarnings ofFirst;  // reading again says them again
  auto found = read(1.0);
  if (!found) return found;
  const Aabb bounds = boundsOf(*found);
  const auto [unit, why] = likelyUnit(bounds, options.meshes.front());
  if (unit == 1 || std::ranges::all_of(options.meshes, isMarkupsFile)) return found;
  if (std::ranges::all_of(options.meshes, isGltfFile)) {
    logWarning(
        fmt::format("glTF is in metres, and the vessels look as if {}; --unit mm reads it as millimetres",
                    sizeInMetres(bounds)));
    return found;
  }
  logInfo("vessels read as " + why + "; --unit says otherwise");
  ofFirst.drop();
  return read(unit);
}

ConvertOptions convertOptions(const Options& options) {
  ConvertOptions settings;
  settings.bodyHeight = options.bodyHeight;
  settings.attach.bridges = !options.noBridges;
  if (options.tolerance > 0) {
    const float tolerance = 1e-3f * options.tolerance;
    for (FitTolerance* part : {&settings.fit.position, &settings.fit.radius})
      *part = {part->share, std::min(part->least, tolerance), tolerance};
  }
  settings.fit.interpolate = options.interpolate;
  return settings;
}

// Rounded by default where that is far below the tolerance the sweeps were fitted to.
bool isQuantised(const Options& options, const ConvertOptions& settings, const Network& network) {
  return !options.exact &&
         (options.quantise || quantisationError(network) < kRoundingShare * settings.fit.position.least);
}

Result<ConvertOutput> writeOutput(const Options& options, bool quantised, const Network& network) {
  ConvertOutput output{.file = options.output, .quantised = quantised};
  if (quantised) output.quantisationError = quantisationError(network);
  const auto written = writeNetwork(options.output, network, {.quantise = quantised});
  if (!written) return written.error();
  output.bytes = *written;
  return output;
}

// Patches are matched by place to the forks of the network that the file gives back.
Result<PatchReport> addPatches(Conversion& conversion, std::span<const SourceElement> sources,
                               bool quantised) {
  Result<Network> written =
      quantised ? decodeNetwork(encodeNetwork(conversion.network, {.quantise = true}), "network")
                : Result<Network>(conversion.network);
  if (!written) return written.error();
  KeptPatches kept = keepPatches(*written, sources, conversion.elementOf);
  auto patched = withPatches(std::move(conversion.network), std::move(kept.patches));
  if (!patched) return patched.error();
  conversion.network = std::move(*patched);
  return std::move(kept.report);
}

bool tellsTheSame(const Centrelines& a, const Centrelines& b) {
  return std::ranges::equal(a.lines, b.lines, {}, &Centrelines::Line::samples, &Centrelines::Line::samples);
}

Result<Centrelines> readLines(const Options& options, double metresPerUnit) {
  std::vector<Centrelines> files;
  for (const std::string& file : options.meshes) {
    if (!holdsCentrelines(file)) return Error{Fault::usage, file + kApart};
    auto lines = readCentrelines(file, importOf(options, metresPerUnit));
    if (!lines) return lines.error();
    if (lines->lines.empty()) return badInput(file + ": the file holds no line of two places or more");
    if (const auto same =
            std::ranges::find_if(files, [&](const auto& other) { return tellsTheSame(*lines, other); });
        same != files.end()) {
      logWarning(fmt::format("{}: tells the same as {}, and is left out", file,
                             options.meshes[std::size_t(same - files.begin())]));
      lines = Centrelines{};
    }
    files.push_back(std::move(*lines));
  }
  Centrelines all;
  for (Centrelines& lines : files) all.append(std::move(lines));
  if (options.meshes.size() > 1) joinTouchingLines(all);  // a file a trace
  return all;
}

// All lines of all files, in one network.
Result<Conversion> convertCentrelines(const Options& options) {
  const auto all =
      readInUnit(options, [&](double metresPerUnit) { return readLines(options, metresPerUnit); });
  if (!all) return all.error();
  if (auto near = checkReach(boundsOf(*all), options.meshes.front()); !near) return near.error();
  auto made = networkOfCentrelines(*all, options.bodyHeight);
  if (!made) return badInput(options.meshes.front() + ": " + made.error().message);
  ConvertReport report = reportOfCentrelines(*all, *made);
  return Conversion{std::move(made->network), std::move(report), {}};
}

// An option that says how surfaces are followed, or null.
const char* onlyForSurfaces(const Options& options) {
  return options.interpolate     ? "--interpolate"
         : options.tolerance > 0 ? "--tolerance"
         : options.noBridges     ? "--no-bridges"
         : !options.part         ? "--no-part"
                                 : nullptr;
}

void tellUnknownKinds(const Network& network) {
  const auto isUnknown = [](const Vessel& vessel) { return vessel.kind == VesselKind::other; };
  if (const auto count = std::ranges::count_if(network.vessels(), isUnknown); count > 0)
    logInfo(fmt::format(
        "no name, number, material or colour tells of {} of {} vessels whether they are arteries or veins: ends of both are "
        "joined; --kind says it of all",
        count, network.vessels().size()));
}

// What went wrong is told element by element all the same.
Result<void> refuseFailed(const Globals& globals, const ConvertReport& report) {
  if (auto told = globals.json ? printJson(convertJson(report, {})) : printText(convertText(report, {}));
      !told)
    return told.error();
  const ElementReport& first = report.elements.front();
  return badInput(fmt::format(
      "nothing is written: {} ('{}': {}); mend the surface (its pieces, its unit), or give centre lines",
      report.elements.size() == 1 ? "the one element failed" : "all elements failed", first.name,
      first.reason));
}

Result<void> run(const Globals& globals, const Options& options) {
  if (auto writable = checkNetworkOutput(options.output); !writable) return writable.error();
  const auto start = std::chrono::steady_clock::now();
  ConvertOptions settings = convertOptions(options);
  if (const auto markups = std::ranges::find_if(options.meshes, isMarkupsFile);
      markups != options.meshes.end() && (!options.unit.empty() || options.scale > 0 || options.up != "y"))
    return Error{Fault::usage,
                 *markups + ": tells its unit and its axes itself; leave out --unit, --scale and --up"};
  const bool lines = holdsCentrelines(options.meshes.front());
  if (const char* ofSurfaces = onlyForSurfaces(options); lines && ofSurfaces)
    return Error{Fault::usage, fmt::format("{}: centre lines are followed as they are told; leave out {}",
                                           options.meshes.front(), ofSurfaces)};
  if (lines) settings.fit.position.least = 0;  // radii are kept as told: rounded only when asked for
  auto sources =
      lines ? Result(std::vector<SourceElement>())
            : readInUnit(options, [&](double metresPerUnit) { return readSources(options, metresPerUnit); });
  if (!sources) return sources.error();
  std::vector<LeftOut> leftOut;
  if (options.kind.empty()) leftOut = leaveOutNamedOthers(*sources);  // else they are told to be vessels
  if (auto near = checkReach(boundsOf(*sources), options.meshes.front()); !near) return near.error();
  RestRepair repair;
  settings.mend = [&](const Network& network) {
    repair = options.part ? separateAtRest(network) : overlapsAtRest(network);
    return repair.network;
  };
  auto conversion = lines ? convertCentrelines(options) : convertElements(*sources, settings);
  if (!conversion) return conversion.error();
  if (options.kind.empty()) tellUnknownKinds(conversion->network);
  const ConvertSummary& summary = conversion->report.summary;
  if (summary.failed == summary.elements) return refuseFailed(globals, conversion->report);
  if (lines) repair = overlapsAtRest(conversion->network);  // told with their radii: nothing is done about it
  const bool quantised = isQuantised(options, settings, conversion->network);
  std::optional<PatchReport> patches;
  if (options.keepPatches) {
    auto kept =
        addPatches(*conversion, conversion->lumina.empty() ? *sources : conversion->lumina, quantised);
    if (!kept) return kept.error();
    patches = std::move(*kept);
  }
  auto output = writeOutput(options, quantised, conversion->network);
  if (!output) return output.error();
  output->seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  if (globals.json) {
    Report report = convertJson(conversion->report, *output);
    for (const std::string& wall : conversion->outerWalls) leftOut.push_back({wall, NoVessel::outerWall});
    report["left_out"] = Report::array();
    for (const LeftOut& left : leftOut)
      report["left_out"].push_back({{"name", left.name}, {"why", reasonOf(left.why)}});
    addRestRepair(report["summary"], repair);
    if (patches) report["patches"] = patchesJson(*patches, conversion->network);
    return printJson(report);
  }
  return printText((patches ? patchesText(*patches) : std::string{}) + restRepairText(repair) +
                   convertText(conversion->report, *output));
}

}  // namespace convert_command

void addConvert(CLI::App& app, Command& command) {
  using namespace convert_command;
  auto options = std::make_shared<Options>();
  CLI::App* sub =
      app.add_subcommand("convert", "Turn surfaces or centre lines of vessels into one network of sweeps");
  sub->footer(
      "Examples:\n"
      "  vasa convert arteries.glb veins.glb -o body.vasa\n"
      "  vasa convert aorta.stl --scale 0.001 --up z --kind artery -o aorta.vasa --json\n"
      "  vasa convert brain.swc --scale 0.001 --kind artery -o brain.vasa\n"
      "  vasa convert centerlines.vtp --scale 0.001 -o aorta.vasa\n"
      "  vasa convert arteries.glb -o arteries.vasa --keep-patches\n"
      "  vasa convert arteries.glb -o arteries.vasa --interpolate --json\n"
      "The kind of vessel comes from the file's extras, else from an FMA or UBERON number, else from the element's name, else\n"
      "from the file's, else from the names around it (mesh, collection, material), else from its colour.\n"
      "Elements that repeat others are dropped; ends that meet are joined, arteries to arteries and veins to veins.\n"
      "What is no vessel by its name, and the outside of another element's wall, is left out (left_out of --json, with why).\n"
      "Vessels that run through one another are moved apart by up to 6 mm and thinned by up to 1 mm (overlaps; rest_overlaps\n"
      "of --json names those that stay, with the reason). --no-part leaves them where the surfaces have them: nearer to the\n"
      "source, but what overlaps at rest is not held apart in motion, and check says so.");
  sub->add_option(
         "MESH", options->meshes,
         "Surfaces: .glb, .gltf, .obj, .stl, .vtp, .vtu, .vtk; or centre lines with radii: .swc, .vtp, .vtu, .vtk, .mrk.json")
      ->required();
  sub->add_option("-o,--output", options->output, "The network to write (.vasa)")->required();
  sub->add_option("--kind", options->kind, "Kind of every vessel: artery, vein, portal, lymphatic or other")
      ->check(CLI::IsMember({"artery", "vein", "portal", "lymphatic", "other"}));
  auto* scale =
      sub->add_option("--scale", options->scale, "Metres a unit of all but glTF files (0.001: millimetres)")
          ->check(aboveZero());
  sub->add_option(
         "--unit", options->unit,
         "The unit of all files, glTF too: m, cm, mm, in or um (default: glTF metres; others metres, or millimetres where they would be taller than 4 m)")
      ->check(CLI::IsMember({"m", "cm", "mm", "in", "um"}))
      ->excludes(scale);
  sub->add_option("--up", options->up, "The axis that points up in all but glTF files")
      ->check(CLI::IsMember({"y", "z"}))
      ->capture_default_str();
  sub->add_option("--body-height", options->bodyHeight,
                  "Height of the body [m] (default: the largest extent of the input)")
      ->check(aboveZero());
  auto* tolerance = sub->add_option("--tolerance", options->tolerance,
                                    "Largest distance of a sweep from the sections it fits [mm]")
                        ->check(aboveZero());
  sub->add_flag(
         "--interpolate", options->interpolate,
         "A sweep between every two sections that were found, through both, as the source paper does, instead of the fewest "
         "that come near enough")
      ->excludes(tolerance);
  sub->add_flag("--no-bridges", options->noBridges, "Do not join vessels of one name across long gaps");
  sub->add_flag("--part,!--no-part", options->part, "Move apart what overlaps at rest (the default)");
  sub->add_flag(
      "--keep-patches", options->keepPatches,
      "Keep the source's own wall around forks where it has one; it is drawn in their place and moves with them");
  auto* exact = sub->add_flag("--exact", options->exact, "Write 32-bit floats, 16 bytes a point");
  sub->add_flag(
         "--quantise", options->quantise,
         "Write 16-bit numbers, 8 bytes a point (default where the rounding is far below the tolerance)")
      ->excludes(exact);
  sub->callback(
      [options, &command] { command.run = [options, &command] { return run(command.globals, *options); }; });
}

}  // namespace vasa::cli
