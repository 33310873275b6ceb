#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "commands.h"
#include "core/atomic_file.h"
#include "core/cancellation.h"
#include "core/files_read.h"
#include "core/hash.h"
#include "core/log.h"
#include "core/visible.h"
#include "frame_output.h"
#include "gpu/device.h"
#include "gpu/error.h"
#include "io/csv.h"
#include "io/png.h"
#include "loading_line.h"
#include "output_folder.h"
#include "pose_pictures.h"
#include "realism/pose_map.h"
#include "report.h"
#include "scene/motion_track.h"
#include "scene_options.h"
#include "tissue_options.h"

// vasa poses: which poses kink, squeeze, stretch or press which vessel.
namespace vasa::cli {
namespace poses_command {

namespace fs = std::filesystem;

struct Options {
  SceneOptions scene;
  std::vector<std::string> joints, pair;
  std::string ranges, output, shard = "0/1";
  double step = 10, kink = 1, lumen = 50, strain = 40, depth = 1;
  TissueOptions tissue;
  bool resume = false;

  LoadLimits limits() const {
    return {float(kink), float(lumen / 100), float(strain / 100), float(depth / 1000)};
  }
};

constexpr std::size_t kLinesShown = 30;

bool hasWord(const JointRange& range, const std::string& word) {
  return range.name.find(word) != std::string::npos;
}

std::string namesOf(std::span<const JointRange> ranges) {
  std::string names;
  for (const JointRange& range : ranges) names += (names.empty() ? "" : ", ") + range.name;
  return names;
}

Result<JointRange> rangeCalled(std::span<const JointRange> ranges, const std::string& name) {
  const auto found = std::ranges::find(ranges, name, &JointRange::name);
  if (found != ranges.end()) return *found;
  return Error{Fault::usage, "--pair: no motion is called '" + name + "'; there are " + namesOf(ranges)};
}

Result<std::vector<PoseRay>> chooseRays(const Options& options) {
  fs::path table = options.ranges;
  if (table.empty()) {
    const auto data = dataFolder();
    if (!data) return data.error();
    table = *data / "realism" / "ranges.csv";
  }
  auto ranges = readJointRanges(table);
  if (!ranges) return ranges.error();
  if (!options.pair.empty()) {
    const auto held = rangeCalled(*ranges, options.pair[0]), turned = rangeCalled(*ranges, options.pair[1]);
    if (!held) return held.error();
    if (!turned) return turned.error();
    if (held->part == turned->part && held->motion == turned->motion)
      return Error{Fault::usage, "--pair: give two different motions"};
    return pairedRays(*held, *turned, glm::radians(float(options.step)));
  }
  if (options.joints.empty()) return singleRays(*ranges);
  std::vector<JointRange> chosen;
  for (const std::string& word : options.joints)
    if (std::ranges::none_of(*ranges, [&](const JointRange& range) { return hasWord(range, word); }))
      return Error{Fault::usage,
                   "--joints " + word + ": no motion has this in its name; there are " + namesOf(*ranges)};
  for (const JointRange& range : *ranges)
    if (std::ranges::any_of(options.joints, [&](const std::string& word) { return hasWord(range, word); }))
      chosen.push_back(range);
  return singleRays(chosen);
}

double inDegrees(float angle) { return std::round(100 * double(glm::degrees(angle))) / 100 + 0.0; }  // no -0

// What a ray's file holds: all that the map needs of it.
Report reportOf(const PoseRay& ray, const RayReport& walked, const Network& network) {
  Report joints{ray.range.name}, findings = Report::array(), steps = Report::array();
  if (ray.held) joints.push_back(ray.held->range.name);
  const auto angles = [&](float angle) {
    Report all{inDegrees(angle)};
    if (ray.held) all.push_back(inDegrees(ray.held->angle));
    return all;
  };
  for (const PoseFinding& finding : walked.findings)
    findings.push_back({{"vessel", network.vessel(finding.vessel).name},
                        {"place", finding.place},
                        {"joints", joints},
                        {"angles_deg", angles(finding.angle)},
                        {"kind", loadName(finding.kind)},
                        {"value", finding.value},
                        {"unit", loadUnit(finding.kind)},
                        {"from_deg", inDegrees(finding.from)},
                        {"severity", finding.severity}});
  for (const RayReport::Step& step : walked.steps) {
    steps.push_back({{"deg", inDegrees(step.angle)}, {"severity", step.severity}});
    if (step.vessel.valid())
      steps.back()["vessel"] = network.vessel(step.vessel).name, steps.back()["kind"] = loadName(step.kind);
  }
  return {{"ray", ray.name()},
          {"joints", joints},
          {"findings", findings},
          {"steps", steps},
          {"strains", walked.strains}};
}

// A ray's file, if it is there already, from the same run.
Result<std::optional<Report>> keptRay(const fs::path& file, const std::string& run) {
  std::error_code ignored;
  if (!fs::exists(file, ignored)) return std::optional<Report>();
  const auto bytes = readFile(file);
  if (!bytes) return bytes.error();
  const auto* text = reinterpret_cast<const char*>(bytes->data());
  Report kept = Report::parse(text, text + bytes->size(), nullptr, false);
  if (kept.is_discarded() || !kept.is_object() || kept.value("run", "") != run)
    return Error{Fault::resumeMismatch, file.string() +
                                            ": was made by another run (other scene, joints or settings), so "
                                            "--resume cannot go on from it; choose another folder"};
  return std::optional(std::move(kept));
}

class PoseWork {
 public:
  PoseWork(const Scene& scene, const Options& options, std::vector<PoseRay> rays, std::string run,
           Shard shard)
      : scene_(scene), options_(options), rays_(std::move(rays)), run_(std::move(run)), shard_(shard) {}

  // @return whether all rays are there, those of other shards too
  Result<bool> run() {
    ProgressLine progress("walking through poses");
    reports_.resize(rays_.size());
    std::optional<PoseMap> map;  // takes seconds, and a resumed run may need none
    for (std::size_t r = 0; r < rays_.size(); ++r) {
      checkpoint();
      progress.update(r + 1, rays_.size());
      const bool own = r % shard_.count == shard_.index;
      const fs::path file = options_.output.empty() ? fs::path() : fileOf(r);
      if (!file.empty() && (options_.resume || !own)) {
        auto kept = keptRay(file, run_);
        if (!kept && (own || kept.error().fault != Fault::resumeMismatch)) return kept.error();
        if (kept && *kept) {
          reports_[r] = std::move(**kept);
          continue;
        }
      }
      if (!own) continue;
      if (!map)
        map.emplace(scene_, FrameOptions{.keep = options_.tissue.kept(), .slide = !options_.tissue.noSlide},
                    options_.limits(), glm::radians(float(options_.step)));
      const auto walked = map->walk(rays_[r]);
      if (!walked) return walked.error();
      reports_[r] = reportOf(rays_[r], *walked, scene_.network);
      if (file.empty()) continue;
      Report kept{{"run", run_}};
      kept.update(reports_[r]);
      if (auto written = writeFileAtomically(file, kept.dump() + "\n"); !written) return written.error();
    }
    return std::ranges::none_of(reports_, [](const Report& report) { return report.is_null(); });
  }

  Report findings() const {
    std::vector<Report> all;
    for (const Report& ray : reports_) all.insert(all.end(), ray["findings"].begin(), ray["findings"].end());
    std::ranges::stable_sort(all, std::greater{},
                             [](const Report& f) { return f["severity"].get<double>(); });
    return all;
  }
  std::size_t rayCount() const { return rays_.size(); }
  std::size_t poseCount() const {
    std::size_t count = 0;
    for (const Report& ray : reports_) count += ray["steps"].size();
    return count;
  }
  std::size_t missing() const {
    return std::size_t(std::ranges::count_if(reports_, [](const Report& r) { return r.is_null(); }));
  }

  HeatMap heatMap() const {
    HeatMap map;
    const bool pair = rays_.front().held.has_value();
    map.title = pair ? "The worst that happens to a vessel: " + rays_.front().held->range.name +
                           " (rows) and " + rays_.front().range.name
                     : "The worst that happens to a vessel, one joint at a time";
    map.axis = pair ? rays_.front().range.name : "angle from rest";
    std::string last;
    for (std::size_t r = 0; r < rays_.size(); ++r) {
      const std::string name =
          pair ? fmt::format("{:.0f}°", inDegrees(rays_[r].held->angle)) : rays_[r].range.name;
      if (name != last) map.rows.push_back({name, {}});
      last = name;
      const Report& steps = reports_[r]["steps"];
      const auto at = [&](std::size_t i) { return steps[i]["deg"].get<float>(); };
      for (std::size_t i = 0; i < steps.size(); ++i) {
        const float before = i > 0 ? 0.5f * (at(i - 1) + at(i)) : at(i),
                    after = i + 1 < steps.size() ? 0.5f * (at(i) + at(i + 1)) : at(i);
        map.rows.back().cells.push_back(
            {std::min(before, after), std::max(before, after), steps[i]["severity"].get<float>()});
      }
    }
    return map;
  }

  std::vector<float> strains() const {
    std::vector<float> worst(scene_.network.vessels().size(), 0);
    for (const Report& ray : reports_)
      for (std::size_t v = 0; v < worst.size(); ++v)
        if (const float strain = ray["strains"][v].get<float>(); std::abs(strain) > std::abs(worst[v]))
          worst[v] = strain;
    return worst;
  }

 private:
  fs::path fileOf(std::size_t ray) const {
    return fs::path(options_.output) / "rays" / fmt::format("{:04}.json", ray);
  }

  const Scene& scene_;
  const Options& options_;
  std::vector<PoseRay> rays_;
  std::string run_;
  Shard shard_;
  std::vector<Report> reports_;
};

std::string asCsv(const Report& findings) {
  std::string text = "vessel,kind,value,unit,place,joint,angle_deg,held_joint,held_deg,from_deg,severity\n";
  for (const Report& f : findings) {
    const bool held = f["joints"].size() > 1;
    text += fmt::format("{},{},{:.4g},{},{:.4f},{},{:g},{},{},{:g},{:.3f}\n",
                        csv::cell(f["vessel"].get<std::string>()), f["kind"].get<std::string>(),
                        f["value"].get<double>(), f["unit"].get<std::string>(), f["place"].get<double>(),
                        csv::cell(f["joints"][0].get<std::string>()), f["angles_deg"][0].get<double>(),
                        held ? csv::cell(f["joints"][1].get<std::string>()) : "",
                        held ? fmt::format("{:g}", f["angles_deg"][1].get<double>()) : "",
                        f["from_deg"].get<double>(), f["severity"].get<double>());
  }
  return text;
}

std::string asText(const Report& report) {
  std::string text;
  const Report& findings = report["findings"];
  for (std::size_t i = 0; i < std::min(findings.size(), kLinesShown); ++i) {
    const Report& f = findings[i];
    std::string pose =
        fmt::format("{} {:.0f}°", f["joints"][0].get<std::string>(), f["angles_deg"][0].get<double>());
    if (f["joints"].size() > 1)
      pose +=
          fmt::format(", {} {:.0f}°", f["joints"][1].get<std::string>(), f["angles_deg"][1].get<double>());
    text += fmt::format("{:<40} {:<10} {:>8.3g} {:<26} from {:>4.0f}°, worst at {}\n", plainText(f["vessel"]),
                        f["kind"].get<std::string>(), f["value"].get<double>(), f["unit"].get<std::string>(),
                        f["from_deg"].get<double>(), pose);
  }
  if (findings.size() > kLinesShown)
    text += fmt::format("and {} more: --json or -o FOLDER have them all\n", findings.size() - kLinesShown);
  return text + fmt::format("{} poses of {} motions looked at: {} findings\n",
                            report["poses"].get<std::size_t>(), report["rays"].get<std::size_t>(),
                            findings.size());
}

Result<void> writePictures(const PoseWork& work, const Scene& scene, const Globals& globals,
                           const Options& options) {
  const fs::path folder = options.output;
  const auto heat = drawHeatMap(work.heatMap());
  if (!heat) return heat.error();
  if (auto written = writePng(folder / "poses.png", *heat); !written) return written;
  auto strains = gpu::attempt([&]() -> Result<Image> {
    gpu::Device device({.choice = globals.device});
    return drawStrains(scene, work.strains(), float(options.strain / 100), device);
  });
  if (!strains) return strains.error();
  if (!*strains) return strains->error();
  return writePng(folder / "strain.png", **strains);
}

Result<void> run(const Globals& globals, const Options& options) {
  const auto shard = parseShard(options.shard);
  if (!shard) return shard.error();
  if (options.output.empty() && (shard->count > 1 || options.resume))
    return Error{Fault::usage, "--shard and --resume need a folder to work in; give -o FOLDER"};
  if (auto checked = checkOutputFolder(options.output); !checked) return checked;
  const FilesRead files;
  auto rays = chooseRays(options);
  if (!rays) return rays.error();
  const auto file = chooseScene(options.scene);
  if (!file) return file.error();
  if (file->body.empty())
    return Error{Fault::usage, options.scene.scene + ": vessels alone have no poses; add --body FILE.glb"};
  LoadingLine line;
  const auto scene = loadScene(*file, line.told());
  if (!scene) return scene.error();
  if (const auto clip = clipOf(scene->body, *file); !clip) return clip.error();
  std::string settings;
  for (const PoseRay& ray : *rays) settings += ray.name() + "|";
  settings +=
      fmt::format("{} {} {} {} {} {} {} {} {:016x} {:016x}", kMotionEdition, options.step, options.kink,
                  options.lumen, options.strain, options.depth, int(options.tissue.kept()),
                  options.tissue.noSlide, files.hash(), hashOf(scene->network.points()));
  const fs::path folder = options.output;
  if (!options.output.empty()) {
    if (auto made = makeOutputFolder(folder); !made) return made;
    if (auto made = makeOutputFolder(folder / "rays"); !made) return made;
  }
  PoseWork work(*scene, options, std::move(*rays),
                fmt::format("{:016x}", hashOf(std::span(std::as_const(settings)))), *shard);
  const auto complete = work.run();
  if (!complete) return complete.error();
  if (!*complete) {
    logInfo(fmt::format(
        "this share is done; {} motions of other shares are not there yet, and the last to end writes the map",
        work.missing()));
    return globals.json ? printJson({{"complete", false}, {"missing", work.missing()}}) : Result<void>();
  }
  const Report report{{"complete", true},
                      {"body", scene->body.name},
                      {"vessels", file->networks.front().filename().string()},
                      {"step_deg", options.step},
                      {"limits",
                       {{"kink", options.kink},
                        {"lumen_percent", options.lumen},
                        {"strain_percent", options.strain},
                        {"depth_mm", options.depth}}},
                      {"rays", work.rayCount()},
                      {"poses", work.poseCount()},
                      {"findings", work.findings()}};
  if (!options.output.empty()) {
    if (auto written = writeFileAtomically(folder / "poses.json", report.dump(2) + "\n"); !written)
      return written;
    if (auto written = writeFileAtomically(folder / "poses.csv", asCsv(report["findings"])); !written)
      return written;
    if (auto written = writePictures(work, *scene, globals, options); !written) return written;
  }
  return globals.json ? printJson(report) : printText(asText(report));
}

}  // namespace poses_command

void addPoses(CLI::App& app, Command& command) {
  using namespace poses_command;
  auto options = std::make_shared<Options>();
  CLI::App* sub = app.add_subcommand("poses", "Which poses kink, squeeze, stretch or press which vessel");
  sub->footer(
      "Examples:\n"
      "  vasa poses -o poses\n"
      "  vasa poses --joints knee elbow --strain 25\n"
      "  vasa poses --pair 'left hip flexion' 'left knee flexion' -o squat\n"
      "  vasa poses -o poses --shard 0/4 --resume   (and 1/4, 2/4, 3/4 elsewhere: the last one writes the map)\n"
      "Every joint is turned from rest to both ends of its range, one at a time or two, and vessels slide and keep apart as\n"
      "in any motion. A finding is a load beyond its limit: a kink (radius by bending radius), a squeeze (share of the area\n"
      "at rest), a stretch or shortening of the whole vessel, a bone that it is pressed into. from_deg: the first angle at\n"
      "which it is beyond; angles_deg and value: where it is worst; place: the share of the vessel there; severity: by how\n"
      "much. The folder gets poses.json, poses.csv, poses.png (severity over the angles) and strain.png (each vessel in\n"
      "the colour of its largest strain). Ranges of healthy joints: data/realism/ranges.csv.");
  addSceneOptions(*sub, options->scene);
  sub->add_option("--joints", options->joints,
                  "Only motions with one of these words in their name, for example knee");
  sub->add_option("--pair", options->pair,
                  "Two motions at a time: the first is held at each angle, the second turned")
      ->expected(2)
      ->excludes("--joints");
  sub->add_option("--ranges", options->ranges, "Table of joints' ranges (default: what ships)");
  sub->add_option("--step", options->step, "[degrees] between poses")
      ->check(CLI::Range(1.0, 45.0))
      ->capture_default_str();
  sub->add_option("--kink", options->kink, "Limit of radius by bending radius")
      ->check(CLI::Range(0.1, 10.0))
      ->capture_default_str();
  sub->add_option("--lumen", options->lumen, "[%] limit of the area, by that at rest")
      ->check(CLI::Range(1.0, 99.0))
      ->capture_default_str();
  sub->add_option("--strain", options->strain, "[%] limit of a vessel's change of length")
      ->check(CLI::Range(1.0, 500.0))
      ->capture_default_str();
  sub->add_option("--depth", options->depth, "[mm] limit of a vessel's way into a bone")
      ->check(CLI::Range(0.01, 50.0))
      ->capture_default_str();
  sub->add_option("-o,--output", options->output, "Folder for the map");
  sub->add_option("--shard", options->shard, "i/n: walk only every n-th way, from the i-th on")
      ->capture_default_str();
  sub->add_flag("--resume", options->resume, "Keep what the folder has from the same run");
  addTissueOptions(*sub, options->tissue);
  sub->callback(
      [options, &command] { command.run = [options, &command] { return run(command.globals, *options); }; });
}

}  // namespace vasa::cli
