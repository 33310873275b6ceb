#include <fmt/format.h>

#include "capillary_options.h"
#include "commands.h"
#include "core/cancellation.h"
#include "core/kept.h"
#include "core/log.h"
#include "core/stage_log.h"
#include "kept_folders.h"
#include "loading_line.h"
#include "render/mesh_levels.h"
#include "report.h"
#include "scene/frame.h"
#include "scene_options.h"

// vasa prepare: what takes long to make of a body and stays the same, made beforehand.
namespace vasa::cli {
namespace prepare_command {

struct Options {
  SceneOptions scene;
  std::string output;
};

// Where its motions bring vessels near bones: a first look at a place takes long (solids/bones.h).
void solveAll(Scene& scene, const SceneFile& file, const ReadingProgress& told) {
  clearLimbs(file, scene.body, scene.body.clips);
  FrameMaker frames(scene,
                    {.avoid = true, .track = std::make_shared<MotionTrack>(MotionTrack::Keeps::latest)});
  std::size_t done = 0, count = 0;
  for (const Clip& clip : scene.body.clips) count += clip.frameCount();
  for (const Clip& clip : scene.body.clips)
    for (std::uint32_t frame = 0; frame < clip.frameCount(); ++frame) {
      checkpoint();
      told("preparing motions", done++, count);
      frames.make(&clip, clip.timeOfFrame(frame));
    }
}

Result<void> makeAll(Scene& scene, const SceneFile& file, const ReadingProgress& told) {
  StageLog stages("levels of detail");
  bodyLevels(scene.body.meshes, &scene.body.skeleton);
  stages.next("beds of capillaries");
  CapillaryChoice capillaries = file.capillaries;
  capillaries.levels = 1;  // any
  if (const auto growth = growthOf(scene, capillaries); !growth) return growth.error();
  stages.next("distance fields of bones");
  solveAll(scene, file, told);
  return keptAll();
}

Result<void> run(const Globals& globals, const Options& options) {
  if (globals.noCache)
    return Error{Fault::usage,
                 "--no-cache keeps nothing, and prepare makes what is kept; leave --no-cache out, or give -o "
                 "FOLDER instead to keep it elsewhere"};
  auto choice = chooseScene(options.scene);
  if (!choice) return choice.error();
  const std::filesystem::path folder =
      options.output.empty() ? cacheFolder() : std::filesystem::path(options.output);
  if (folder.empty())
    return Error{Fault::usage,
                 "no folder to keep anything in: set HOME or XDG_CACHE_HOME, or give -o FOLDER"};
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error)
    return ioError(folder.string() + ": cannot make the folder: " + error.message() +
                   "; choose one that you may write to");
  KeptFolders folders = keptFolders(folder);
  folders.shipped.clear();  // all of it in one place
  setKeptFolders(folders);
  std::optional<LoadingLine> line(std::in_place);
  auto scene = loadScene(*choice, line->told());
  if (!scene) return scene.error();
  if (const auto clip = clipOf(scene->body, *choice); !clip) return clip.error();
  (*line)("preparing");
  if (auto made = makeAll(*scene, *choice, line->told()); !made) return made;
  line.reset();
  std::uintmax_t bytes = 0;
  for (const auto& file : std::filesystem::directory_iterator(folder, error))
    if (file.path().extension() == ".kept") bytes += file.file_size(error);
  if (globals.json) return printJson({{"folder", folder.string()}, {"bytes", bytes}});
  logInfo(fmt::format("{}: {:.1f} MB kept for later runs", folder.string(), double(bytes) / 1e6));
  return {};
}

}  // namespace prepare_command

void addPrepare(CLI::App& app, Command& command) {
  using namespace prepare_command;
  auto options = std::make_shared<Options>();
  CLI::App* sub = app.add_subcommand("prepare", "Make beforehand what takes long at a body's first use");
  sub->footer(
      "Levels of detail of skin, bones and organs, distance fields of the bones wherever the body's motions bring vessels,\n"
      "how vessels hang on the body and where they join, beds of capillaries.\n"
      "Commands that need them make and keep them by themselves, in $XDG_CACHE_HOME/vasa (~/.cache/vasa), 512 MiB at\n"
      "most; --no-cache does without. Those of the built-in human come with the program.\n\n"
      "Examples:\n"
      "  vasa prepare --body body.glb --network body.vasa");
  addSceneOptions(*sub, options->scene);
  sub->add_option("-o,--output", options->output, "Folder to keep it in (default: the cache)");
  sub->callback(
      [options, &command] { command.run = [options, &command] { return run(command.globals, *options); }; });
}

}  // namespace vasa::cli
