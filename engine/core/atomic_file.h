#pragma once
#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "core/result.h"

namespace vasa {

/// A file that appears whole under its name or not at all: written without a name in the same folder, flushed
/// to the disk and named by commit(). Dropped without commit(), or killed, it leaves nothing; where the file
/// system knows no nameless files, a killed process leaves .vasa-*.part, which the next that writes into the
/// folder removes. What is replaced keeps its mode, and its owner where we may; links are followed, files
/// that may not be written refused. A target that exists and is no regular file (/dev/full, a pipe) is
/// written to directly.
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
  int descriptor() const { return descriptor_; }

 private:
  explicit AtomicFile(std::filesystem::path path) : path_(std::move(path)) {}
  Error fail(const char* doing, int cause) const;

  int descriptor_ = -1;
  bool direct_ = false;
  std::filesystem::path path_;    // as it was given
  std::filesystem::path target_;  // behind links
  std::filesystem::path named_;   // the file in progress where it has a name
};

/// create, write, commit.
Result<void> writeFileAtomically(const std::filesystem::path& path, std::span<const std::byte> bytes);
Result<void> writeFileAtomically(const std::filesystem::path& path, const std::string& text);

/// The bytes of a regular file. Refuses folders, pipes and devices, and files over maximumBytes.
Result<std::vector<std::byte>> readFile(const std::filesystem::path& path,
                                        std::size_t maximumBytes = std::size_t(1) << 31);

}  // namespace vasa
