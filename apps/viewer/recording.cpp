#include "viewer/recording.h"

#include <fmt/format.h>

#include <algorithm>

namespace vasa::viewer {

Result<void> Recording::start(const std::filesystem::path& path, std::uint32_t width, std::uint32_t height) {
  auto video = VideoWriter::create(path, width, height, 30);
  if (!video) return video.error();
  video_.emplace(std::move(*video));
  path_ = path;
  width_ = width;
  height_ = height;
  frames_ = 0;
  return {};
}

Result<void> Recording::add(const Image& picture) {
  ++frames_;
  return video_->write(picture);
}

Result<std::filesystem::path> Recording::finish() {
  const auto finished = video_->finish();
  video_.reset();
  if (!finished) return finished.error();
  return path_;
}

std::filesystem::path freeName(const std::filesystem::path& folder, const std::string& extension) {
  std::error_code ignored;
  for (int i = 1;; ++i)
    if (std::filesystem::path path = folder / fmt::format("vasa_{:03}.{}", i, extension); !std::filesystem::exists(path, ignored)) return path;
}

Result<std::filesystem::path> placeBelow(const std::filesystem::path& folder, const std::filesystem::path& name) {
  std::error_code error;
  const auto home = std::filesystem::weakly_canonical(std::filesystem::absolute(folder), error) / "";
  const auto file = std::filesystem::weakly_canonical(home / name, error);
  const auto [end, rest] = std::mismatch(home.begin(), std::prev(home.end()), file.begin(), file.end());
  if (error || end != std::prev(home.end()) || rest == file.end())
    return badInput(name.string() + ": a script writes below " + folder.string() + " only; name a file there, or another folder with --out");
  return folder / name;
}

}  // namespace vasa::viewer
