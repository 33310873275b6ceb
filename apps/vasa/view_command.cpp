#include <fmt/format.h>

#include "camera_choice.h"
#include "capillary_options.h"
#include "commands.h"
#include "core/cancellation.h"
#include "core/log.h"
#include "core/text_file.h"
#include "endings.h"
#include "frame_output.h"
#include "gpu/error.h"
#include "io/foreign_files.h"
#include "io/gltf.h"
#include "io/markups.h"
#include "report.h"
#include "scene/vessel_files.h"
#include "scene_options.h"
#include "viewer/actions.h"
#include "viewer/app.h"
#include "viewer/recording.h"

// vasa view: the interactive app (apps/viewer), from the command line.
namespace vasa::cli {
namespace view_command {

struct Options {
  SceneOptions scene;
  CapillaryOptions capillaries;
  std::string look, size, script, record, out = ".";
  float uiScale = 0;
  bool validate = false;
};

const auto kStart = std::chrono::steady_clock::now();  // before main()

constexpr const char* kOpenable =
    "open a scene (.json), vessels (.vasa, .glb, .obj, .stl, .swc, .vtp, .vtu, .vtk, .mrk.json), a body (.glb, .gltf, .vrm) or a motion (.bvh)";

// Vessels take the place of others: those were what edits were of, and what the scene's name stands for.
SceneFile withVessels(SceneFile scene, const std::filesystem::path& path) {
  scene.networks = {path};
  scene.holds.clear();
  scene.edits.clear();
  scene.path.clear();
  return scene;
}

enum class Opened { scene, motion, body, vessels };

// A glTF file with a skeleton is a body, one without is vessels.
Result<Opened> whatIs(const std::filesystem::path& path) {
  const std::string extension = extensionOf(path);
  if (extension == ".json" && !isMarkupsFile(path)) return Opened::scene;
  if (isMotionFile(path.string())) return Opened::motion;
  if (isGltfFile(path)) {
    const auto vessels = holdsSurfacesAlone(path);
    if (!vessels) return vessels.error();
    return *vessels ? Opened::vessels : Opened::body;
  }
  if (extension == ".vasa" || holdsSurfaces(path) || holdsCentrelines(path)) return Opened::vessels;
  return Error{Fault::usage, path.string() + ": this is no kind of file that the app opens; " + kOpenable};
}

// What a dropped file means: a scene, a body or vessels for what is shown, or a motion for it.
Result<SceneFile> sceneOf(const std::filesystem::path& path, const SceneFile& now) {
  const auto opened = whatIs(path);
  if (!opened) return opened.error();
  if (*opened == Opened::scene) return chooseScene({.scene = path.string()});
  if (*opened == Opened::vessels) return withVessels(now, path);
  SceneFile scene = now;
  if (*opened == Opened::motion) {
    scene.clip = path.string(), scene.time = 0;
  } else {
    scene.body = path;
    if (!isMotionFile(scene.clip)) scene.clip.clear();
  }
  return scene;
}

// A file that is named as it is, beside options: vessels join those that --network gives, of a body or a
// motion there is one. @return whether it was taken; else it is opened as a dropped one
Result<bool> takeBesideOptions(const std::filesystem::path& file, SceneOptions& scene) {
  if (scene.body.empty() && scene.networks.empty() && scene.clip.empty()) return false;
  const auto opened = whatIs(file);
  if (!opened) return opened.error();
  const char* const twice = *opened == Opened::body && !scene.body.empty()     ? "--body"
                            : *opened == Opened::motion && !scene.clip.empty() ? "--clip"
                                                                               : nullptr;
  if (twice)
    return Error{Fault::usage, file.string() + ": " + twice + " gives another one; leave out one of them"};
  if (*opened != Opened::vessels || (scene.body.empty() && scene.networks.empty())) return false;
  scene.networks.insert(scene.networks.begin(), file.string());
  return true;
}

Result<viewer::ViewOptions> prepare(const Globals& globals, const Options& options) {
  viewer::ViewOptions view;
  if (!options.size.empty()) {
    const auto size = parseSize(options.size);
    if (!size) return size.error();
    view.width = size->width;
    view.height = size->height;
  }
  SceneOptions scene = options.scene;
  if (const std::filesystem::path file = scene.scene;
      !file.empty() && (extensionOf(file) != ".json" || isMarkupsFile(file))) {
    const char* const given = !scene.holds.empty() ? "--holds" : !scene.edits.empty() ? "--edits" : nullptr;
    if (given)
      return Error{Fault::usage, std::string(given) + " is of vessels that --network gives; give --network " +
                                     file.string() + " in place of " + file.string()};
    const auto taken = takeBesideOptions(file, scene);
    if (!taken) return taken.error();
    if (!*taken) view.dropped = {file};
    scene.scene.clear();
  }
  auto choice = chooseScene(scene, options.capillaries.rules);
  if (!choice) return choice.error();
  choice->capillaries = chooseCapillaries(choice->capillaries, options.capillaries);
  // A look that nobody asked for is that of the last session.
  choice->look.preset = !options.look.empty() ? options.look : scene.scene.empty() ? "" : choice->look.preset;
  if (!options.script.empty()) {
    const auto text = readText(options.script, 1 << 24);
    if (!text) return text.error();
    auto script = viewer::parseScript(*text, options.script);
    if (!script) return script.error();
    for (viewer::ScriptStep& step : *script)
      if (auto* save = std::get_if<viewer::SavePicture>(&step)) {
        auto place = viewer::placeBelow(options.out, save->path);
        if (!place) return badInput(options.script + ": " + place.error().message);
        save->path = std::move(*place);
      }
    view.script = std::move(*script);
  }
  view.out = options.out;
  if (const auto folder = dataFolder())
    view.furnishing = {*folder / "growth", *folder / "realism" / "ranges.csv"}, view.builtIn = *folder;
  view.file = std::move(*choice);
  view.device = globals.device;
  view.uiScale = options.uiScale;
  view.seed = std::uint32_t(globals.seed);
  view.validation = {.core = options.validate, .synchronization = options.validate};
  view.record = options.record;
  view.open = sceneOf;
  view.openable = {".json", ".vasa", ".glb", ".gltf", ".vrm", ".obj",
                   ".stl",  ".swc",  ".vtp", ".vtu",  ".vtk", ".bvh"};
  view.stopped = [] { return stopRequested(); };
  view.start = kStart;
  return view;
}

Report asReport(const viewer::ViewReport& view) {
  Report files = Report::array();
  for (const auto& file : view.files) files.push_back(file.string());
  Report profile = Report::array();
  for (const ProfileRow& row : view.profile) {
    Report entry{{"quads", row.name()}, {"fps", row.fps()}};
    for (const auto& [name, value] : row.stages) entry[name] = value;
    profile.push_back(std::move(entry));
  }
  Report loads = Report::array();
  for (const viewer::LoadReport& load : view.loads)
    loads.push_back({{"title", load.title},
                     {"outcome", load.outcome},
                     {"seconds", load.seconds},
                     {"frames", load.frames},
                     {"longest_ms", load.longestMs}});
  Report stages = Report::object();
  for (const auto& [name, ms] : view.stages) stages[name] = ms;
  return {{"frames", view.frames},
          {"pictures", view.pictures},
          {"shapes", view.shapes},
          {"first_picture_ms", view.firstPictureMs},
          {"first_solved_ms", view.firstSolvedMs},
          {"still_slices", view.slices},
          {"stills_given_up", view.stillsGivenUp},
          {"longest_slice_ms", view.longestSliceMs},
          {"longest_turn_ms", view.longestTurnMs},
          {"turns_over_100_ms", view.slowTurns},
          {"shown_ms", view.frameMs},
          {"fps", view.frameMs > 0 ? 1000 / view.frameMs : 0},
          {"edit_ms", view.editMs},
          {"shape_ms", view.shapeMs},
          {"picture_ms", view.pictureMs},
          {"stages", stages},
          {"width", view.width},
          {"height", view.height},
          {"selected", view.selected},
          {"files", files},
          {"video_frames", view.videoFrames},
          {"loads", loads},
          {"stop_ms", view.stopMs},
          {"profile", profile},
          {"validation_messages", view.validation.size()},
          {"device", view.device}};
}

Result<void> run(const Globals& globals, const Options& options) {
  const auto view = prepare(globals, options);
  if (!view) return view.error();
  // A session is asked, and leaves with its script and settings saved: within a picture's time, or opening's.
  setPatience(kPatienceToSave);
  const CancellationScope fromWithin(nullptr);
  const auto session = gpu::attempt([&] { return viewer::view(*view); });
  if (!session) return session.error();
  if (!*session) return session->error();
  const viewer::ViewReport& report = **session;
  if (globals.json)
    if (auto printed = printJson(asReport(report)); !printed) return printed;
  if (stopRequested()) return stopError();
  if (!report.validation.empty())
    return Error{Fault::failed, fmt::format("{} validation messages, the first: {}", report.validation.size(),
                                            report.validation.front())};
  if (report.refused) return *report.refused;
  return {};
}

std::string footer() {
  std::string text =
      "Examples:\n"
      "  vasa view\n"
      "  vasa view --clip walk --look clinical\n"
      "  vasa view arteries.stl        # in the built-in human\n"
      "  vasa view --body b.glb --network b.vasa --record-script session.txt\n"
      "  xvfb-run -a vasa view --script session.txt --json\n"
      "Mouse and keys:\n";
  const auto rows = [&](std::span<const viewer::Shortcut> shortcuts) {
    for (const viewer::Shortcut& shortcut : shortcuts)
      text += fmt::format("  {:<22}{}\n", shortcut.keys, shortcut.what);
  };
  rows(viewer::mouseShortcuts());
  for (std::size_t menu = 0; menu < viewer::kMenuNames.size(); ++menu)
    rows(viewer::shortcutsOf(viewer::MenuId(menu)));
  text +=
      "Drop a scene (.json), vessels (.vasa, .glb, .obj, .stl, .swc, .vtp), a body (.glb) or a motion (.bvh) on the\n"
      "window to open it; drop a body and its vessels together.\n"
      "A script is text, one thing a line: move X Y, press|release left|right|middle, scroll STEPS, key|hold|let NAME,\n"
      "type TEXT, resize W H, drop FILE, frames N, live SECONDS, settle, window FILE.png, picture FILE.png, close.";
  return text;
}

}  // namespace view_command

void addView(CLI::App& app, Command& command) {
  using namespace view_command;
  auto options = std::make_shared<Options>();
  CLI::App* sub = app.add_subcommand("view", "The interactive app");
  sub->footer(footer());
  addSceneOptions(*sub, options->scene);
  addCapillaryOptions(*sub, options->capillaries);
  sub->add_option(
         "--look", options->look,
         "atlas (white page), clinical (dark) or xray (translucent); default: the scene's, else atlas")
      ->check(CLI::IsMember({"atlas", "clinical", "xray"}));
  sub->add_option(
      "--size", options->size,
      "Window size in pixels (default: that of the last session, else 1280x720, more on a high-DPI screen)");
  sub->add_option(
         "--ui-scale", options->uiScale,
         "Size of panels and texts against those of an ordinary screen (default: as the screen says)")
      ->check(CLI::Range(0.5, 4.0));
  sub->add_option("--script", options->script,
                  "Replay a recorded session instead of listening to mouse and keys, then quit");
  sub->add_option("--out", options->out,
                  "Folder that the session's pictures and videos go to; a script writes nowhere else")
      ->capture_default_str();
  sub->add_option("--record-script", options->record, "Write this session down for --script");
  sub->add_flag("--validate", options->validate,
                "Run under Vulkan's validation layer; a message of it fails the run");
  sub->callback(
      [options, &command] { command.run = [options, &command] { return run(command.globals, *options); }; });
}

}  // namespace vasa::cli
