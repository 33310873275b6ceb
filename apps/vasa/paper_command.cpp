#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <iterator>

#include "capillary_options.h"
#include "commands.h"
#include "core/atomic_file.h"
#include "core/log.h"
#include "core/parallel.h"
#include "gpu/error.h"
#include "output_folder.h"
#include "paper_page.h"
#include "scene/vessel_files.h"
#include "scene_options.h"

// vasa paper: what the source paper prints, made by this program, beside the paper's own numbers.
namespace vasa::cli {
namespace paper_command {

struct Options {
  SceneOptions scene;
  std::vector<std::string> meshes;
  std::string output, size = "1280x720";
  bool quick = false;
};

constexpr std::array kFigures{wholeBodyFigure, conversionFigure, brainFigure, junctionFigure,
                              capillaryFigure, hierarchyFigure,  clipFigure};

// The surfaces that the network was converted from, where they are known.
Result<std::vector<SourceElement>> givenMeshes(const Options& options, const SceneFile& choice) {
  std::vector<std::filesystem::path> files(options.meshes.begin(), options.meshes.end());
  if (files.empty()) std::ranges::copy_if(choice.networks, std::back_inserter(files), holdsSurfaces);
  std::vector<SourceElement> elements;
  for (const auto& file : files) {
    auto read = readSurfaces(file);
    if (!read) return read.error();
    std::ranges::move(*read, std::back_inserter(elements));
  }
  return elements;
}

// A walk if there is one, or the first.
std::string ownClip(const Body& body) {
  if (const auto walk = findClip(body, "walk"); walk) return (*walk)->name;
  return body.clips.empty() ? "" : body.clips.front().name;
}

Result<void> prepare(const Globals& globals, const Options& options, PaperStudy& study) {
  const auto size = parseSize(options.size);
  if (!size) return size.error();
  study.size = *size;
  study.quick = options.quick;
  study.seed = std::uint32_t(globals.seed);
  auto choice = chooseScene(options.scene);
  if (!choice) return choice.error();
  auto meshes = givenMeshes(options, *choice);
  if (!meshes) return meshes.error();
  auto scene = loadScene(*choice);
  if (!scene) return scene.error();
  study.scene = std::move(*scene);
  study.meshesGiven = !meshes->empty();
  study.meshes = study.meshesGiven ? std::move(*meshes) : meshesOf(study.scene.network);
  if (choice->clip.empty()) choice->clip = ownClip(study.scene.body);
  clearLimbs(*choice, study.scene.body, study.scene.body.clips);
  const auto clip = findClip(study.scene.body, choice->clip);
  if (!clip && !choice->clip.empty()) return clip.error();
  study.clip = clip ? *clip : nullptr;
  study.table = makeSweepTable(study.scene.network);
  CapillaryChoice capillaries = choice->capillaries;
  capillaries.levels = std::max(1u, capillaries.levels);
  auto growth = growthOf(study.scene, capillaries, study.table);
  if (!growth) return growth.error();
  study.growth = std::move(**growth);
  auto camera =
      CameraMan::create(choice->camera, study.scene, study.clip, float(size->width) / float(size->height));
  if (!camera) return camera.error();
  study.camera = std::move(*camera);
  return {};
}

Report notes(const PaperStudy& study) {
  return {
      {"table1",
       study.meshesGiven
           ? "Mesh: the surfaces that the network was converted from; 12 bytes a vertex, 12 a triangle."
           : "Mesh: the network with a ring of eight vertices at each section, as the paper's model has; 12 bytes a vertex, 12 a triangle. "
             "Totals hold vessels of other kinds, too."},
      {"table2",
       "One thread; medians over poses of the motion before vessels are moved apart; pairs that run through one another, of all poses together, neighbours along the "
       "network left out. Hierarchies of boxes are binary trees of single precision down to one triangle, without the mesh; refit is without tessellation. Triangles of "
       "4x4 to 8x10 tubes cross less often than round tubes meet, those of the mesh, as long as a sweep, cut across bends, and the sphere tree's method reports pairs that miss by up to its tolerance. The paper's "
       "figures are PQP's, of which those of the original mesh are given in its text."},
      {"table3",
       "render: a picture; collision: keeping volumes, detection, moving apart, certifying; total: a frame from pose to picture, one stage after the other; "
       "frames/s: from picture to picture, the next pose being solved beside the drawing. Medians. Every triangle: drawn as the paper does, without leaving out what cannot be seen."}};
}

struct Made {
  Report report;
  std::vector<PaperFigure> figures;
};

Result<Made> make(const PaperStudy& study, gpu::Device& device) {
  Made made{{{"device", device.adapter().name},
             {"threads", threadCount()},
             {"quick", study.quick},
             {"size", fmt::format("{}x{}", study.size.width, study.size.height)},
             {"clip", study.clip ? study.clip->name : "rest"},
             {"vessels", fmt::format("{} vessels of {} sweeps", study.scene.network.vessels().size(),
                                     study.scene.network.sweepCount())},
             {"notes", notes(study)}},
            {}};
  // First what is timed, before the machine is warm.
  logDetail("tables I and II");
  made.report["table1"] = storageTable(study);
  auto hierarchies = hierarchyTable(study);
  if (!hierarchies) return hierarchies.error();
  made.report["table2"] = std::move(*hierarchies);
  logDetail("table III");
  auto rates = frameRateTable(study, device);
  if (!rates) return rates.error();
  made.report["table3"] = std::move(*rates);
  ProgressLine progress("figures");
  made.report["figures"] = Report::array();
  for (std::size_t i = 0; i < kFigures.size(); ++i) {
    logDetail(fmt::format("figure {}", i + 1));
    auto figure = kFigures[i](study, device);
    if (!figure) return figure.error();
    Report panels = Report::array();
    for (const PaperFigure::Panel& panel : figure->panels) panels.push_back(panel.caption);
    made.report["figures"].push_back(
        {{"figure", i + 1}, {"caption", figure->caption}, {"panels", panels}, {"facts", figure->facts}});
    made.figures.push_back(std::move(*figure));
    progress.update(i + 1, kFigures.size());
  }
  return made;
}

Result<void> write(const std::filesystem::path& folder, const Made& made) {
  const auto page = paperPage(made.report, made.figures);
  if (!page) return page.error();
  if (auto written = writeFileAtomically(folder / "report.json", made.report.dump(2) + "\n"); !written)
    return written;
  return writeFileAtomically(folder / "index.html", *page);
}

Result<void> run(const Globals& globals, const Options& options) {
  const auto start = std::chrono::steady_clock::now();
  PaperStudy study;
  if (auto prepared = prepare(globals, options, study); !prepared) return prepared;
  if (auto folder = makeOutputFolder(options.output); !folder) return folder;
  auto made = gpu::attempt([&]() -> Result<Made> {
    gpu::Device device({.choice = globals.device});
    return make(study, device);
  });
  if (!made) return made.error();
  if (!*made) return made->error();
  Made& all = **made;
  all.report["seconds"] = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  if (auto written = write(options.output, all); !written) return written;
  if (globals.json) return printJson(all.report);
  logInfo(fmt::format("{}/index.html and report.json in {:.0f} s", options.output,
                      all.report["seconds"].get<double>()));
  return {};
}

}  // namespace paper_command

void addPaper(CLI::App& app, Command& command) {
  using namespace paper_command;
  auto options = std::make_shared<Options>();
  CLI::App* sub =
      app.add_subcommand("paper", "The source paper's tables and figures, beside its own numbers, as a page");
  sub->footer(
      "Examples:\n"
      "  vasa paper -o paper\n"
      "  vasa paper -o paper --quick\n"
      "  vasa paper --body b.glb --network b.vasa --mesh arteries.glb veins.glb -o paper\n"
      "Writes index.html, which needs no other file, and report.json: table1, table2 and table3, whose rows have ours and\n"
      "paper, and what the figures show. Figures are drawn from the network: the junctions are its thickest, the clips those\n"
      "that move the body most.");
  addSceneOptions(*sub, options->scene);
  sub->add_option("-o,--output", options->output, "The folder to write to")->required();
  sub->add_option(
      "--mesh", options->meshes,
      "Surfaces that the network was converted from (.glb, .obj, .stl), for Table I and Figure 2 (default: the network's\n"
      "own, eight vertices a section)");
  sub->add_option("--size", options->size,
                  "Size of Table III's pictures in pixels; figures are scaled with its height")
      ->capture_default_str();
  sub->add_flag("--quick", options->quick,
                "Fewer frames and coarser pictures: in two minutes instead of ten");
  sub->callback(
      [options, &command] { command.run = [options, &command] { return run(command.globals, *options); }; });
}

}  // namespace vasa::cli
