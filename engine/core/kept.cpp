#include "core/kept.h"

#include <algorithm>
#include <fstream>
#include <mutex>
#include <string>

#include "core/atomic_file.h"
#include "core/bytes.h"
#include "core/hash.h"
#include "core/log.h"

namespace fs = std::filesystem;

namespace vasa {
namespace {

KeptFolders folders;
std::mutex failureMutex;
std::optional<Error> failure;

// Before what is kept; tells a whole file.
struct Header {
  std::uint64_t engine, key, hash, size;
};

std::string nameOf(std::string_view kind, std::uint64_t key) {
  constexpr char kDigits[] = "0123456789abcdef";
  std::string name = std::string(kind) + '-';
  for (const std::uint64_t number : {key, folders.engine})
    for (int shift = 60; shift >= 0; shift -= 4) name += kDigits[number >> shift & 15];
  return name + ".kept";
}

// By plain means: what is kept is no input (core/files_read.h).
std::optional<std::vector<std::byte>> readWhole(const fs::path& path, std::uint64_t key) {
  std::error_code error;
  if (!fs::is_regular_file(path, error)) return {};  // opening a pipe would hang
  std::ifstream file(path, std::ios::binary);
  Header header{};
  if (!file.read(reinterpret_cast<char*>(&header), sizeof(header))) return {};
  if (header.engine != folders.engine || header.key != key) return {};
  if (fs::file_size(path, error) - sizeof(header) != header.size || error) return {};
  std::vector<std::byte> bytes(header.size);
  if (!file.read(reinterpret_cast<char*>(bytes.data()), std::streamsize(bytes.size()))) return {};
  if (hashBytes(bytes) != header.hash) return {};
  return bytes;
}

// By the clock that is read here: a file system's own may lag behind it, and what is new would seem the
// oldest.
void markUsed(const fs::path& path) {
  std::error_code ignored;
  fs::last_write_time(path, fs::file_time_type::clock::now(), ignored);
}

// The oldest go until the rest has room.
void tidy(const fs::path& folder) {
  struct File {
    fs::file_time_type used;
    fs::path path;
    std::uintmax_t size;
  };
  std::vector<File> files;
  std::uintmax_t sum = 0;
  std::error_code error;
  for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error)) {
    if (at->path().extension() != ".kept") continue;
    std::error_code gone;  // another process tidies, too
    const File file{at->last_write_time(gone), at->path(), at->file_size(gone)};
    if (gone) continue;
    sum += file.size;
    files.push_back(file);
  }
  std::ranges::sort(files, {}, &File::used);
  for (const File& file : files) {
    if (sum <= folders.most) break;
    fs::remove(file.path, error);
    sum -= file.size;
  }
}

Result<void> write(std::string_view kind, std::uint64_t key, std::span<const std::byte> bytes) {
  const fs::path path = folders.own / nameOf(kind, key);
  const std::uintmax_t size = sizeof(Header) + bytes.size();
  if (size > folders.most)
    return ioError(path.string() + ": " + std::to_string(size) + " bytes, more than the " +
                   std::to_string(folders.most) + " that are kept in all");
  std::error_code ignored;  // writing tells
  fs::create_directories(folders.own, ignored);
  ByteWriter file;
  file.add(Header{folders.engine, key, hashBytes(bytes), bytes.size()});
  file.addRaw(bytes);
  auto written = writeFileAtomically(path, file.bytes());
  if (written) markUsed(path);
  return written;
}

}  // namespace

void setKeptFolders(KeptFolders given) {
  folders = std::move(given);
  failure.reset();
}

std::optional<std::vector<std::byte>> findKept(std::string_view kind, std::uint64_t key) {
  const std::string name = nameOf(kind, key);
  if (!folders.own.empty())
    if (auto found = readWhole(folders.own / name, key)) {
      markUsed(folders.own / name);
      return found;
    }
  for (const fs::path& folder : folders.shipped)
    if (auto found = readWhole(folder / name, key)) return found;
  return {};
}

void keep(std::string_view kind, std::uint64_t key, std::span<const std::byte> bytes) {
  if (folders.own.empty()) return;
  if (const auto written = write(kind, key, bytes); !written) {
    logDetail("not kept for later runs: " + written.error().message);
    const std::lock_guard lock(failureMutex);
    if (!failure) failure = written.error();
    return;
  }
  tidy(folders.own);
}

Result<void> keptAll() {
  const std::lock_guard lock(failureMutex);
  return failure ? Result<void>(*failure) : Result<void>();
}

}  // namespace vasa
