#pragma once
#include <cstdint>
#include <filesystem>

namespace vasa::viewer {

/// What is to be written, and where to: the extension says as what. PNG is a picture, MP4 and WebM are films,
/// all else is what exportVessels() writes.
struct ExportWish {
  std::filesystem::path file;
  std::uint32_t width = 1920, height = 1080;  ///< [pixels] of pictures and films
  bool wholeClip = true;                      ///< all frames, where a file holds them; else what is shown
};

}  // namespace vasa::viewer
