#include "io/video.h"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

#include "io/foreign_files.h"

extern char** environ;

namespace vasa {
namespace {

constexpr int kOutput = 3;  // the file's descriptor in the encoder

struct Format {
  const char* extension;
  std::vector<std::string> options;
};

const Format* formatOf(const std::filesystem::path& path) {
  static const std::vector<std::string> h264{"-c:v", "libx264", "-preset", "veryfast", "-crf", "18"};
  const auto with = [](std::vector<std::string> options, std::initializer_list<std::string> more) {
    options.insert(options.end(), more);
    return options;
  };
  static const std::array<Format, 4> formats{{
      {".mp4", with(h264, {"-movflags", "+faststart", "-f", "mp4"})},
      {".mov", with(h264, {"-f", "mov"})},
      {".mkv", with(h264, {"-f", "matroska"})},
      {".webm", {"-c:v", "libvpx-vp9", "-crf", "30", "-b:v", "0", "-f", "webm"}},
  }};
  for (const Format& format : formats)
    if (extensionOf(path) == format.extension) return &format;
  return nullptr;
}

// Its own process group: Ctrl-C on the terminal stops us, and we stop the encoder.
pid_t spawnEncoder(const std::vector<std::string>& arguments, int input, int output) {
  std::vector<char*> argv;
  for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawnattr_t attributes;
  posix_spawn_file_actions_init(&actions);
  posix_spawnattr_init(&attributes);
  posix_spawn_file_actions_adddup2(&actions, input, STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&actions, output, kOutput);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
  pid_t child = -1;
  errno = posix_spawnp(&child, argv[0], &actions, &attributes, argv.data(), environ);
  const bool failed = errno != 0;
  posix_spawn_file_actions_destroy(&actions);
  posix_spawnattr_destroy(&attributes);
  return failed ? -1 : child;
}

}  // namespace

Result<VideoWriter> VideoWriter::create(const std::filesystem::path& path, std::uint32_t width,
                                        std::uint32_t height, float framesPerSecond) {
  const Format* format = formatOf(path);
  if (!format)
    return Error{Fault::usage,
                 path.string() + ": unknown video format; end the name in .mp4, .mov, .mkv or .webm"};
  auto file = AtomicFile::create(path);
  if (!file) return file.error();
  // A socket rather than a pipe: writing to an encoder that has died is an error, not a signal.
  int ends[2];
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0)
    return ioError(path.string() + ": cannot reach ffmpeg: " + std::strerror(errno));
  std::vector<std::string> arguments{"ffmpeg", "-nostdin", "-y", "-loglevel", "error", "-f", "rawvideo",
                                     "-pix_fmt", "rgba", "-s",
                                     std::to_string(width) + "x" + std::to_string(height), "-r",
                                     std::to_string(framesPerSecond), "-i", "pipe:0",
                                     // Players want even sizes and 4:2:0.
                                     "-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2", "-pix_fmt", "yuv420p"};
  arguments.insert(arguments.end(), format->options.begin(), format->options.end());
  // By its descriptor, for the file has no name yet.
  arguments.push_back("file:/proc/self/fd/" + std::to_string(kOutput));
  const pid_t encoder = spawnEncoder(arguments, ends[1], file->descriptor());
  const int cause = errno;
  close(ends[1]);
  if (encoder < 0) {
    close(ends[0]);
    return Error{Fault::failed, path.string() + ": cannot start ffmpeg: " + std::strerror(cause) +
                                    "; install it (apt install ffmpeg) or leave out --video"};
  }
  return VideoWriter(std::move(file).value(), ends[0], encoder);
}

VideoWriter::VideoWriter(VideoWriter&& other) noexcept
    : file_(std::move(other.file_)),
      input_(std::exchange(other.input_, -1)),
      encoder_(std::exchange(other.encoder_, -1)) {}

VideoWriter::~VideoWriter() {
  if (encoder_ > 0) kill(encoder_, SIGKILL);
  waitForEncoder();
}

int VideoWriter::waitForEncoder() {
  if (input_ >= 0) close(std::exchange(input_, -1));
  if (encoder_ <= 0) return -1;
  int status = -1;
  while (waitpid(encoder_, &status, 0) < 0 && errno == EINTR) {
  }
  encoder_ = -1;
  return status;
}

Result<void> VideoWriter::write(const Image& frame) {
  const std::uint8_t* data = frame.rgba.data();
  for (std::size_t left = frame.rgba.size(); left;) {
    const ssize_t sent = send(input_, data, left, MSG_NOSIGNAL);
    if (sent < 0 && errno == EINTR) continue;
    if (sent <= 0)
      return ioError(file_.path().string() + ": ffmpeg stopped while encoding; its own message is above");
    data += sent;
    left -= std::size_t(sent);
  }
  return {};
}

Result<void> VideoWriter::finish() {
  const int status = waitForEncoder();
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0)
    return ioError(file_.path().string() + ": ffmpeg could not write the video; its own message is above");
  return file_.commit();
}

}  // namespace vasa
