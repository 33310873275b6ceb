#pragma once
#include <functional>
#include <memory>

#include "viewer/document.h"
#include "gpu/instance.h"
#include "render/profiler.h"
#include "scene/scene_file.h"
#include "viewer/script.h"

namespace vasa::viewer {

struct ViewOptions {
  SceneFile file;                ///< what is opened first; look.preset empty: as in the last session
  std::filesystem::path rules;   ///< folder of the capillaries' rules; empty: there are none
  std::string device;            ///< as --device
  std::uint32_t seed = 1;
  std::uint32_t width = 0, height = 0;  ///< [pixels] of the window; 0: as in the last session, else 1280 x 720
  gpu::Validation validation;
  std::optional<std::vector<ScriptStep>> script;  ///< replayed in place of a person; the window's own input counts for nothing
  std::filesystem::path record;                   ///< a script of this session is written here; empty: none
  /// The scene that a dropped file means.
  std::function<Result<SceneFile>(const std::filesystem::path&)> open;
  std::function<bool()> stopped;  ///< by a signal
};

/// What a session was like.
struct ViewReport {
  std::uint64_t frames = 0, pictures = 0, shapes = 0;
  double frameMs = 0;  ///< median between pictures shown while things moved
  double shapeMs = 0, pictureMs = 0;
  std::vector<std::pair<std::string, double>> stages;  ///< medians [ms], as the timing panel has them
  std::string device, selected, title;
  std::uint32_t width = 0, height = 0;  ///< [pixels] of the scene's picture at the end
  std::vector<std::filesystem::path> files;
  std::vector<ProfileRow> profile;  ///< of the latest run of Table III
  std::vector<std::string> validation;
};

/// Opens the window and stays until it is closed, or the script is over. Throws gpu::Error.
Result<ViewReport> view(const ViewOptions& options);

}  // namespace vasa::viewer
