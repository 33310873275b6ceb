#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "commands.h"
#include "core/atomic_file.h"
#include "core/cancellation.h"
#include "core/log.h"
#include "edit/replay.h"
#include "io/foreign_files.h"
#include "network/file.h"
#include "network/measure.h"
#include "network_output.h"
#include "repair/rest_repair.h"
#include "report.h"
#include "rest_report.h"
#include "scene/vessel_files.h"
#include "scene_options.h"

// vasa edit: replays a journal of edits onto a network.
namespace vasa::cli {
namespace edit_command {

struct Options {
  std::vector<std::string> files;
  std::vector<std::string> sets;
  std::string output;
  bool exact = false, part = false, keepGoing = false;
};

struct Inputs {
  std::filesystem::path network;
  std::vector<Edit> edits;
};

// Journals end in .vedit; the other file is the network.
Result<Inputs> readInputs(const Options& options) {
  Inputs inputs;
  for (const std::filesystem::path file : options.files) {
    if (extensionOf(file) != ".vedit") {
      if (!inputs.network.empty())
        return Error{Fault::usage, file.string() + ": a second network beside " + inputs.network.string() +
                                       "; journals end in .vedit"};
      inputs.network = file;
      continue;
    }
    auto journal = readJournal(file);
    if (!journal) return journal.error();
    inputs.edits.insert(inputs.edits.end(), std::make_move_iterator(journal->begin()),
                        std::make_move_iterator(journal->end()));
  }
  for (std::size_t i = 0; i < options.sets.size(); ++i) {
    auto edits = parseJournal(options.sets[i], "--set");
    if (!edits) return Error{Fault::usage, edits.error().message};
    for (Edit& edit : *edits) edit.line = std::uint32_t(i + 1), inputs.edits.push_back(std::move(edit));
  }
  if (inputs.network.empty()) {
    const auto folder = dataFolder();
    if (!folder) return folder.error();
    inputs.network = *folder / "human.vasa";
  }
  return inputs;
}

Report rowsOf(const Replay& replay) {
  Report rows = Report::array();
  for (const ReplayRow& row : replay.rows)
    rows.push_back({{"line", row.where},
                    {"operation", row.operation},
                    {"vessel", row.vessel},
                    {"applied", row.applied()},
                    {row.applied() ? "change" : "refusal", row.applied() ? row.change : row.refusal}});
  return rows;
}

// Who overlaps whom now that did not before, or is deeper in.
Report newOverlaps(const RestRepair& before, const RestRepair& after, const std::vector<VesselId>& origins) {
  Report list = Report::array();
  for (const RestOverlap& overlap : after.left) {
    const VesselId a = origins[overlap.first.value], b = origins[overlap.second.value];
    const auto same = std::ranges::find_if(before.left, [&](const RestOverlap& old) {
      return a.valid() && b.valid() &&
             ((old.first == a && old.second == b) || (old.first == b && old.second == a));
    });
    if (same != before.left.end() && overlap.depth <= same->depth + 1e-5f) continue;
    list.push_back(
        {{"vessels", {after.network.vessel(overlap.first).name, after.network.vessel(overlap.second).name}},
         {"depth_mm", 1e3 * overlap.depth},
         {"reason", reasonName(overlap.reason)}});
  }
  return list;
}

std::string asText(const Report& report) {
  std::string text;
  for (const Report& row : report["rows"])
    if (row["applied"].get<bool>())
      text += fmt::format("{}: {} of \"{}\": {}\n", plainText(row["line"]), plainText(row["operation"]),
                          plainText(row["vessel"]), plainText(row["change"]));
  text += fmt::format("{} of {} edits applied: {} vessels, {:.2f} m, {:.1f} ml\n",
                      report["applied"].get<std::size_t>(), report["edits"].get<std::size_t>(),
                      report["vessels"].get<std::size_t>(), report["length_m"].get<double>(),
                      1e6 * report["volume_m3"].get<double>());
  for (const Report& overlap : report["overlaps"])
    text += fmt::format("in the way: \"{}\" and \"{}\" overlap by {:.1f} mm; --part moves them apart\n",
                        plainText(overlap["vessels"][0]), plainText(overlap["vessels"][1]),
                        overlap["depth_mm"].get<double>());
  return text;
}

// With no edit, what was read is written: the same bytes.
Result<std::size_t> writeResult(const Options& options, const Inputs& inputs, const Network& network) {
  if (!inputs.edits.empty()) return writeNetwork(options.output, network, {.quantise = !options.exact});
  const auto bytes = readFile(inputs.network);
  if (!bytes) return bytes.error();
  if (auto written = writeFileAtomically(options.output, *bytes); !written) return written.error();
  return bytes->size();
}

Result<void> run(const Globals& globals, const Options& options) {
  if (!options.output.empty())
    if (auto writable = checkNetworkOutput(options.output); !writable) return writable.error();
  const auto inputs = readInputs(options);
  if (!inputs) return inputs.error();
  const auto network = readNetworkFile(inputs->network);
  if (!network) return network.error();
  Replay replay = replayEdits(*network, inputs->edits);
  checkpoint();
  std::string refusals;
  for (const ReplayRow& row : replay.rows)
    if (!row.applied()) refusals += (refusals.empty() ? "" : "\n") + row.refusal;
  const std::size_t refused = replay.rows.size() - replay.applied();
  Report report{{"edits", inputs->edits.size()},
                {"applied", replay.applied()},
                {"refused", refused},
                {"rows", rowsOf(replay)}};
  if (refused > 0 && !options.keepGoing) {
    if (globals.json)
      if (auto printed = printJson(report); !printed) return printed;
    return badInput(refusals +
                    "\nnothing was written; mend these lines, or add --keep-going to leave them out");
  }
  if (refused > 0) logWarning(refusals);
  const RestRepair before = overlapsAtRest(*network);
  RestRepair after = options.part ? separateAtRest(replay.network) : overlapsAtRest(replay.network);
  checkpoint();
  const auto bytes = writeResult(options, *inputs, after.network);
  if (!bytes) return bytes.error();
  const NetworkMeasures sum = measure(after.network, after.network.points());
  report["file"] = options.output;
  report["file_bytes"] = *bytes;
  report["vessels"] = after.network.vessels().size();
  report["sweeps"] = after.network.sweepCount();
  report["length_m"] = sum.length;
  report["volume_m3"] = sum.volume;
  report["overlaps"] = newOverlaps(before, after, replay.origins);
  if (options.part) addRestRepair(report, after);
  return globals.json ? printJson(report) : printText(asText(report));
}

}  // namespace edit_command

void addEdit(CLI::App& app, Command& command) {
  using namespace edit_command;
  auto options = std::make_shared<Options>();
  CLI::App* sub = app.add_subcommand(
      "edit", "Change vessels by a journal: stenosis, aneurysm, stent, graft, branch, cut and more");
  sub->footer(
      "Examples:\n"
      "  vasa edit body.vasa lesions.vedit -o edited.vasa\n"
      "  vasa edit --set 'stenosis \"left internal carotid artery\" 0.1 12 70' -o edited.vasa    (the built-in human)\n"
      "  vasa edit lesions.vedit --json -o edited.vasa\n"
      "vasa help edits lists the operations. The network that is read is not changed; without a line, its edit is undone.");
  sub->add_option("FILES", options->files,
                  "A network (.vasa; none: the built-in human's) and journals (.vedit), replayed in order");
  sub->add_option("--set", options->sets,
                  "One more operation, after the journals; may be given several times")
      ->take_all()
      ->allow_extra_args(false);
  sub->add_option("-o,--output", options->output, "The network to write (.vasa)")->required();
  sub->add_flag("--part", options->part,
                "Move apart what overlaps at rest, as convert does; thin what finds no room");
  sub->add_flag("--keep-going", options->keepGoing, "Leave refused lines out instead of writing nothing");
  sub->add_flag("--exact", options->exact, "Write 32-bit floats, 16 bytes a point");
  sub->callback(
      [options, &command] { command.run = [options, &command] { return run(command.globals, *options); }; });
}

}  // namespace vasa::cli
