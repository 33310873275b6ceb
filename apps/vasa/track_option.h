#pragma once
#include <CLI/CLI.hpp>
#include <string>

#include "scene/frame.h"

namespace vasa::cli {

/// Declares --track FILE.
void addTrackOption(CLI::App& sub, std::string& file);

/// The motion's track in a file: what is there is used, and what was solved beyond that is there afterwards.
class TrackFile {
 public:
  /// Gives the options a track, filled from the file if it exists. The scene and the clip must outlive it.
  /// @param file     empty: the track is not kept  @param clip  null: no motion, which is usage with a file
  /// @param without  what is kept meanwhile where there is no file: who makes frames in their order needs the
  /// latest
  static Result<TrackFile> open(const std::string& file, const Scene& scene, const Clip* clip,
                                FrameOptions& options, MotionTrack::Keeps without = MotionTrack::Keeps::all);
  /// Writes the file if there are more frames than it had.
  Result<void> save() const;

 private:
  std::string file_;
  std::uint64_t key_ = 0;
  std::size_t known_ = 0;
  std::shared_ptr<MotionTrack> track_;
};

}  // namespace vasa::cli
