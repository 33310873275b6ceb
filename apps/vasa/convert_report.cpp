#include "convert_report.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/visible.h"
#include "network/file.h"

namespace vasa::cli {
namespace {

constexpr std::size_t kListed = 40;  // elements a person is shown

Report millimetres(const ErrorStatistics& error) {
  if (!error.measured) return nullptr;
  return {{"mean", 1e3 * error.mean}, {"p95", 1e3 * error.p95}, {"max", 1e3 * error.max}};
}

Report elementJson(const ElementReport& element) {
  return {{"name", element.name},
          {"kind", kindName(element.kind)},
          {"id", element.ontologyId},
          {"status", statusName(element.status)},
          {"reason", element.reason},
          {"duplicate", element.duplicate},
          {"method", element.method},
          {"vessels", element.vessels},
          {"sweeps", element.sweeps},
          {"triangles", element.triangles},
          {"coverage", element.coverage},
          {"error_mm", millimetres(element.error)},
          {"back_error_mm", millimetres(element.backError)}};
}

Report gapsJson(const ConvertReport& report, bool bridges) {
  Report list = Report::array();
  double total = 0, longest = 0;
  for (const Gap& gap : report.summary.joins.gaps) {
    if (gap.bridge != bridges) continue;
    total += gap.length, longest = std::max(longest, double(gap.length));
    list.push_back({{"from", report.elements[gap.fromElement].name},
                    {"to", report.elements[gap.toElement].name},
                    {"length_mm", 1e3 * gap.length}});
  }
  const std::size_t count = list.size();
  return {
      {"count", count}, {"total_mm", 1e3 * total}, {"longest_mm", 1e3 * longest}, {"joins", std::move(list)}};
}

double share(double part, double whole) { return whole > 0 ? part / whole : 0; }

std::string errorText(const char* what, const ErrorStatistics& error) {
  return fmt::format("{:<22} mean {:.2f} mm, 95 % within {:.2f} mm, largest {:.1f} mm\n", what,
                     1e3 * error.mean, 1e3 * error.p95, 1e3 * error.max);
}

}  // namespace

Report convertJson(const ConvertReport& report, const ConvertOutput& output) {
  const ConvertSummary& s = report.summary;
  Report elements = Report::array();
  for (const ElementReport& element : report.elements) elements.push_back(elementJson(element));
  return {{"elements", std::move(elements)},
          {"summary",
           {{"elements", s.elements},
            {"ok", s.ok},
            {"partial", s.partial},
            {"failed", s.failed},
            {"doubtful", s.doubtful},
            {"duplicates", s.duplicates},
            {"vessels", s.vessels},
            {"sweeps", s.sweeps},
            {"junctions", s.junctions},
            {"components", s.components},
            {"coverage", s.coverage},
            {"error_mm", millimetres(s.error)},
            {"back_error_mm", millimetres(s.backError)},
            {"length_m", s.length},
            {"artery_length_m", s.arteryLength},
            {"largest_arterial_tree_share", share(s.largestArterialTree, s.arteryLength)},
            {"joins", {{"end_to_end", s.joins.endToEnd}, {"end_to_side", s.joins.endToSide}}},
            {"gaps", gapsJson(report, false)},
            {"bridges", gapsJson(report, true)},
            {"body_height_m", s.bodyHeight},
            {"mesh_bytes", s.meshBytes},
            {"network_bytes", output.bytes},
            {"quantised", output.quantised},
            {"quantisation_error_mm", 1e3 * output.quantisationError},
            {"seconds", output.seconds}}}};
}

// ", the longest 45 mm from 'A' to 'B'"
std::string longestGapText(const ConvertReport& report) {
  const auto& gaps = report.summary.joins.gaps;
  const auto longest = std::ranges::max_element(gaps, {}, &Gap::length);
  if (longest == gaps.end()) return {};
  const auto nameOf = [&](std::uint32_t element) { return visible(report.elements[element].name); };
  const std::string where =
      longest->fromElement == longest->toElement
          ? "within '" + nameOf(longest->fromElement) + "'"
          : "from '" + nameOf(longest->fromElement) + "' to '" + nameOf(longest->toElement) + "'";
  return fmt::format(", the longest {:.0f} mm {}", 1e3 * longest->length, where);
}

std::string convertText(const ConvertReport& report, const ConvertOutput& output) {
  const ConvertSummary& s = report.summary;
  std::string text;
  std::size_t listed = 0, poor = 0;
  for (const ElementReport& element : report.elements) {
    if (element.status == ElementStatus::ok || ++poor > kListed) continue;
    ++listed;
    text += fmt::format("{:<8} {:<60} {}\n", statusName(element.status), visible(element.name.substr(0, 60)),
                        visible(element.reason));
  }
  if (poor > listed) text += fmt::format("... and {} more; --json lists them all\n", poor - listed);
  text += fmt::format("{:<22} {}: {} ok, {} partial, {} failed, {} doubtful; {} repeat others\n", "elements",
                      s.elements, s.ok, s.partial, s.failed, s.doubtful, s.duplicates);
  text += fmt::format("{:<22} {} vessels, {} sweeps, {} junctions, {} connected parts\n", "network",
                      s.vessels, s.sweeps, s.junctions, s.components);
  text += fmt::format("{:<22} {} end to side, {} end to end; {} across a gap{}\n", "joins", s.joins.endToSide,
                      s.joins.endToEnd, s.joins.gaps.size(), longestGapText(report));
  text += fmt::format("{:<22} {:.2f} m; largest arterial tree {:.0f} % of the arteries\n", "length", s.length,
                      100 * share(s.largestArterialTree, s.arteryLength));
  if (s.meshBytes > 0) text += fmt::format("{:<22} {:.1f} % of the surface\n", "coverage", 100 * s.coverage);
  text += errorText(s.meshBytes > 0 ? "mesh to sweeps" : "samples to sweeps", s.error);
  if (s.backError.measured) text += errorText("sweeps to mesh", s.backError);
  if (output.file.empty()) return text;
  text += fmt::format(
      "{:<22} {}: {} bytes{}{}\n", "written", visible(output.file), output.bytes,
      s.meshBytes > 0 && output.bytes > 0
          ? fmt::format(", {:.0f} times smaller than the meshes", double(s.meshBytes) / double(output.bytes))
          : std::string{},
      output.quantised ? fmt::format("; rounded by at most {:.3f} mm", 1e3 * output.quantisationError)
                       : std::string{});
  return text;
}

Report patchesJson(const PatchReport& report, const Network& network) {
  Report forks = Report::array(), without = Report::object();
  for (const PatchReport::Fork& fork : report.forks) {
    Report vessels = Report::array();
    for (const VesselId vessel : fork.vessels) vessels.push_back(network.vessel(vessel).name);
    const bool kept = fork.outcome == PatchOutcome::kept;
    forks.push_back({{"vessels", std::move(vessels)},
                     {"kept", kept},
                     {"reason", kept ? std::string_view{} : outcomeName(fork.outcome)},
                     {"joined", kept && fork.joined},
                     {"triangles", fork.triangles}});
  }
  for (std::size_t i = 1; i < kPatchOutcomes; ++i)
    if (const auto count = report.count(PatchOutcome(i)); count > 0)
      without[std::string(outcomeName(PatchOutcome(i)))] = count;
  const auto bare = withPatches(network, {});
  return {{"forks", report.forks.size()},
          {"kept", report.count(PatchOutcome::kept)},
          {"joined", report.joined()},
          {"without", std::move(without)},
          {"vertices", report.vertices},
          {"triangles", report.triangles},
          {"bytes", encodeNetwork(network).size() - encodeNetwork(*bare).size()},
          {"fork", std::move(forks)}};
}

std::string patchesText(const PatchReport& report) {
  std::string text = fmt::format(
      "{:<22} {} of {} forks keep the source's wall, {} of them of several surfaces; {} triangles\n",
      "patches", report.count(PatchOutcome::kept), report.forks.size(), report.joined(), report.triangles);
  for (std::size_t i = 1; i < kPatchOutcomes; ++i)
    if (const auto count = report.count(PatchOutcome(i)); count > 0)
      text += fmt::format("{:<22} {} without: {}\n", "", count, outcomeName(PatchOutcome(i)));
  return text;
}

}  // namespace vasa::cli
