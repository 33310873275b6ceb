#include "core/atomic_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <mutex>
#include <set>
#include <string_view>
#include <utility>

#include "core/cancellation.h"
#include "core/files_read.h"

namespace vasa {
namespace {

constexpr std::size_t kReadAtOnce = std::size_t(1) << 24;

// Named files in progress: short names, so that a target's may be as long as the file system allows.
constexpr std::string_view kPrefix = ".vasa-", kSuffix = ".part";

std::filesystem::path folderOf(const std::filesystem::path& path) {
  return path.has_parent_path() ? path.parent_path() : ".";
}

// Where a link leads, so that what is replaced is the file and not the link; the file need not be there.
std::filesystem::path followLinks(std::filesystem::path path) {
  constexpr int kMostLinks = 40;  // as the kernel has it
  std::error_code error;
  for (int link = 0; link < kMostLinks && std::filesystem::is_symlink(path, error); ++link) {
    const auto to = std::filesystem::read_symlink(path, error);
    if (error) break;
    path = path.parent_path() / to;
  }
  return path;
}

// A process that is killed may leave a named file in progress. Whoever writes one holds a lock on it, so what
// is not locked is nobody's. Once a folder, for a film has thousands of files.
void sweep(const std::filesystem::path& folder) {
  static std::mutex mutex;
  static std::set<std::filesystem::path> swept;
  const std::scoped_lock lock(mutex);
  std::error_code error;
  if (!swept.insert(std::filesystem::absolute(folder, error)).second) return;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
    const std::string name = entry.path().filename();
    if (!name.starts_with(kPrefix) || !name.ends_with(kSuffix)) continue;
    const int descriptor = open(entry.path().c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
    if (descriptor < 0) continue;
    if (flock(descriptor, LOCK_EX | LOCK_NB) == 0) unlink(entry.path().c_str());
    close(descriptor);
  }
}

// Calls make(name) with names in the folder until it does not find one taken.
template <class Make>
int withFreeName(const std::filesystem::path& folder, std::filesystem::path& name, const Make& make) {
  static std::atomic<unsigned> count = 0;
  for (int attempt = 0; attempt < 1000; ++attempt) {
    name = folder / (std::string(kPrefix) + std::to_string(getpid()) + "-" + std::to_string(++count) +
                     std::string(kSuffix));
    const int made = make(name.c_str());
    if (made >= 0 || errno != EEXIST) return made;
  }
  return -1;
}

// A file without a name, which is gone with its descriptor however the process ends; one with a name where
// the file system has no such thing (FAT, some network file systems).
int openInProgress(const std::filesystem::path& folder, std::filesystem::path& name) {
  int descriptor = -1;
  if (access("/proc/self/fd", X_OK) == 0)
    descriptor = open(folder.c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, 0666);
  if (descriptor < 0)
    descriptor = withFreeName(folder, name, [](const char* free) {
      return open(free, O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, 0666);
    });
  if (descriptor >= 0) flock(descriptor, LOCK_EX | LOCK_NB);
  return descriptor;
}

std::filesystem::path handleOf(int descriptor) { return "/proc/self/fd/" + std::to_string(descriptor); }

int linkAt(int descriptor, const char* name) {
  return linkat(AT_FDCWD, handleOf(descriptor).c_str(), AT_FDCWD, name, AT_SYMLINK_FOLLOW);
}

std::string remedy(int cause) {
  switch (cause) {
    case ENOSPC:
    case EDQUOT:
      return "free some space or write elsewhere";
    case EACCES:
    case EROFS:
    case EPERM:
      return "choose a folder that you may write to";
    case ENOENT:
      return "create the folder first";
    case EFBIG:
      return "raise the limit on file sizes (ulimit -f) or write elsewhere";
    case ENAMETOOLONG:
      return "choose a shorter name";
    default:
      return "check the path";
  }
}

void syncFolder(const std::filesystem::path& path) {
  const int descriptor = open(folderOf(path).c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return;  // the rename itself has succeeded
  fsync(descriptor);
  close(descriptor);
}

}  // namespace

Error AtomicFile::fail(const char* doing, int cause) const {
  return ioError(path_.string() + ": cannot " + doing + ": " + std::strerror(cause) + "; " + remedy(cause));
}

Result<AtomicFile> AtomicFile::create(const std::filesystem::path& path) {
  AtomicFile file(path);
  file.target_ = followLinks(path);
  struct stat status {};
  const bool exists = stat(file.target_.c_str(), &status) == 0;
  if (!exists && errno != ENOENT) return file.fail("create the file", errno);
  if (exists && S_ISDIR(status.st_mode)) return file.fail("create the file", EISDIR);
  if (exists && !S_ISREG(status.st_mode)) {
    file.direct_ = true;
    file.descriptor_ = open(path.c_str(), O_WRONLY | O_CLOEXEC);
  } else {
    if (exists && access(file.target_.c_str(), W_OK) != 0) return file.fail("replace the file", errno);
    sweep(folderOf(file.target_));
    file.descriptor_ = openInProgress(folderOf(file.target_), file.named_);
  }
  if (file.descriptor_ < 0) return file.fail("create the file", errno);
  if (exists && !file.direct_) {
    // Ours to keep, not to insist on: who may not give files away writes one of their own.
    [[maybe_unused]] const int owned = fchown(file.descriptor_, status.st_uid, status.st_gid);
    fchmod(file.descriptor_, status.st_mode & 07777);
  }
  return file;
}

AtomicFile::AtomicFile(AtomicFile&& other) noexcept
    : descriptor_(std::exchange(other.descriptor_, -1)),
      direct_(other.direct_),
      path_(std::move(other.path_)),
      target_(std::move(other.target_)),
      named_(std::exchange(other.named_, {})) {}

AtomicFile::~AtomicFile() {
  if (descriptor_ >= 0) close(descriptor_);
  if (!named_.empty()) unlink(named_.c_str());
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
  if (direct_) return close(std::exchange(descriptor_, -1)) == 0 ? Result<void>() : fail("write", errno);
  if (fsync(descriptor_) != 0) return fail("write", errno);
  // A file without a name cannot take one that is in use: it gets another first.
  bool done = named_.empty() && linkAt(descriptor_, target_.c_str()) == 0;
  if (!done && named_.empty() &&
      (errno != EEXIST || withFreeName(folderOf(target_), named_,
                                       [&](const char* free) { return linkAt(descriptor_, free); }) != 0)) {
    named_.clear();
    return fail("name the finished file", errno);
  }
  if (!done && rename(named_.c_str(), target_.c_str()) != 0) return fail("rename the finished file", errno);
  named_.clear();
  if (close(std::exchange(descriptor_, -1)) != 0) return fail("write", errno);
  syncFolder(target_);
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
  struct stat status {};
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

}  // namespace vasa
