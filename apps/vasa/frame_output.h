#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "body/clip.h"
#include "core/result.h"

namespace vasa::cli {

/// When a film's frames are: a clip's times alone, at its own rate or another; without a clip one frame, at
/// 0.
/// @param fps  frames a second; 0: the clip's own. Fails with usage where there is none
Result<Clip> timingOf(const Clip* clip, double fps);

/// "A:B", "A:" or ":B" or "A": the first and last frame, both included, within a clip of `count` frames.
struct FrameRange {
  std::uint32_t first = 0, last = 0;
};
Result<FrameRange> parseFrameRange(const std::string& text, std::uint32_t count);

/// "i/n" with 0 <= i < n: every n-th frame from the i-th on is this process's share.
struct Shard {
  std::uint32_t index = 0, count = 1;
};
Result<Shard> parseShard(const std::string& text);

/// Most pixels of a picture's width, and of its height: what Vulkan devices draw as a rule.
inline constexpr std::uint32_t kMostPixelsAcross = 16384;

/// "1280x720"; both 1 to kMostPixelsAcross.
struct PictureSize {
  std::uint32_t width = 1280, height = 720;
};
Result<PictureSize> parseSize(const std::string& text);

/// "8x5": m in 3..16 around, n in 2..20 along; "auto": by size on the picture, pixelError > 0.
struct Quads {
  std::uint32_t around = 8, along = 5;
  float pixelError = 0;  ///< of "auto" (RenderOptions::pixelError)
};
Result<Quads> parseQuads(const std::string& text);

/// A file name with the place of the frame's number: "{frame}" or, with leading zeros, "{frame:04}".
class FramePattern {
 public:
  /// @param several  more than one frame will be written, so the number must be in the name
  static Result<FramePattern> parse(const std::string& text, bool several);
  std::filesystem::path of(std::uint32_t frame) const;
  /// Whether the number is in a folder's name, so that frames have folders of their own.
  bool numbersFolders() const { return after_.find('/') != std::string::npos; }

 private:
  std::string before_, after_;
  int digits_ = 0;
  bool numbered_ = false;
};

}  // namespace vasa::cli
