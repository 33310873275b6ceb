#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "commands.h"
#include "core/visible.h"
#include "network/compare.h"
#include "report.h"
#include "scene/vessel_files.h"

// vasa compare: what two networks in one body tell of the vessels that both have.
namespace vasa::cli {
namespace compare_command {

struct Options {
  std::string network, other;
  std::size_t rows = 20;
};

// None of nothing.
Report medianOf(std::vector<double> values) {
  if (values.empty()) return nullptr;
  const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

Report meanOf(const std::vector<double>& values) {
  if (values.empty()) return nullptr;
  return std::accumulate(values.begin(), values.end(), 0.0) / double(values.size());
}

Report shareWithin15Percent(const std::vector<double>& ratios) {
  if (ratios.empty()) return nullptr;
  const auto near = std::ranges::count_if(ratios, [](double ratio) { return std::abs(ratio - 1) <= 0.15; });
  return double(near) / double(ratios.size());
}

Report asReport(const std::vector<VesselComparison>& all) {
  Report report{{"vessels", Report::array()}};
  std::vector<double> ratios, shared, apart;
  for (const VesselComparison& vessel : all) {
    ratios.push_back(vessel.lengthRatio()), apart.push_back(vessel.apart());
    if (vessel.sharedRatio() > 0) shared.push_back(vessel.sharedRatio());
    report["vessels"].push_back({{"name", vessel.name},
                                 {"other_name", vessel.otherName},
                                 {"kind", kindName(vessel.kind)},
                                 {"length_m", vessel.length},
                                 {"other_length_m", vessel.otherLength},
                                 {"length_ratio", vessel.lengthRatio()},
                                 {"whole_length_m", vessel.whole},
                                 {"other_whole_length_m", vessel.otherWhole},
                                 {"shared_length_m", vessel.shared},
                                 {"other_shared_length_m", vessel.otherShared},
                                 {"distance_m", vessel.distance},
                                 {"other_distance_m", vessel.otherDistance}});
  }
  report["summary"] = {{"common", all.size()},
                       {"length_ratio_median", medianOf(ratios)},
                       {"length_within_15_percent", shareWithin15Percent(ratios)},
                       {"shared_ratio_median", medianOf(shared)},
                       {"shared_within_15_percent", shareWithin15Percent(shared)},
                       {"apart_median_m", medianOf(apart)},
                       {"apart_mean_m", meanOf(apart)}};
  return report;
}

std::string asText(const std::vector<VesselComparison>& all, const Report& report, std::size_t rows) {
  if (all.empty())
    return "no vessel is in both: vessels are compared by name, or else by ontology id, and none has its like; vasa info NET --vessels lists them\n";
  const Report& summary = report["summary"];
  std::string text = fmt::format(
      "{} vessels in both; in the middle {:.2f} times as long ({:.0f} % of them within 15 %) and {:.1f} mm apart (mean {:.1f})\n",
      all.size(), summary["length_ratio_median"].get<double>(),
      100 * summary["length_within_15_percent"].get<double>(), 1e3 * summary["apart_median_m"].get<double>(),
      1e3 * summary["apart_mean_m"].get<double>());
  text += fmt::format("{:<50} {:>9} {:>9} {:>6} {:>6} {:>9} {:>9}\n", "farthest apart", "length mm",
                      "other mm", "ratio", "shared", "apart mm", "back mm");
  for (std::size_t i = 0; i < std::min(rows, all.size()); ++i)
    text += fmt::format("{:<50} {:>9.1f} {:>9.1f} {:>6.2f} {:>6} {:>9.1f} {:>9.1f}\n", visible(all[i].name),
                        1e3 * all[i].length, 1e3 * all[i].otherLength, all[i].lengthRatio(),
                        all[i].sharedRatio() > 0 ? fmt::format("{:.2f}", all[i].sharedRatio()) : "-",
                        1e3 * all[i].distance, 1e3 * all[i].otherDistance);
  return text;
}

Result<void> run(const Globals& globals, const Options& options) {
  const auto network = readNetworkFile(options.network);
  if (!network) return network.error();
  const auto other = readNetworkFile(options.other);
  if (!other) return other.error();
  std::vector<VesselComparison> all = compareVessels(*network, *other);
  std::ranges::stable_sort(all, std::greater{}, &VesselComparison::apart);
  const Report report = asReport(all);
  return globals.json ? printJson(report) : printText(asText(all, report, options.rows));
}

}  // namespace compare_command

void addCompare(CLI::App& app, Command& command) {
  using namespace compare_command;
  auto options = std::make_shared<Options>();
  CLI::App* sub =
      app.add_subcommand("compare", "Lengths and courses of the vessels that two networks both have");
  sub->footer(
      "Examples:\n"
      "  vasa fit theirs.vasa --from theirs.glb --to ours.glb -o fitted.vasa && vasa compare ours.vasa fitted.vasa\n"
      "  vasa compare ours.vasa fitted.vasa --json\n"
      "Both networks must lie in one body. Vessels are the same by name, or else by ontology id; all that share an id with\n"
      "what the other calls by one name are compared at once. `length`: of a vessel's course, which is the longest way along\n"
      "its pieces: twigs that one network draws under the same name and the other does not count in neither (whole_length_m\n"
      "of --json counts all). `shared`: ratio of the stretches that both tell, between the places nearest to the other's ends.\n"
      "`apart`: mean distance of the first's course from the other's pieces, `back`: of the other's from the first's. The\n"
      "farthest apart come first.");
  sub->add_option("NETWORK", options->network, "The network (.vasa)")->required();
  sub->add_option("OTHER", options->other, "The one it is compared with (.vasa)")->required();
  sub->add_option("--rows", options->rows, "Rows of the table")
      ->check(CLI::Range(1, 100'000))
      ->capture_default_str();
  sub->callback(
      [options, &command] { command.run = [options, &command] { return run(command.globals, *options); }; });
}

}  // namespace vasa::cli
