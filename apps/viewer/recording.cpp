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
    if (std::filesystem::path path = folder / fmt::format("vasa_{:03}.{}", i, extension);
        !std::filesystem::exists(path, ignored))
      return path;
}

Result<std::filesystem::path> placeBelow(const std::filesystem::path& folder,
                                         const std::filesystem::path& name) {
  std::error_code error;
  const auto home = std::filesystem::weakly_canonical(std::filesystem::absolute(folder), error) / "";
  auto file = std::filesystem::weakly_canonical(home / name, error);
  // A link to a file that is not there yet is left as it is by weakly_canonical.
  constexpr int kMostLinks = 40;  // as many as Linux follows
  for (int links = 0; links < kMostLinks && !error && std::filesystem::is_symlink(file); ++links)
    file = std::filesystem::weakly_canonical(file.parent_path() / std::filesystem::read_symlink(file, error),
                                             error);
  const auto [end, rest] = std::mismatch(home.begin(), std::prev(home.end()), file.begin(), file.end());
  if (error || end != std::prev(home.end()) || rest == file.end())
    return badInput(name.string() + ": a script writes below " + folder.string() +
                    " only; name a file there, or another folder with --out");
  return folder / name;
}

}  // namespace vasa::viewer
