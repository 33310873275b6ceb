#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "body/carry.h"
#include "body/strain.h"
#include "body/strain_limit.h"
#include "body/surface_carry.h"
#include "commands.h"
#include "core/cancellation.h"
#include "core/log.h"
#include "core/visible.h"
#include "io/bvh.h"
#include "io/foreign_files.h"
#include "io/gltf.h"
#include "network/file.h"
#include "network/kinks.h"
#include "network/measure.h"
#include "network/reshape.h"
#include "network_output.h"
#include "report.h"
#include "rest_report.h"
#include "scene/vessel_files.h"

// vasa fit: a network carried from one body, or from the surface around it, to another body.
namespace vasa::cli {
namespace fit_command {

struct Options {
  std::string network, from, to, output, jointMap, unit, up;
  bool exact = false;
};

constexpr std::size_t kListed = 10;  // vessels of a report's lists for readers

// What the network comes from, and where it went.
struct Carried {
  CarriedNetwork network;
  SkinReport outsideBefore;
  std::optional<SurfaceFit> surface;
};

Result<TriangleMesh> readSurfaceOf(const Options& options) {
  const auto up = options.up == "z" ? ImportFrame::Up::z : ImportFrame::Up::y;
  const double unit = options.unit.empty() ? 0 : metresOfUnit(options.unit);
  const auto sources =
      unit > 0 ? readSurfaces(options.from, {{unit, up}, {}}) : readSurfacesInLikelyUnit(options.from, up);
  if (!sources) return sources.error();
  TriangleMesh mesh = meshOf(*sources);
  if (unit > 0 && isGltfFile(options.from))  // read in metres, whatever their unit
    for (vec3& p : mesh.positions) p *= float(unit);
  return mesh;
}

Result<Carried> carry(const Options& options, const Network& network, const Body& to) {
  const auto surface = holdsSurfacesAlone(options.from);
  if (!surface) return surface.error();
  if (*surface) {
    if (!options.jointMap.empty())
      return Error{Fault::usage, "--joint-map pairs joints, and " + options.from + " has none"};
    const auto mesh = readSurfaceOf(options);
    if (!mesh) return mesh.error();
    auto carried = carryBySurface(network, *mesh, to, options.network, options.from);
    if (!carried) return carried.error();
    return Carried{std::move(carried->network), measureOutside(network, network.points(), *mesh),
                   carried->fit};
  }
  if (!options.unit.empty() || !options.up.empty())
    return Error{Fault::usage, "--unit and --up belong to a surface as --from; " + options.from +
                                   " is a body, in metres with +Y up"};
  const auto from = readBody(options.from);
  if (!from) return from.error();
  JointMap map;
  if (!options.jointMap.empty()) {
    auto read = readJointMap(options.jointMap);
    if (!read) return read.error();
    map = std::move(*read);
  }
  auto carried = carryNetwork(network, *from, to, options.network, map);
  if (!carried) return carried.error();
  return Carried{std::move(*carried), measureOutside(network, network.points(), *from), {}};
}

Report surfaceJson(const SurfaceFit& fit) {
  const vec3 move = fit.by.move;
  return {{"share", fit.share},
          {"distance_mm", 1e3 * fit.distance},
          {"scale", fit.by.scale},
          {"turn_degrees", 2 * std::acos(std::min(1.0f, std::abs(fit.by.turn.w))) * 180 / kPi},
          {"move_m", {move.x, move.y, move.z}}};
}

Report strainJson(const Network& network, std::span<const vec4> before, float factor) {
  Report list = Report::array();
  for (const VesselStrain& strain : measureStrain(network, before, network.points(), factor)) {
    if (list.size() == kListed) break;
    list.push_back({{"name", network.vessel(strain.vessel).name},
                    {"least", strain.least},
                    {"most", strain.most},
                    {"place_m", {strain.place.x, strain.place.y, strain.place.z}}});
  }
  return list;
}

Report outsideJson(const Network& network, const SkinReport& outside) {
  Report list = Report::array();
  for (const auto& vessel : outside.vessels)
    list.push_back({{"name", network.vessel(vessel.vessel).name},
                    {"length_m", vessel.length},
                    {"outside_m", vessel.outside},
                    {"farthest_m", vessel.farthest}});
  const double length = std::max(outside.length, 1e-12);
  return {{"measured", outside.length > 0},
          {"share", outside.outside / length},
          {"share_by_5_mm", outside.outside5mm / length},
          {"vessels", std::move(list)}};
}

std::string matchText(const Report& report) {
  if (!report.contains("surface"))
    return fmt::format("joints     {} matched{}\n", report["joints_matched"].get<int>(),
                       report["joints_free"].empty()
                           ? ""
                           : "; these go with the joint before them: " + report["joints_free"].dump());
  const Report& surface = report["surface"];
  return fmt::format(
      "surface    {:.0f} % of it lie near the skin, {:.1f} mm off in the mean: times {:.3f}, turned by {:.0f} degrees\n",
      100 * surface["share"].get<double>(), surface["distance_mm"].get<double>(),
      surface["scale"].get<double>(), surface["turn_degrees"].get<double>());
}

std::string strainText(const Report& report) {
  std::string text;
  for (const Report& vessel : report["strained"])
    text += fmt::format("{}{:<50} pieces {:.2f} to {:.2f} times as long\n",
                        text.empty() ? "strained   " : "           ", plainText(vessel["name"]),
                        vessel["least"].get<double>(), vessel["most"].get<double>());
  return text;
}

std::string limitText(const Report& limit) {
  std::string text = fmt::format("uneven     {} pieces held to {} times what lies around them",
                                 limit["pieces_held"].get<int>(), limit["times"].get<double>());
  if (const int beyond = limit["pieces_beyond"].get<int>(); beyond > 0)
    text += fmt::format("; {} could not be, the worst is {:.1f}", beyond, limit["worst"].get<double>());
  return text + "\n";
}

std::string asText(const Report& report) {
  std::string text = matchText(report);
  text += fmt::format("network    {} vessels, {:.2f} m (before {:.2f} m), radii times {:.3f}\n",
                      report["vessels"].get<std::size_t>(), report["length_m"].get<double>(),
                      report["length_before_m"].get<double>(), report["radius_factor"].get<double>());
  text += strainText(report) + limitText(report["strain_limit"]);
  const Report& outside = report["outside_skin"];
  if (!outside["measured"].get<bool>()) return text + "outside    not known: the body has no skin\n";
  text += fmt::format(
      "outside    {:.2f} % of the length lies outside the skin, {:.2f} % by more than 5 mm; {:.2f} % before\n",
      100 * outside["share"].get<double>(), 100 * outside["share_by_5_mm"].get<double>(),
      100 * report["outside_skin_before"]["share"].get<double>());
  std::size_t listed = 0;
  for (const Report& vessel : outside["vessels"]) {
    if (++listed > kListed) break;
    text += fmt::format("           {:<50} {:.1f} of {:.1f} mm, farthest {:.1f} mm\n",
                        plainText(vessel["name"]), 1e3 * vessel["outside_m"].get<double>(),
                        1e3 * vessel["length_m"].get<double>(), 1e3 * vessel["farthest_m"].get<double>());
  }
  return text + fmt::format("written    {}: {} bytes\n", plainText(report["file"]),
                            report["file_bytes"].get<std::size_t>());
}

void tellMissing(const Options& options, const CarriedNetwork& carried) {
  if (carried.vesselsPressed.empty()) return;
  std::string limbs;
  for (const std::string& limb : carried.limbsMissing) limbs += (limbs.empty() ? "" : ", ") + limb;
  logWarning(fmt::format(
      "{}: no joint answers to these parts of {}: {}; {} vessels there, '{}' first, are pressed into what is next to "
      "them; pressed of --json names all: take them out before (vasa edit: delete, or cut), or pair joints with --joint-map",
      options.to, options.from, limbs, carried.vesselsPressed.size(),
      visible(carried.vesselsPressed.front())));
}

Result<void> run(const Globals& globals, const Options& options) {
  if (auto writable = checkNetworkOutput(options.output); !writable) return writable.error();
  const auto network = readNetworkFile(options.network);
  if (!network) return network.error();
  const auto to = readBody(options.to);
  if (!to) return to.error();
  auto carrying = carry(options, *network, *to);
  if (!carrying) return carrying.error();
  CarriedNetwork* const carried = &carrying->network;
  tellMissing(options, *carried);
  const StrainLimitReport limited = limitStrain(*network, network->points(), carried->points);
  KinkRelaxer(*network).run(carried->points);
  checkpoint();
  const auto fitted = reshapeNetwork(*network, carried->points, carried->bodyHeight);
  if (!fitted) return badInput(options.network + ": " + fitted.error().message);
  const RestRepair repair = separateAtRest(*fitted);
  checkpoint();
  const Network& parted = repair.network;
  const auto bytes = writeNetwork(options.output, parted, {.quantise = !options.exact});
  if (!bytes) return bytes.error();
  Report report{{"file", options.output},
                {"file_bytes", *bytes},
                {"vessels", parted.vessels().size()},
                {"length_m", measure(parted, parted.points()).length},
                {"length_before_m", measure(*network, network->points()).length},
                {"body_height_m", carried->bodyHeight},
                {"radius_factor", carried->radiusFactor},
                {"joints_matched", carried->jointsMatched},
                {"joints_free", carried->jointsFree},
                {"limbs_missing", carried->limbsMissing},
                {"pressed", carried->vesselsPressed},
                {"points_pushed_in", carried->pushedIn},
                {"kinks", kinkCount(parted, parted.points())},
                {"kinks_before", kinkCount(*network, network->points())},
                {"outside_skin", outsideJson(parted, measureOutside(parted, parted.points(), *to))},
                {"outside_skin_before", outsideJson(*network, carrying->outsideBefore)},
                {"strained", strainJson(parted, network->points(), carried->radiusFactor)},
                {"strain_limit",
                 {{"times", kMostUnevenStrain},
                  {"pieces_held", limited.held},
                  {"pieces_beyond", limited.beyond},
                  {"worst", limited.worst}}}};
  if (carrying->surface) report["surface"] = surfaceJson(*carrying->surface);
  addRestRepair(report, repair);
  return globals.json ? printJson(report) : printText(restRepairText(repair) + asText(report));
}

}  // namespace fit_command

void addFit(CLI::App& app, Command& command) {
  using namespace fit_command;
  auto options = std::make_shared<Options>();
  CLI::App* sub =
      app.add_subcommand("fit", "Carry a network from one body, or the surface around it, to another");
  sub->footer(
      "Examples:\n"
      "  vasa fit adult.vasa --from adult.glb --to child.glb -o child.vasa\n"
      "  vasa fit adult.vasa --from adult.glb --to other.glb --joint-map joints.txt -o other.vasa --json\n"
      "  vasa fit scan.vasa --from torso.stl --unit mm --up z --to body.glb -o scan_in_body.vasa\n"
      "Joints match by name where both bodies are rigged by one convention, else by what part of a human body their\n"
      "names mean; --joint-map pairs the rest: a line `joint of the new body = joint of the old` each.\n"
      "--from may be a surface without a skeleton, of a whole person or a part, upright and held as the body is at rest: it is found in\n"
      "the body's skin by its shape, and what lies in it follows. Where front and back look alike it is taken to face +Z (scans with\n"
      "+Z up: -Y).\n"
      "Vessels that run through one another where they have come are moved apart, as by convert. The report lists the ten vessels\n"
      "of which a piece of 2 cm changed its length most, beside what the whole did.");
  sub->add_option("NETWORK", options->network, "The network (.vasa)")->required();
  sub->add_option("--from", options->from,
                  "The body it lies in (glTF), or the surface around it (GLB, OBJ, STL, VTP, VTK)")
      ->required();
  sub->add_option("--to", options->to, "The body to carry it to (glTF)")->required();
  sub->add_option("-o,--output", options->output, "The network to write (.vasa)")->required();
  sub->add_option("--unit", options->unit, "Unit of a surface as --from (default: the likely one)")
      ->check(CLI::IsMember({"m", "cm", "mm", "in", "um"}));
  sub->add_option("--up", options->up, "Axis of a surface as --from that points up (default: y)")
      ->check(CLI::IsMember({"y", "z"}));
  sub->add_option("--joint-map", options->jointMap, "Pairs of joints");
  sub->add_flag("--exact", options->exact, "Write 32-bit floats, 16 bytes a point");
  sub->callback(
      [options, &command] { command.run = [options, &command] { return run(command.globals, *options); }; });
}

}  // namespace vasa::cli
