#pragma once
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <span>

namespace vasa {

/// What readFile() (core/atomic_file.h) gives out while this lives, on any thread: tells a later run whether
/// its input is still the same, without a list of files that somebody would have to keep. One at a time; the
/// last one made counts.
class FilesRead {
 public:
  FilesRead();
  ~FilesRead();
  FilesRead(const FilesRead&) = delete;
  FilesRead& operator=(const FilesRead&) = delete;

  /// The same for the same contents, whatever the files are called and in whatever order they were read.
  std::uint64_t hash() const { return sum_; }

  /// For readFile().
  static void note(std::span<const std::byte> bytes);

 private:
  std::atomic<std::uint64_t> sum_ = 0;
  FilesRead* before_;
};

}  // namespace vasa
