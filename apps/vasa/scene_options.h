#pragma once
#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "core/result.h"
#include "scene/scene_file.h"

namespace vasa::cli {

/// What a person may say about the scene on the command line: SCENE and its overrides.
struct SceneOptions {
  std::string scene;  ///< a scene file; empty: the built-in human
  std::string body;
  std::vector<std::string> networks;
  std::string holds;
  std::string clip;
  std::string jointMap;
  bool asRecorded = false;
  std::vector<std::string> edits;
};

/// The folder of what ships with the program: the built-in human, the rules of growth.
Result<std::filesystem::path> dataFolder();

/// Where results are kept between runs (core/kept.h): $XDG_CACHE_HOME/vasa or ~/.cache/vasa; empty without
/// either.
std::filesystem::path cacheFolder();

/// Declares SCENE, --body, --network, --edits, --holds, --clip, --joint-map and --as-recorded.
void addSceneOptions(CLI::App& sub, SceneOptions& options);

/// The scene file that is meant, with the overrides applied. Without a scene file, what is not given comes
/// from the built-in human: a body given without a network, or the other way round, is refused as usage.
/// @param growth  --growth, where a command has it: what the scene names in its place is not looked for
Result<SceneFile> chooseScene(const SceneOptions& options, const std::string& growth = {});

}  // namespace vasa::cli
