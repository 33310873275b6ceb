#include "core/atomic_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <cstring>

#include "core/cancellation.h"
#include "core/files_read.h"

namespace vasa {
namespace {

// Names of temporary files that are open now, in fixed memory so that a signal handler can read them.
constexpr std::size_t kSlots = 64;
constexpr std::size_t kNameLength = 1024;
constexpr std::size_t kReadAtOnce = std::size_t(1) << 24;
struct Slot {
  std::atomic<int> state{0};  // 0 free, 1 being written, 2 holds a name
  char name[kNameLength];
};
std::array<Slot, kSlots> unfinished;

void remember(const std::string& name) {
  if (name.size() >= kNameLength) return;
  for (Slot& slot : unfinished) {
    int expected = 0;
    if (!slot.state.compare_exchange_strong(expected, 1)) continue;
    std::memcpy(slot.name, name.c_str(), name.size() + 1);
    slot.state = 2;
    return;
  }
}

void forget(const std::string& name) {
  for (Slot& slot : unfinished)
    if (slot.state == 2 && name == slot.name) slot.state = 0;
}

int openTemporary(const std::filesystem::path& path, std::filesystem::path& temporary) {
  std::string pattern = path.string() + ".part-XXXXXX";
  const int descriptor = mkstemp(pattern.data());
  if (descriptor < 0) return -1;
  const mode_t mask = umask(0);
  umask(mask);
  fchmod(descriptor, 0666 & ~mask);
  temporary = pattern;
  remember(pattern);
  return descriptor;
}

std::string remedy(int cause) {
  switch (cause) {
    case ENOSPC:
    case EDQUOT: return "free some space or write elsewhere";
    case EACCES:
    case EROFS:
    case EPERM: return "choose a folder that you may write to";
    case ENOENT: return "create the folder first";
    default: return "check the path";
  }
}

void syncFolder(const std::filesystem::path& path) {
  const std::filesystem::path folder = path.has_parent_path() ? path.parent_path() : ".";
  const int descriptor = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return;  // the rename itself has succeeded
  fsync(descriptor);
  close(descriptor);
}

}  // namespace

Error AtomicFile::fail(const char* doing, int cause) const {
  return ioError(path_.string() + ": cannot " + doing + ": " + std::strerror(cause) + "; " + remedy(cause));
}

Result<AtomicFile> AtomicFile::create(const std::filesystem::path& path) {
  struct stat status{};
  const bool exists = stat(path.c_str(), &status) == 0;
  std::filesystem::path temporary;
  int descriptor = -1;
  if (exists && S_ISDIR(status.st_mode)) {
    errno = EISDIR;
  } else if (exists && !S_ISREG(status.st_mode)) {
    descriptor = open(path.c_str(), O_WRONLY | O_CLOEXEC);
  } else {
    descriptor = openTemporary(path, temporary);
  }
  AtomicFile file(descriptor, path, temporary);
  if (descriptor < 0) return file.fail("create the file", errno);
  return file;
}

AtomicFile::AtomicFile(AtomicFile&& other) noexcept
    : descriptor_(std::exchange(other.descriptor_, -1)),
      path_(std::move(other.path_)),
      temporary_(std::exchange(other.temporary_, {})) {}

AtomicFile::~AtomicFile() {
  if (descriptor_ >= 0) close(descriptor_);
  if (!temporary_.empty()) {
    unlink(temporary_.c_str());
    forget(temporary_.string());
  }
}

Result<void> AtomicFile::write(std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return fail("write", written < 0 ? errno : ENOSPC);
    bytes = bytes.subspan(std::size_t(written));
  }
  return {};
}

Result<void> AtomicFile::commit() {
  if (!temporary_.empty() && fsync(descriptor_) != 0) return fail("write", errno);
  if (close(std::exchange(descriptor_, -1)) != 0) return fail("write", errno);
  if (temporary_.empty()) return {};
  if (rename(temporary_.c_str(), path_.c_str()) != 0) return fail("rename the finished file", errno);
  forget(temporary_.string());
  temporary_.clear();
  syncFolder(path_);
  return {};
}

Result<void> writeFileAtomically(const std::filesystem::path& path, std::span<const std::byte> bytes) {
  auto file = AtomicFile::create(path);
  if (!file) return file.error();
  if (auto written = file->write(bytes); !written) return written;
  return file->commit();
}

Result<void> writeFileAtomically(const std::filesystem::path& path, const std::string& text) {
  return writeFileAtomically(path, std::as_bytes(std::span(text)));
}

Result<std::vector<std::byte>> readFile(const std::filesystem::path& path, std::size_t maximumBytes) {
  const auto refuse = [&](const std::string& why) { return ioError(path.string() + ": " + why); };
  // O_NONBLOCK: opening a pipe must not hang before its type is known.
  const int descriptor = open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (descriptor < 0) return refuse(std::string("cannot open: ") + std::strerror(errno) + "; check the path");
  struct Closer {
    int descriptor;
    ~Closer() { close(descriptor); }
  } closer{descriptor};
  struct stat status{};
  if (fstat(descriptor, &status) != 0) return refuse(std::string("cannot read: ") + std::strerror(errno));
  if (!S_ISREG(status.st_mode)) return refuse("is not a regular file; give the path of a file");
  const auto size = std::size_t(status.st_size);
  if (size > maximumBytes)
    return badInput(path.string() + ": " + std::to_string(size) + " bytes, more than the " +
                    std::to_string(maximumBytes) + " that are accepted; split or reduce the file");
  std::vector<std::byte> bytes(size);
  std::size_t filled = 0;
  while (filled < size) {
    checkpoint();
    const ssize_t got = ::read(descriptor, bytes.data() + filled, std::min(size - filled, kReadAtOnce));
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) return refuse(std::string("cannot read: ") + std::strerror(errno));
    if (got == 0) return refuse("was cut short while it was read; try again");
    filled += std::size_t(got);
  }
  FilesRead::note(bytes);
  return bytes;
}

void removeUnfinishedFiles() noexcept {
  for (Slot& slot : unfinished)
    if (slot.state == 2) unlink(slot.name);
}

}  // namespace vasa
