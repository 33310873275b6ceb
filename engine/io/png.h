#pragma once
#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "core/image.h"
#include "core/result.h"

namespace vasa {

struct PngOptions {
  bool alpha = false;     ///< keep the alpha channel; otherwise it is dropped
  int compression = 1;    ///< zlib level 0..9; 1 is fast
  std::string comment;    ///< kept in the file (a tEXt chunk "Comment"); empty: none
  float dotsPerInch = 0;  ///< at which it is meant to be printed; 0: not said
};

/// A PNG file's bytes. The same image gives the same bytes.
Result<std::vector<std::byte>> encodePng(const Image& image, PngOptions options = {});

/// Written atomically.
Result<void> writePng(const std::filesystem::path& path, const Image& image, PngOptions options = {});

/// Reads any PNG as 8-bit RGBA. Refuses pictures over 256 Mpixel.
Result<Image> decodePng(std::span<const std::byte> bytes, const std::string& name);
Result<Image> readPng(const std::filesystem::path& path);

/// The comment that a PNG file carries; empty if it has none. Fails with badInput where the file is cut off.
Result<std::string> readPngComment(const std::filesystem::path& path);

}  // namespace vasa
