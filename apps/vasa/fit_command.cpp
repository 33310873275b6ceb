#include <fmt/format.h>

#include <algorithm>

#include "body/carry.h"
#include "commands.h"
#include "core/cancellation.h"
#include "core/log.h"
#include "io/bvh.h"
#include "io/gltf.h"
#include "network/file.h"
#include "network/kinks.h"
#include "network/measure.h"
#include "network/reshape.h"
#include "report.h"
#include "rest_report.h"

// vasa fit: a network carried from one body to another with the same joints.
namespace vasa::cli {
namespace {

struct Options {
  std::string network, from, to, output, jointMap;
  bool exact = false;
};

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

std::string asText(const Report& report) {
  std::string text = fmt::format("joints     {} matched{}\n", report["joints_matched"].get<int>(),
                                 report["joints_free"].empty() ? ""
                                                               : "; these go with the joint before them: " +
                                                                     report["joints_free"].dump());
  text += fmt::format("network    {} vessels, {:.2f} m (before {:.2f} m), radii times {:.3f}\n",
                      report["vessels"].get<std::size_t>(), report["length_m"].get<double>(),
                      report["length_before_m"].get<double>(), report["radius_factor"].get<double>());
  const Report& outside = report["outside_skin"];
  if (!outside["measured"].get<bool>()) return text + "outside    not known: the body has no skin\n";
  text += fmt::format(
      "outside    {:.2f} % of the length lies outside the skin, {:.2f} % by more than 5 mm; {:.2f} % before\n",
      100 * outside["share"].get<double>(), 100 * outside["share_by_5_mm"].get<double>(),
      100 * report["outside_skin_before"]["share"].get<double>());
  std::size_t listed = 0;
  for (const Report& vessel : outside["vessels"]) {
    if (++listed > 10) break;
    text += fmt::format("           {:<50} {:.1f} of {:.1f} mm, farthest {:.1f} mm\n",
                        plainText(vessel["name"]), 1e3 * vessel["outside_m"].get<double>(),
                        1e3 * vessel["length_m"].get<double>(), 1e3 * vessel["farthest_m"].get<double>());
  }
  return text + fmt::format("written    {}: {} bytes\n", plainText(report["file"]),
                            report["file_bytes"].get<std::size_t>());
}

Result<void> run(const Globals& globals, const Options& options) {
  const auto network = readNetwork(options.network);
  if (!network) return network.error();
  const auto from = readBody(options.from);
  if (!from) return from.error();
  const auto to = readBody(options.to);
  if (!to) return to.error();
  JointMap map;
  if (!options.jointMap.empty()) {
    auto read = readJointMap(options.jointMap);
    if (!read) return read.error();
    map = std::move(*read);
  }
  auto carried = carryNetwork(*network, *from, *to, options.network, map);
  if (!carried) return carried.error();
  KinkRelaxer(*network).run(carried->points);
  checkpoint();
  const auto fitted = reshapeNetwork(*network, carried->points, carried->bodyHeight);
  if (!fitted) return badInput(options.network + ": " + fitted.error().message);
  const RestRepair repair = separateAtRest(*fitted);
  checkpoint();
  const Network& parted = repair.network;
  const auto bytes = writeNetwork(options.output, parted, {.quantise = !options.exact});
  if (!bytes) return bytes.error();
  Report report{
      {"file", options.output},
      {"file_bytes", *bytes},
      {"vessels", parted.vessels().size()},
      {"length_m", measure(parted, parted.points()).length},
      {"length_before_m", measure(*network, network->points()).length},
      {"body_height_m", carried->bodyHeight},
      {"radius_factor", carried->radiusFactor},
      {"joints_matched", carried->jointsMatched},
      {"joints_free", carried->jointsFree},
      {"points_pushed_in", carried->pushedIn},
      {"kinks", kinkCount(parted, parted.points())},
      {"kinks_before", kinkCount(*network, network->points())},
      {"outside_skin", outsideJson(parted, measureOutside(parted, parted.points(), *to))},
      {"outside_skin_before", outsideJson(*network, measureOutside(*network, network->points(), *from))}};
  addRestRepair(report, repair);
  return globals.json ? printJson(report) : printText(restRepairText(repair) + asText(report));
}

}  // namespace

void addFit(CLI::App& app, Command& command) {
  auto options = std::make_shared<Options>();
  CLI::App* sub = app.add_subcommand("fit", "Carry a network from one body to another with the same joints");
  sub->footer(
      "Examples:\n"
      "  vasa fit adult.vasa --from adult.glb --to child.glb -o child.vasa\n"
      "  vasa fit adult.vasa --from adult.glb --to other.glb --joint-map joints.txt -o other.vasa --json\n"
      "Joints match by name where both bodies are rigged by one convention, else by what part of a human body their\n"
      "names mean; --joint-map pairs the rest: a line `joint of the new body = joint of the old` each.\n"
      "Vessels that run through one another where they have come are moved apart, as by convert.");
  sub->add_option("NETWORK", options->network, "The network (.vasa)")->required();
  sub->add_option("--from", options->from, "The body it lies in (glTF)")->required();
  sub->add_option("--to", options->to, "The body to carry it to (glTF)")->required();
  sub->add_option("-o,--output", options->output, "The network to write (.vasa)")->required();
  sub->add_option("--joint-map", options->jointMap, "Pairs of joints");
  sub->add_flag("--exact", options->exact, "Write 32-bit floats, 16 bytes a point");
  sub->callback(
      [options, &command] { command.run = [options, &command] { return run(command.globals, *options); }; });
}

}  // namespace vasa::cli
