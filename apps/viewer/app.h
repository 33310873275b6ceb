#pragma once
#include <chrono>
#include <functional>
#include <memory>

#include "gpu/instance.h"
#include "render/profiler.h"
#include "scene/scene_file.h"
#include "viewer/document.h"
#include "viewer/script.h"

namespace vasa::viewer {

struct ViewOptions {
  SceneFile file;                 ///< what is opened first; look.preset empty: as in the last session
  Furnishing furnishing;          ///< what scenes take from the program's own data
  std::filesystem::path builtIn;  ///< folder of the human that ships with the program; empty: none
  std::vector<std::filesystem::path> dropped;  ///< files that are opened at once, as if they had been dropped
  std::string device;                          ///< as --device
  std::uint32_t seed = 1;
  /// [pixels] of the window; 0: as in the last session, else Window::open()'s choice
  std::uint32_t width = 0, height = 0;
  /// Pixels of panels and texts for one of an ordinary screen; 0: the screen's; scripts: 1.
  float uiScale = 0;
  gpu::Validation validation;
  std::optional<std::vector<ScriptStep>>
      script;  ///< replayed in place of a person; the window's own input counts for nothing
  std::filesystem::path out = ".";  ///< folder of what the session writes: pictures, videos
  std::filesystem::path record;     ///< a script of this session is written here; empty: none
  /// The scene that a dropped file means where `now` is shown. Called on the loading thread.
  std::function<Result<SceneFile>(const std::filesystem::path&, const SceneFile& now)> open;
  /// Extensions of files that `open` knows, with their dots: the dialog lists them.
  std::vector<std::string> openable;
  std::function<bool()> stopped;                                                   ///< by a signal
  std::chrono::steady_clock::time_point start = std::chrono::steady_clock::now();  ///< of the program
};

/// What loading something was like for the person before the window.
struct LoadReport {
  std::string title, outcome;  ///< "opened", "cancelled", or why it could not be opened
  double seconds = 0;
  std::uint64_t frames = 0;  ///< of the window meanwhile
  double longestMs = 0;      ///< between two of them, up to the first picture of what was opened
};

/// What a session was like.
struct ViewReport {
  std::uint64_t frames = 0, pictures = 0, shapes = 0;
  /// From the program's start until a picture of the body and its vessels was shown.
  double firstPictureMs = 0;
  double firstSolvedMs = 0;                     ///< ... in which vessels are moved apart, too
  std::uint64_t slices = 0, stillsGivenUp = 0;  ///< of finer stills: slices made, and stills left half done
  double longestSliceMs = 0;
  /// Of the turns after the first picture in which a person can be answered, a script's `live` seconds alone.
  double longestTurnMs = 0;
  std::uint64_t slowTurns = 0;  ///< of them over 100 ms
  double frameMs = 0;           ///< median between pictures shown while things moved
  double editMs = 0;            ///< median from an edit to the picture that shows it
  double shapeMs = 0, pictureMs = 0;
  std::vector<std::pair<std::string, double>> stages;  ///< medians [ms], as the timing panel has them
  std::string device, selected, title;
  std::uint32_t width = 0, height = 0;  ///< [pixels] of the scene's picture at the end
  std::vector<std::filesystem::path> files;
  std::uint64_t videoFrames = 0;  ///< of all videos
  std::vector<LoadReport> loads;
  std::optional<Error> refused;     ///< of a script: why files that it opens could not be, the first's fault
  std::vector<double> stopMs;       ///< how long loads that were cancelled went on
  std::vector<ProfileRow> profile;  ///< of the latest run of Table III
  std::vector<std::string> validation;
};

/// Opens the window and stays until it is closed, or the script is over. Throws gpu::Error.
Result<ViewReport> view(const ViewOptions& options);

}  // namespace vasa::viewer
