#pragma once
#include <optional>

#include "io/video.h"

namespace vasa::viewer {

/// A video of what is shown.
class Recording {
 public:
  bool running() const { return video_.has_value(); }
  Result<void> start(const std::filesystem::path& path, std::uint32_t width, std::uint32_t height);
  /// @param picture  of the size it was started with
  Result<void> add(const Image& picture);
  std::uint64_t frames() const { return frames_; }  ///< of the video that runs, or ran last
  /// Completes the file, and names it.
  Result<std::filesystem::path> finish();
  bool fits(std::uint32_t width, std::uint32_t height) const { return width == width_ && height == height_; }

 private:
  std::optional<VideoWriter> video_;
  std::filesystem::path path_;
  std::uint32_t width_ = 0, height_ = 0;
  std::uint64_t frames_ = 0;
};

/// The first of vasa_001.ext, vasa_002.ext ... that does not exist yet in a folder.
std::filesystem::path freeName(const std::filesystem::path& folder, const std::string& extension);

/// Where a file of this name lies that may be written below a folder only; links count as where they lead.
/// Fails with badInput where it lies elsewhere.
Result<std::filesystem::path> placeBelow(const std::filesystem::path& folder,
                                         const std::filesystem::path& name);

}  // namespace vasa::viewer
