#include "scene_options.h"

#include <cstdlib>

#include "engine_print.h"
#include "io/foreign_files.h"
#include "kept_folders.h"
#include "scene/vessel_files.h"

// The built-in human is looked for in $VASA_DATA_DIR, then from the program's place: where it is installed
// (../share/vasa) and where the build puts it (../data).
namespace vasa::cli {

Result<std::filesystem::path> dataFolder() {
  std::vector<std::filesystem::path> places;
  if (const char* set = std::getenv("VASA_DATA_DIR")) places.emplace_back(set);
  std::error_code ignored;
  const auto program = std::filesystem::read_symlink("/proc/self/exe", ignored);
  const auto prefix = program.parent_path().parent_path();
  if (!program.empty()) places.insert(places.end(), {prefix / "share" / "vasa", prefix / "data"});
  for (const auto& place : places)
    if (std::filesystem::exists(place / "human.glb", ignored)) return place;
  return ioError(
      "the built-in human (human.glb) is in none of its places; build the project or set VASA_DATA_DIR");
}

std::filesystem::path cacheFolder() {
  if (const char* set = std::getenv("XDG_CACHE_HOME"); set && *set == '/')
    return std::filesystem::path(set) / "vasa";
  if (const char* home = std::getenv("HOME"); home && *home == '/')
    return std::filesystem::path(home) / ".cache" / "vasa";
  return {};
}

KeptFolders keptFolders(std::filesystem::path own) {
  const auto data = dataFolder();
  return {.shipped = data ? std::vector{*data / "kept"} : std::vector<std::filesystem::path>{},
          .own = std::move(own),
          .engine = kEnginePrint};
}

void addSceneOptions(CLI::App& sub, SceneOptions& options) {
  sub.add_option("SCENE", options.scene,
                 "Scene file (.json), or vessels, alone or in --body; nothing: the built-in human");
  sub.add_option("--body", options.body, "Body with skeleton (glTF)");
  sub.add_option("--network", options.networks,
                 "Vessels (.vasa, or anything that convert reads); may be given several times")
      ->take_all()
      ->allow_extra_args(false);
  sub.add_option("--edits", options.edits,
                 "Journal of edits to the vessels (.vedit, see vasa help edits); may be given several times")
      ->take_all()
      ->allow_extra_args(false);
  sub.add_option("--holds", options.holds,
                 "Table of the places where vessels are held in their beds (vasa help scenes)");
  sub.add_option("--clip", options.clip, "Motion: a clip's name or a unique beginning of it, or a .bvh file");
  sub.add_option(
      "--joint-map", options.jointMap,
      "Which joint of the body follows which of a .bvh file: lines `motion's = body's` (default: by name)");
  sub.add_flag(
      "--as-recorded", options.asRecorded,
      "Leave arms and legs that pass through the body where the motion has them (default: turned out of it)");
}

namespace {

// What a scene file names and is not there is the scene file's fault, unless something else is given in its
// place.
Result<void> checkNamed(const SceneFile& scene, const SceneOptions& options, const std::string& growth) {
  std::vector<std::filesystem::path> named;
  if (options.body.empty()) named.push_back(scene.body);
  if (options.networks.empty()) named.insert(named.end(), scene.networks.begin(), scene.networks.end());
  if (options.edits.empty()) named.insert(named.end(), scene.edits.begin(), scene.edits.end());
  if (options.holds.empty() && options.networks.empty()) named.push_back(scene.holds);
  if (options.clip.empty() && isMotionFile(scene.clip)) named.emplace_back(scene.clip);
  if (options.jointMap.empty()) named.push_back(scene.jointMap);
  if (growth.empty()) named.push_back(scene.capillaries.rules);
  std::error_code ignored;
  for (const auto& file : named)
    if (!file.empty() && !std::filesystem::exists(file, ignored))
      return badInput(options.scene + ": names " + file.string() +
                      ", which is not there; mend the name, relative to the scene file");
  return {};
}

// In a scene's place: of a glTF file by whether it has a skeleton.
Result<bool> namesVessels(const std::filesystem::path& file) {
  if (extensionOf(file) == ".vasa" || (!file.empty() && holdsCentrelines(file))) return true;
  return holdsSurfacesAlone(file);
}

}  // namespace

Result<SceneFile> chooseScene(const SceneOptions& options, const std::string& growth) {
  SceneFile scene;
  const auto vessels = namesVessels(options.scene);
  if (!vessels) return vessels.error();
  if (*vessels) {
    scene.networks = {options.scene};
  } else if (!options.scene.empty()) {
    auto read = readSceneFile(options.scene);
    if (!read) return read;
    scene = std::move(*read);
    if (auto checked = checkNamed(scene, options, growth); !checked) return checked.error();
  }
  if (!options.body.empty()) scene.body = options.body;
  if (*vessels) {
    scene.networks.insert(scene.networks.end(), options.networks.begin(), options.networks.end());
  } else if (!options.networks.empty()) {
    scene.networks.assign(options.networks.begin(), options.networks.end());
    scene.holds.clear();  // of other vessels
  }
  if (!options.edits.empty()) scene.edits.assign(options.edits.begin(), options.edits.end());
  if (!options.holds.empty()) scene.holds = options.holds;
  if (!options.clip.empty()) scene.clip = options.clip;
  if (!options.jointMap.empty()) scene.jointMap = options.jointMap;
  scene.asRecorded |= options.asRecorded;
  if (!scene.jointMap.empty() && !isMotionFile(scene.clip))
    return Error{Fault::usage, "a joint map belongs to a .bvh file; give one with --clip FILE.bvh"};
  if (!scene.body.empty() && scene.networks.empty())
    return Error{Fault::usage, "a body is given but no vessels; add --network FILE.vasa"};
  if (*vessels && scene.body.empty() && !scene.clip.empty())
    return Error{Fault::usage, options.scene + ": vessels alone do not move; add --body FILE.glb to --clip"};
  // What is not given is the built-in human's.
  if (scene.body.empty() && !*vessels) {
    const auto folder = dataFolder();
    if (!folder) return folder.error();
    scene.body = *folder / "human.glb";
    if (scene.networks.empty()) {
      scene.networks = {*folder / "human.vasa"};
      if (scene.holds.empty()) scene.holds = *folder / "human.holds.csv";
    }
  }
  return scene;
}

}  // namespace vasa::cli
