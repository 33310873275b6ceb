#include <fmt/format.h>

#include <filesystem>

#include "commands.h"
#include "core/atomic_file.h"
#include "core/log.h"
#include "core/visible.h"
#include "loading_line.h"
#include "output_folder.h"
#include "realism_page.h"
#include "report.h"
#include "scene_options.h"
#include "tissue_options.h"

// vasa realism: the deformation beside figures that were measured in living people and cadavers.
namespace vasa::cli {
namespace realism_command {

struct Options {
  SceneOptions scene;
  std::string protocol, output;
  double least = 0;
  TissueOptions tissue;
};

Report scoreReport(const RealismScore& score) {
  return {{"usable", score.usable}, {"signed", score.signed_},        {"right_sign", score.rightSign},
          {"banded", score.banded}, {"within_1_sd", score.withinOne}, {"within_2_sd", score.withinTwo}};
}

template <class T>
Report orNull(const std::optional<T>& value) {
  return value ? Report(*value) : Report(nullptr);
}

Report rowReport(const ProtocolRow& row, const ProtocolResult& result) {
  Report report{{"id", row.id},
                {"from", row.from},
                {"to", row.to},
                {"first_share", row.firstShare},
                {"last_share", row.lastShare},
                {"from_pose", row.firstPose},
                {"to_pose", row.lastPose},
                {"metric", metricName(row.metric)},
                {"unit", unitOf(row.metric)},
                {"mean", row.mean},
                {"sd", orNull(row.deviation)},
                {"low", orNull(row.low)},
                {"high", orNull(row.high)},
                {"blind", row.blind},
                {"used_in_tuning", !row.blind},
                {"source", row.source}};
  if (!result.refusal.empty()) {
    report["refusal"] = result.refusal;
    return report;
  }
  report["ours"] = result.ours;
  report["on_the_way"] = result.onTheWay;
  report["right_sign"] = report["sign_ok"] = orNull(result.rightSign);
  report["deviations"] = orNull(result.deviations);
  report["within_1sd"] = result.deviations ? Report(result.within(1)) : Report(nullptr);
  report["within_2sd"] = result.deviations ? Report(result.within(2)) : Report(nullptr);
  return report;
}

Report reportOf(const Scene& scene, const SceneFile& file, const Protocol& protocol,
                const RealismStudy& study) {
  Report report{{"body", scene.body.name},           {"vessels", file.networks.front().filename().string()},
                {"score", scoreReport(study.tuned)}, {"blind", scoreReport(study.blind)},
                {"rows", Report::array()},           {"curves", Report::array()}};
  // Of all rows, as programs ask for it.
  const RealismScore &tuned = study.tuned, &blind = study.blind;
  report["usable"] = tuned.usable + blind.usable;
  report["sign_ok"] = tuned.rightSign + blind.rightSign;
  report["within_1sd"] = tuned.withinOne + blind.withinOne;
  report["within_2sd"] = tuned.withinTwo + blind.withinTwo;
  for (std::size_t i = 0; i < protocol.rows.size(); ++i)
    report["rows"].push_back(rowReport(protocol.rows[i], study.results[i]));
  for (std::size_t i = 0; i < protocol.sweeps.size(); ++i) {
    const ProtocolSweep& sweep = protocol.sweeps[i];
    Report curve{{"sweep", sweep.name},
                 {"metric", metricName(sweep.metric)},
                 {"degrees", study.curves[i].degrees},
                 {"values", study.curves[i].values}};
    if (!study.curves[i].refusal.empty()) curve["refusal"] = study.curves[i].refusal;
    report["curves"].push_back(std::move(curve));
  }
  return report;
}

std::string asText(const Report& report) {
  std::string text;
  for (const Report& row : report["rows"]) {
    const std::string name = fmt::format("{:<6}{:<30}{:<17}", row["id"].get<std::string>(),
                                         row["metric"].get<std::string>(), row["to_pose"].get<std::string>());
    if (row.contains("refusal")) {
      text += name + visible(row["refusal"].get<std::string>()) + "\n";
      continue;
    }
    text += fmt::format("{}{:>9.2f}  published {:>7.2f}", name, row["ours"].get<double>(),
                        row["mean"].get<double>());
    if (row["sd"].is_number())
      text += fmt::format(" +- {:g}", row["sd"].get<double>());
    else if (row["low"].is_number())
      text += fmt::format(" ({:g} to {:g})", row["low"].get<double>(), row["high"].get<double>());
    if (row["deviations"].is_number()) text += fmt::format("  {:+.1f} SD", row["deviations"].get<double>());
    if (row["right_sign"].is_boolean() && !row["right_sign"].get<bool>()) text += "  wrong direction";
    text += row["blind"].get<bool>() ? "  blind\n" : "\n";
  }
  for (const char* part : {"score", "blind"})
    text +=
        fmt::format("{:<6} usable {}, right direction {} of {}, within 1 SD {} of {}, within 2 SD {} of {}\n",
                    part, report[part]["usable"].get<int>(), report[part]["right_sign"].get<int>(),
                    report[part]["signed"].get<int>(), report[part]["within_1_sd"].get<int>(),
                    report[part]["banded"].get<int>(), report[part]["within_2_sd"].get<int>(),
                    report[part]["banded"].get<int>());
  return text;
}

Result<void> run(const Globals& globals, const Options& options) {
  std::filesystem::path folder = options.protocol;
  if (folder.empty()) {
    const auto data = dataFolder();
    if (!data) return data.error();
    folder = *data / "realism";
  }
  const auto protocol = readProtocol(folder);
  if (!protocol) return protocol.error();
  const auto file = chooseScene(options.scene);
  if (!file) return file.error();
  if (!options.output.empty())
    if (auto made = makeOutputFolder(options.output); !made) return made;
  const auto scene = loadScene(*file);
  if (!scene) return scene.error();
  if (const auto clip = clipOf(scene->body, *file); !clip) return clip.error();
  const RealismStudy study = studyRealism(
      *scene, *protocol, {.keep = options.tissue.kept(), .slide = !options.tissue.noSlide, .avoid = true});
  const Report report = reportOf(*scene, *file, *protocol, study);
  if (!options.output.empty()) {
    const std::filesystem::path out = options.output;
    if (auto written = writeFileAtomically(out / "report.json", report.dump(2) + "\n"); !written)
      return written;
    if (auto written = writeFileAtomically(out / "index.html", realismPage(*protocol, study, report));
        !written)
      return written;
  }
  if (auto printed = globals.json ? printJson(report) : printText(asText(report)); !printed) return printed;
  const double share = study.tuned.banded ? double(study.tuned.withinTwo) / study.tuned.banded : 0;
  if (share < options.least)
    return Error{
        Fault::failed,
        fmt::format("{:.0f} % of the figures lie within two standard deviations; --least asks for {:.0f} %",
                    100 * share, 100 * options.least)};
  return {};
}

}  // namespace realism_command

void addRealism(CLI::App& app, Command& command) {
  using namespace realism_command;
  auto options = std::make_shared<Options>();
  CLI::App* sub =
      app.add_subcommand("realism", "How vessels change with the pose, beside figures measured in people");
  sub->footer(
      "Examples:\n"
      "  vasa realism -o realism\n"
      "  vasa realism --body b.glb --network b.vasa --json --least 0.8\n"
      "A row is a published figure: a stretch of vessels between two landmarks, two poses, a metric, mean and standard\n"
      "deviation (or the range that was seen). The scene is posed so, with vessels kept apart; what is on the left is\n"
      "taken on the right, too, and ours is the mean. right_sign: it changes in the published direction. deviations:\n"
      "how far ours is from the mean, in standard deviations; a range counts as four of them. on_the_way: ours at a\n"
      "quarter, half, three quarters and all of the way to the pose, for abstracts give no angles. Figures marked blind\n"
      "were not looked at while the model was tuned, and are counted apart. The tables are data/realism.");
  addSceneOptions(*sub, options->scene);
  sub->add_option("--protocol", options->protocol,
                  "Folder with poses.csv, protocol.csv and sweeps.csv (default: what ships)");
  sub->add_option("-o,--output", options->output, "Folder for index.html and report.json");
  sub->add_option("--least", options->least,
                  "End with 1 where less than this share of the figures is within two standard deviations")
      ->check(CLI::Range(0.0, 1.0));
  addTissueOptions(*sub, options->tissue);
  sub->callback(
      [options, &command] { command.run = [options, &command] { return run(command.globals, *options); }; });
}

}  // namespace vasa::cli
