#pragma once
#include <sys/types.h>

#include <filesystem>
#include <memory>

#include "core/atomic_file.h"
#include "core/image.h"

namespace vasa {

/// A film, encoded by the `ffmpeg` program as a child process that is fed raw frames (no shell). The file
/// appears whole when finish() succeeds; dropped before that, nothing is left.
/// Formats by extension: .mp4, .mov, .mkv (H.264) and .webm (VP9).
class VideoWriter {
 public:
  /// Fails with usage for an unknown extension, with failed where there is no ffmpeg, with io for the file.
  static Result<VideoWriter> create(const std::filesystem::path& path, std::uint32_t width,
                                    std::uint32_t height, float framesPerSecond);
  VideoWriter(VideoWriter&&) noexcept;
  VideoWriter& operator=(VideoWriter&&) = delete;
  ~VideoWriter();

  Result<void> write(const Image& frame);
  Result<void> finish();

 private:
  VideoWriter(AtomicFile file, int input, pid_t encoder)
      : file_(std::move(file)), input_(input), encoder_(encoder) {}
  int waitForEncoder();

  AtomicFile file_;
  int input_;
  pid_t encoder_;
};

}  // namespace vasa
