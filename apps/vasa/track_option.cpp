#include "track_option.h"

#include <filesystem>

namespace vasa::cli {

void addTrackOption(CLI::App& sub, std::string& file) {
  sub.add_option("--track", file,
                 "The solved motion of the clip: taken from this file where it goes, and kept there");
}

Result<TrackFile> TrackFile::open(const std::string& file, const Scene& scene, const Clip* clip,
                                  FrameOptions& options, MotionTrack::Keeps without) {
  TrackFile track;
  track.file_ = file;
  track.track_ = options.track =
      std::make_shared<MotionTrack>(file.empty() ? without : MotionTrack::Keeps::all);
  if (file.empty()) return track;
  if (file == "-")
    return Error{Fault::usage, "--track -: a track is read and kept, so it has to be a file; name one"};
  if (!clip) return Error{Fault::usage, "--track " + file + ": a track is of a motion; name one with --clip"};
  if (!options.avoid)
    return Error{Fault::usage,
                 "--track " + file + ": holds how vessels are moved apart; leave out --no-avoid or --track"};
  track.key_ = trackKey(scene, *clip, options);
  std::error_code ignored;
  if (!std::filesystem::exists(file, ignored)) return track;
  auto read = readTrack(file, scene, *clip, track.key_);
  if (!read) return read.error();
  *track.track_ = std::move(*read);
  track.known_ = track.track_->end();
  return track;
}

Result<void> TrackFile::save() const {
  if (file_.empty() || track_->end() <= known_) return {};
  return writeTrack(file_, *track_, key_);
}

}  // namespace vasa::cli
