#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "collide/paper_detector.h"
#include "collide/tube_detector.h"
#include "collide/tube_list.h"
#include "commands.h"
#include "core/cancellation.h"
#include "core/clock.h"
#include "core/parallel.h"
#include "report.h"

// vasa bench collide: interference detection alone, on a plain list of tubes. The same pose timed again and
// again would flatter (its memory accesses and branches are learnt by heart), so each timed run has a shape
// of its own, near the pose asked for.
namespace vasa::cli {
namespace bench_command {

struct Options {
  std::string tubes, pairs, method = "exact";
  int pose = 0;
  int runs = 31;
  float tolerance = 1e-3f;
};

struct Timings {
  std::vector<double> update, detect;  // [ms]
};

double median(std::vector<double> values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

double least(const std::vector<double>& values) {
  return values.empty() ? 0 : *std::min_element(values.begin(), values.end());
}

// Shares of the way to the other pose: 0 for the answer, then up to a quarter, no two alike (the detector
// knows what has not moved).
float shareOf(int run, int pose) {
  const float away = 0.125f * (1 - std::cos(2.4f * float(run)));
  return pose == 0 ? away : 1 - away;
}

template <class Detector>
Result<Timings> timeRuns(Detector& detector, const TubeList& list, const Options& options) {
  constexpr int kWarmUp = 3;
  Timings timings;
  LargeVector<Bezier> shape;
  for (int run = -kWarmUp; run < options.runs; ++run) {
    checkpoint();
    list.blend(shareOf(run, options.pose), shape);
    const auto start = Clock::now();
    detector.update(shape);
    const double update = msSince(start);
    const auto middle = Clock::now();
    detector.detect();
    const double detect = msSince(middle);
    if (run < 0) continue;
    timings.update.push_back(update);
    timings.detect.push_back(detect);
  }
  return timings;
}

template <class Detector>
Result<Report> measure(Detector& detector, std::size_t treeBytes, unsigned threads, const TubeList& list,
                       const Exclusions& exclusions, const Options& options) {
  const auto timings = timeRuns(detector, list, options);
  if (!timings) return timings.error();
  detector.update(list.poses[std::size_t(options.pose)]);
  const std::span<const TubePair> pairs = detector.detect();
  if (!options.pairs.empty())
    if (auto written = writePairs(options.pairs, pairs); !written) return written.error();
  return Report{{"tubes", list.poses[0].size()},
                {"pairs", pairs.size()},
                {"excluded", exclusions.pairCount()},
                {"update_ms", median(timings->update)},
                {"detect_ms", median(timings->detect)},
                {"update_min_ms", least(timings->update)},
                {"detect_min_ms", least(timings->detect)},
                {"threads", threads},
                {"tree_bytes", treeBytes},
                {"method", options.method},
                {"pose", options.pose},
                {"runs", options.runs}};
}

Result<Report> measure(const TubeList& list, const Options& options) {
  const std::vector<Bezier>& rest = list.poses[0];
  const Exclusions exclusions(std::uint32_t(rest.size()), list.excluded);
  if (options.method == "paper") {
    PaperDetector detector(rest, exclusions, options.tolerance);
    return measure(detector, detector.tree().bytes(), 1, list, exclusions, options);
  }
  TubeDetector detector(rest, exclusions);
  return measure(detector, detector.treeBytes(), threadCount(), list, exclusions, options);
}

std::string asText(const Report& report) {
  return fmt::format(
      "{} tubes, pose {}, method {}, threads {}\n{} intersecting pairs, {} excluded\n"
      "update {:.3f} ms (least {:.3f}), detect {:.3f} ms (least {:.3f}), medians of {} runs\ntree {} bytes\n",
      report["tubes"].get<std::size_t>(), report["pose"].get<int>(), report["method"].get<std::string>(),
      report["threads"].get<unsigned>(), report["pairs"].get<std::size_t>(),
      report["excluded"].get<std::size_t>(), report["update_ms"].get<double>(),
      report["update_min_ms"].get<double>(), report["detect_ms"].get<double>(),
      report["detect_min_ms"].get<double>(), report["runs"].get<int>(),
      report["tree_bytes"].get<std::size_t>());
}

Result<void> run(const Globals& globals, const Options& options) {
  if (options.pairs == "-")
    return Error{Fault::usage, "--pairs -: standard output has the times; name a file"};
  const auto list = readTubeList(options.tubes);
  if (!list) return list.error();
  const auto report = measure(*list, options);
  if (!report) return report.error();
  return globals.json ? printJson(*report) : printText(asText(*report));
}

}  // namespace bench_command

void addBench(CLI::App& app, Command& command) {
  using namespace bench_command;
  auto options = std::make_shared<Options>();
  CLI::App* bench = app.add_subcommand("bench", "Time one part of the program alone");
  bench->require_subcommand(1);
  CLI::App* sub = bench->add_subcommand("collide", "Interference detection on a plain tube list");
  sub->footer(
      "Examples:\n  vasa bench collide --tubes tubes.txt --json\n"
      "  vasa bench collide --tubes tubes.txt --pose 1 --method paper --threads 1\n"
      "  vasa bench collide --tubes tubes.txt --pairs pairs.txt\n"
      "A tube list: `n m`; n lines of 4 control points x y z r in pose 0, then in pose 1; m lines `i j`, "
      "pairs that\n"
      "share an end. Timed runs are of shapes between the two poses, all different, near the one asked for.");
  sub->add_option("--tubes", options->tubes, "The tube list")->required();
  sub->add_option("--pose", options->pose, "Which of the two poses")
      ->check(CLI::IsMember({0, 1}))
      ->capture_default_str();
  sub->add_option("--method", options->method,
                  "exact, or paper: the source paper's, which over-reports; one thread")
      ->check(CLI::IsMember({"exact", "paper"}))
      ->capture_default_str();
  sub->add_option("--tolerance", options->tolerance, "The paper's tolerance; smaller decides more precisely")
      ->check(CLI::Range(1e-7f, 1.0f))
      ->capture_default_str();
  sub->add_option("--runs", options->runs, "Timed runs")->check(CLI::Range(1, 100000))->capture_default_str();
  sub->add_option("--pairs", options->pairs, "Write the pairs here, a line `i j` a pair");
  sub->callback(
      [options, &command] { command.run = [options, &command] { return run(command.globals, *options); }; });
}

}  // namespace vasa::cli
