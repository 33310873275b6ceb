#pragma once
#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "core/result.h"

namespace vasa {

/// A file that appears whole under its name or not at all: written under a temporary name in the same
/// folder, flushed to the disk and renamed by commit(). Dropped without commit(), it leaves nothing.
/// A target that exists and is no regular file (/dev/full, a pipe) is written to directly.
class AtomicFile {
 public:
  static Result<AtomicFile> create(const std::filesystem::path& path);
  AtomicFile(AtomicFile&& other) noexcept;
  AtomicFile& operator=(AtomicFile&&) = delete;
  ~AtomicFile();

  Result<void> write(std::span<const std::byte> bytes);
  Result<void> commit();

  const std::filesystem::path& path() const { return path_; }
  /// Where the bytes go until commit(): for another program that writes the file in our stead.
  const std::filesystem::path& pathInProgress() const { return temporary_.empty() ? path_ : temporary_; }

 private:
  AtomicFile(int descriptor, std::filesystem::path path, std::filesystem::path temporary)
      : descriptor_(descriptor), path_(std::move(path)), temporary_(std::move(temporary)) {}
  Error fail(const char* doing, int cause) const;

  int descriptor_;
  std::filesystem::path path_;
  std::filesystem::path temporary_;  // empty: written directly
};

/// create, write, commit.
Result<void> writeFileAtomically(const std::filesystem::path& path, std::span<const std::byte> bytes);
Result<void> writeFileAtomically(const std::filesystem::path& path, const std::string& text);

/// The bytes of a regular file. Refuses folders, pipes and devices, and files over maximumBytes.
Result<std::vector<std::byte>> readFile(const std::filesystem::path& path,
                                        std::size_t maximumBytes = std::size_t(1) << 31);

/// Removes every temporary file that is still open: for a signal handler, so async-signal-safe.
void removeUnfinishedFiles() noexcept;

}  // namespace vasa
