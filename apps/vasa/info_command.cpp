#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <optional>

#include "body/body.h"
#include "body/motion_rest.h"
#include "body/motion_units.h"
#include "body/retarget.h"
#include "capillary_options.h"
#include "commands.h"
#include "core/atomic_file.h"
#include "edit/replay.h"
#include "io/bvh.h"
#include "io/foreign_files.h"
#include "io/gltf.h"
#include "io/markups.h"
#include "io/png.h"
#include "network/file.h"
#include "network/measure.h"
#include "network/measure_profile.h"
#include "network/route.h"
#include "plate/profile_chart.h"
#include "report.h"
#include "scene/make_scene.h"
#include "scene/vessel_files.h"
#include "scene_options.h"
#include "vessel_report.h"

// vasa info: counts, sizes, lengths and volumes of a network, a body or a scene.
namespace vasa::cli {
namespace info_command {

struct Options {
  std::string file, profile, to, output;
  std::vector<std::string> edits;
  bool vessels = false, joints = false;
  std::optional<float> stepMm;
};

constexpr float kUsualStepMm = 1;

// What share of an adult's blood vessels of that volume [m3] would hold: Nadler et al. 1962 (Surgery 51:224),
// men and women alike, at 22 kg/m2. Of a height that no adult has nothing is known.
Report shareOfBlood(double volume, double height) {
  if (height < 1.2 || height > 2.2) return nullptr;
  const double kilograms = 22 * height * height;
  const double litres = 0.3615 * height * height * height + 0.03264 * kilograms + 0.3936;
  return 1e3 * volume / litres;
}

Report networkReport(const Network& network, std::uintmax_t fileBytes, bool vessels) {
  const NetworkMeasures sum = measure(network, network.points());
  std::size_t patchTriangles = 0;
  for (const ForkPatch& patch : network.patches()) patchTriangles += patch.triangles.size();
  Report report{{"kind", "network"},
                {"vessels", network.vessels().size()},
                {"arteries", sum.arteries},
                {"veins", sum.veins},
                {"sections", network.sectionCount()},
                {"sweeps", network.sweepCount()},
                {"junctions", network.junctionCount()},
                {"components", network.componentCount()},
                {"patches", network.patches().size()},
                {"patch_triangles", patchTriangles},
                {"length_m", sum.length},
                {"volume_m3", sum.volume},
                {"share_of_blood", shareOfBlood(sum.volume, network.bodyHeight())},
                {"body_height_m", network.bodyHeight()},
                {"file_bytes", fileBytes},
                {"bytes_per_sweep", network.sweepCount() ? double(fileBytes) / network.sweepCount() : 0.0}};
  if (vessels) report["vessel"] = vesselReport(network), report["fork"] = forkReport(network);
  return report;
}

// A row a joint; depth is for the tree that a person reads.
template <class NameOf, class ParentOf>
Report jointReport(std::size_t count, const HumanoidNames& parts, const NameOf& nameOf,
                   const ParentOf& parentOf) {
  Report list = Report::array();
  std::vector<int> depth(count, 0);
  for (std::size_t j = 0; j < count; ++j) {
    const JointId parent = parentOf(j);
    if (parent.valid()) depth[j] = depth[parent.value] + 1;
    list.push_back({{"name", nameOf(j)},
                    {"parent", parent.valid() ? nameOf(parent.value) : std::string{}},
                    {"part", parts.of[j]},
                    {"depth", depth[j]}});
  }
  return list;
}

std::string jointTree(const Report& joints) {
  std::string text;
  for (const Report& joint : joints)
    text += fmt::format("{:<48} {}\n",
                        std::string(2 * joint["depth"].get<std::size_t>(), ' ') + plainText(joint["name"]),
                        plainText(joint["part"]));
  return text;
}

std::string axisName(vec3 up) {
  return std::string(up.x + up.y + up.z < 0 ? "-" : "+") + (up.x != 0 ? "X" : up.y != 0 ? "Y" : "Z");
}

Report motionReport(const Motion& motion, std::uintmax_t fileBytes, bool joints) {
  const HumanoidNames parts = partsOf(motion);
  const vec3 up = upOf(motion, parts.of);
  const std::uint32_t standing = standingPose(withUp(motion, up), parts.of);
  const double unit = metresAUnit(motion, parts.of);
  Report report{{"kind", "motion"},
                {"joints", motion.joints.size()},
                {"frames", motion.frameCount},
                {"frames_per_second", motion.framesPerSecond},
                {"seconds", float(motion.frameCount - 1) / motion.framesPerSecond},
                {"names", parts.family.empty() ? "unknown" : std::string(parts.family)},
                {"parts_known", humanoidKeys(parts.of)},
                {"parts_of_a_person", kHumanoidKeys},
                {"up", axisName(up)},
                {"metres_a_unit", unit > 0 ? Report(unit) : Report()},
                {"stands_in", standing == MotionPose::kZero ? std::string("the zero pose")
                                                            : "frame " + std::to_string(standing)},
                {"file_bytes", fileBytes}};
  if (joints)
    report["joint"] = jointReport(
        motion.joints.size(), parts, [&](std::size_t j) { return motion.joints[j].name; },
        [&](std::size_t j) { return motion.joints[j].parent; });
  return report;
}

Report bodyReport(const Body& body, std::uintmax_t fileBytes, bool joints = false) {
  const HumanoidNames parts = partsOf(body.skeleton);
  Report report{{"kind", "body"},
                {"joints", body.skeleton.joints.size()},
                {"names", parts.family.empty() ? "unknown" : std::string(parts.family)},
                {"parts_known", humanoidKeys(parts.of)},
                {"parts_of_a_person", kHumanoidKeys},
                {"body_height_m", body.height()},
                {"file_bytes", fileBytes}};
  report["meshes"] = Report::array();
  for (const SkinnedMesh& mesh : body.meshes)
    report["meshes"].push_back({{"name", mesh.name},
                                {"vertices", mesh.mesh.positions.size()},
                                {"triangles", mesh.mesh.triangles.size()}});
  report["clips"] = Report::array();
  for (const Clip& clip : body.clips)
    report["clips"].push_back({{"name", clip.name},
                               {"frames", clip.frameCount()},
                               {"seconds", clip.end - clip.start},
                               {"frames_per_second", clip.framesPerSecond}});
  const auto& all = body.skeleton.joints;
  if (joints)
    report["joint"] = jointReport(
        all.size(), parts, [&](std::size_t j) { return all[j].name; },
        [&](std::size_t j) { return all[j].parent; });
  return report;
}

// Keys end in their unit: of volumes people read millilitres.
std::string fact(const std::string& key, const Report& value, std::size_t width = 0) {
  if (key == "volume_m3") return fmt::format("{:<{}} {:.6g}", "volume_ml", width, 1e6 * value.get<double>());
  return fmt::format("{:<{}} {}", key, width, value.is_null() ? "unknown" : plainText(value));
}

// The same facts for a person: a line a fact, a table for lists.
std::string asText(const Report& report, const std::string& indent = "") {
  std::string text;
  for (const auto& [key, value] : report.items()) {
    if (value.is_array()) {
      text += fmt::format("{}{}:\n", indent, key);
      for (const Report& item : value) {
        std::string line;
        for (const auto& [name, field] : item.items())
          line += name == "name" ? fmt::format("{:<28}", plainText(field)) : "  " + fact(name, field);
        text += indent + "  " + line + "\n";
      }
    } else if (value.is_object()) {
      text += fmt::format("{}{}:\n", indent, key) + asText(value, indent + "  ");
    } else {
      text += indent + fact(key, value, 18) + "\n";
    }
  }
  return text;
}

std::uintmax_t sizeOf(const std::filesystem::path& file) {
  std::error_code ignored;
  return std::filesystem::file_size(file, ignored);
}

// Of vessels as other programs wrote them: what there is before it is converted.
template <class Vessels>
void addExtent(Report& report, const Vessels& vessels, const std::filesystem::path& file) {
  const Aabb bounds = boundsOf(vessels);
  const vec3 extent = bounds.empty() ? vec3(0) : bounds.extent();
  const double likely = likelyUnit(bounds, file).metres, unit = isGltfFile(file) ? 1 : likely;
  report["wide_m"] = extent.x * unit, report["high_m"] = extent.y * unit, report["deep_m"] = extent.z * unit;
  report["metres_a_unit"] = unit;
  report["next"] = fmt::format("vasa convert {}{} -o NET.vasa", asArgument(file.string()),
                               unit == likely ? "" : " --unit mm");
}

Result<Report> surfaceReport(const std::filesystem::path& file) {
  auto sources = readSurfaces(file);
  if (!sources) return sources.error();
  Report report{{"kind", "surfaces"}, {"elements", sources->size()}};
  std::size_t triangles = 0;
  Report list = Report::array();
  for (const SourceElement& source : *sources) {
    triangles += source.element.mesh.triangles.size();
    list.push_back({{"name", source.label},
                    {"kind", kindName(source.kind)},
                    {"triangles", source.element.mesh.triangles.size()}});
  }
  report["triangles"] = triangles;
  addExtent(report, *sources, file);
  const auto unit = report["metres_a_unit"].get<float>();
  for (SourceElement& source : *sources)
    for (vec3& p : source.element.mesh.positions) p *= unit;
  const std::vector<NoVessel> why = noVessels(*sources);
  for (std::size_t e = 0; e < why.size(); ++e)
    if (why[e] != NoVessel::none) list[e]["left_out"] = reasonOf(why[e]);
  report["element"] = std::move(list);
  return report;
}

Result<Report> lineReport(const std::filesystem::path& file) {
  const auto lines = readCentrelines(file);
  if (!lines) return lines.error();
  Report report{{"kind", "centre lines"}, {"lines", lines->lines.size()}, {"samples", lines->sampleCount()}};
  addExtent(report, *lines, file);
  return report;
}

// What is asked for and lies in no such file.
struct NoSuchList {
  bool vessels = false, joints = false;
};

Result<void> refuseLists(const NoSuchList& asked, const std::filesystem::path& file, const char* is) {
  if (asked.vessels)
    return Error{Fault::usage,
                 fmt::format("--vessels is for a network (.vasa) or a scene; {} {}", file.string(), is)};
  if (asked.joints)
    return Error{Fault::usage,
                 fmt::format("--joints is for a body, a motion (.bvh) or a scene; {} {}", file.string(), is)};
  return {};
}

constexpr const char* kToConvert = "holds vessels that vasa convert makes a network of";

Result<Report> reportOf(const std::filesystem::path& file, bool vessels, bool joints) {
  if (isMotionFile(file.string())) {
    if (auto fine = refuseLists({.vessels = vessels}, file, "is a motion"); !fine) return fine.error();
    const auto motion = readBvh(file);
    if (!motion) return motion.error();
    return motionReport(*motion, sizeOf(file), joints);
  }
  if (const auto readable = readFile(file, 0); !readable && readable.error().fault == Fault::io)
    return readable.error();
  if (extensionOf(file) == ".vasa") {
    if (auto fine = refuseLists({.joints = joints}, file, "is a network"); !fine) return fine.error();
    const auto network = readNetwork(file);
    if (!network) return network.error();
    return networkReport(*network, sizeOf(file), vessels);
  }
  const auto surfaces = holdsSurfacesAlone(file);
  if (!surfaces) return surfaces.error();
  if (*surfaces || holdsCentrelines(file)) {
    if (auto fine = refuseLists({vessels, joints}, file, kToConvert); !fine) return fine.error();
    return *surfaces ? surfaceReport(file) : lineReport(file);
  }
  if (isGltfFile(file)) {
    if (auto fine = refuseLists({.vessels = vessels}, file, "is a body"); !fine) return fine.error();
    const auto body = readBody(file);
    if (!body) return body.error();
    return bodyReport(*body, sizeOf(file), joints);
  }
  return Error{
      Fault::usage,
      file.string() +
          ": unknown kind of file; info reads .vasa, .glb, .gltf, .vrm, .obj, .stl, .vtp, .vtu, .vtk, .swc, "
          ".mrk.json, .bvh and scene .json files" +
          remedyFor(file, FileUse::vessels)};
}

// What would grow: nothing of it is stored.
Result<Report> capillaryReport(const Scene& scene, CapillaryChoice choice) {
  choice.levels = std::max(choice.levels, 3u);
  const auto growth = growthOf(scene, choice);
  if (!growth) return growth.error();
  const SceneGrowth& grown = **growth;
  Report report{{"trees", curveCount(grown.rules.tables, grown.beds, 1)}};
  for (std::uint32_t levels = 1; levels <= choice.levels; ++levels)
    report[fmt::format("curves_{}_levels", levels)] = curveCount(grown.rules.tables, grown.beds, levels);
  report["bytes_per_bed"] = sizeof(shared::GrowthBed);
  std::vector<std::uint64_t> beds(grown.regions.size());
  for (const std::uint8_t region : grown.beds.regionOfBed) ++beds[region];
  report["regions"] = Report::array();
  for (std::size_t r = 0; r < beds.size(); ++r)
    if (beds[r] > 0) report["regions"].push_back({{"name", grown.regions[r].name}, {"beds", beds[r]}});
  return report;
}

Result<Report> sceneReport(const SceneFile& file, bool vessels, bool joints) {
  Report report{{"kind", "scene"}};
  auto body = loadBody(file);
  if (!body) return body.error();
  report["body"] = bodyReport(*body, sizeOf(file.body), joints);
  report["networks"] = Report::array();
  std::vector<Network> networks;
  std::string names;
  for (const auto& path : file.networks) {
    auto network = readVessels(path, body->height());
    if (!network) return network.error();
    Report named{{"name", path.filename().string()}};
    named.update(networkReport(*network, sizeOf(path), vessels && file.edits.empty()));
    report["networks"].push_back(std::move(named));
    names += (names.empty() ? "" : ", ") + path.filename().string();
    networks.push_back(std::move(*network));
  }
  const auto scene = makeScene(std::move(*body), std::move(networks), file, names);
  if (!scene) return scene.error();
  if (!file.edits.empty()) {
    report["edited"] = networkReport(scene->network, 0, vessels);
    report["edited"].erase("file_bytes"), report["edited"].erase("bytes_per_sweep");
  }
  auto capillaries = capillaryReport(*scene, file.capillaries);
  if (!capillaries) return capillaries;
  report["capillaries"] = std::move(*capillaries);
  return report;
}

bool isScene(const Options& options) {
  return options.file.empty() ||
         (std::filesystem::path(options.file).extension() == ".json" && !isMarkupsFile(options.file));
}

Report profileReport(const std::string& title, std::span<const ProfileStation> stations) {
  Report rows = Report::array();
  for (const ProfileStation& at : stations)
    rows.push_back({{"along_mm", 1e3 * double(at.along)},
                    {"centre_m", {at.centre.x, at.centre.y, at.centre.z}},
                    {"radius_mm", 1e3 * double(at.radius)},
                    {"area_mm2", 1e6 * double(at.area())},
                    {"curvature_per_mm", 1e-3 * double(at.curvature)}});
  return {
      {"profile", title}, {"length_mm", 1e3 * double(stations.back().along)}, {"station", std::move(rows)}};
}

// A vessel's stations. A bare .vasa file is read without its scene's body.
Result<void> printProfile(const Globals& globals, const Options& options) {
  const auto network = [&]() -> Result<Network> {
    if (!isScene(options)) return readNetworkFile(options.file);
    const auto sources = chooseScene({.scene = options.file, .edits = options.edits});
    if (!sources) return sources.error();
    auto scene = loadScene(*sources);
    if (!scene) return scene.error();
    return std::move(scene->network);
  }();
  if (!network) return network.error();
  const auto vessel = findVessel(*network, options.profile);
  if (!vessel) return badInput("--profile \"" + options.profile + "\": " + vessel.error().message);
  const float step = 1e-3f * options.stepMm.value_or(kUsualStepMm);
  std::string title = network->vessel(*vessel).name;
  std::vector<ProfileStation> stations;
  if (options.to.empty()) {
    stations = stationsOf(network->pointsOf(network->vessel(*vessel)), step);
  } else {
    const auto last = findVessel(*network, options.to);
    if (!last) return badInput("--to \"" + options.to + "\": " + last.error().message);
    const auto route = RouteFinder(*network, network->points())
                           .find({*vessel, 0}, {*last, float(network->vessel(*last).spanCount())});
    title += " to " + network->vessel(*last).name;
    if (!route) return badInput(title + ": no vessels join the two");
    stations = stationsAlong(*network, network->points(), *route, step);
  }
  if (extensionOf(options.output) == ".png") {
    const auto chart = plate::drawProfile(title, stations);
    return chart ? writePng(options.output, *chart) : Result<void>(chart.error());
  }
  if (globals.json && options.output.empty()) return printJson(profileReport(title, stations));
  const std::string csv = plate::profileCsv(stations);
  return options.output.empty() ? printText(csv) : writeFileAtomically(options.output, csv);
}

// What is long goes into tables below the rest.
std::string withTables(Report report) {
  std::string tables;
  const auto takeOut = [&](Report& from) {
    if (from.contains("vessel"))
      tables += "\n" + vesselTable(from["vessel"]) + "\n" + forkTable(from["fork"]);
    if (from.contains("joint")) tables += '\n' + jointTree(from["joint"]);
    from.erase("vessel"), from.erase("fork"), from.erase("joint");
  };
  takeOut(report);
  if (report.contains("body")) takeOut(report["body"]);
  if (report.contains("networks"))
    for (Report& network : report["networks"]) takeOut(network);
  if (report.contains("edited")) takeOut(report["edited"]);
  return asText(report) + tables;
}

Result<void> run(const Globals& globals, const Options& options) {
  if (!options.edits.empty() && !isScene(options))
    return Error{
        Fault::usage,
        "--edits belongs to a scene or the built-in human; vasa edit writes an edited network, which info reads"};
  if (!options.to.empty() && options.profile.empty())
    return Error{Fault::usage,
                 "--to is where a profile ends; name the vessel where it begins with --profile"};
  if (options.stepMm && options.profile.empty())
    return Error{Fault::usage, "--step is of a profile; name its vessel with --profile"};
  const std::string extension = extensionOf(options.output);
  if (!options.output.empty() && extension != ".csv" && extension != ".png")
    return Error{Fault::usage, "-o " + options.output + ": a profile is a table (.csv) or a picture (.png)"};
  if (!options.profile.empty()) return printProfile(globals, options);
  if (!options.output.empty())
    return Error{Fault::usage, "-o writes a vessel's profile; name the vessel with --profile"};
  auto report = [&]() -> Result<Report> {
    if (!isScene(options)) return reportOf(options.file, options.vessels, options.joints);
    const auto sources = chooseScene({.scene = options.file, .edits = options.edits});
    if (!sources) return sources.error();
    return sceneReport(*sources, options.vessels, options.joints);
  }();
  if (!report) return report.error();
  return globals.json ? printJson(*report) : printText(withTables(std::move(*report)));
}

}  // namespace info_command

void addInfo(CLI::App& app, Command& command) {
  using namespace info_command;
  auto options = std::make_shared<Options>();
  CLI::App* sub =
      app.add_subcommand("info", "Counts, sizes, lengths and volumes of a network, body, motion or scene");
  sub->footer(
      "Examples:\n"
      "  vasa info body.vasa --json\n"
      "  vasa info body.glb --joints\n"
      "  vasa info arteries.obj   (what vasa convert would read: elements, kinds, the likely unit, what is left out)\n"
      "  vasa info walk.bvh   (what a motion file holds, and how its joints are understood)\n"
      "  vasa info            (the built-in human)\n"
      "  vasa info --vessels  (a table: sizes, stenoses, aneurysms, how they wind)\n"
      "  vasa info body.vasa --profile 'left femoral artery' -o femoral.csv\n"
      "  vasa info --profile 'abdominal aorta' --to 'left popliteal artery' -o way.png   (from the start of one to the end of\n"
      "  the other)\n"
      "share_of_blood: volume by all blood of an adult of that height (Nadler 1962, at 22 kg/m2); a network of large vessels\n"
      "holds a fifth or less of it, most of the rest is in veins too small to be drawn, the heart and the lungs.");
  sub->add_option(
      "FILE", options->file,
      "A network, a body, vessels to be converted, a motion or a scene; nothing: the built-in human");
  sub->add_flag("--vessels", options->vessels,
                "List each vessel with its sizes, stenosis, aneurysm and course, and each fork");
  sub->add_flag(
      "--joints", options->joints,
      "List each joint of a body or motion, below its parent, with the part of a person that it is taken for");
  sub->add_option("--edits", options->edits,
                  "Journal of edits to a scene's vessels (.vedit); may be given several times")
      ->take_all()
      ->allow_extra_args(false);
  sub->add_option("--profile", options->profile, "Print one vessel's radius and area along its way, as CSV");
  sub->add_option("--to", options->to,
                  "Of a profile: the vessel at whose end it ends, by the shortest way there");
  sub->add_option("--step", options->stepMm,
                  fmt::format("Of a profile: millimetres between stations (default {})", kUsualStepMm))
      ->check(CLI::Range(0.01, 1000.0));
  sub->add_option(
      "-o,--output", options->output,
      "Of a profile: the file to write, a table (.csv) or a picture (.png); none: standard output");
  sub->callback(
      [options, &command] { command.run = [options, &command] { return run(command.globals, *options); }; });
}

}  // namespace vasa::cli
