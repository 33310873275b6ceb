#include "view/virtual_display.h"

#include <doctest/doctest.h>
#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>

extern char** environ;

namespace vasa::test {

// The server chooses a free number and writes it to the descriptor once it listens.
VirtualDisplay::VirtualDisplay(int dpi) {
  std::array<int, 2> ends{};
  REQUIRE(pipe2(ends.data(), O_CLOEXEC) == 0);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, ends[1], 3);
  posix_spawn_file_actions_addopen(&actions, 2, "/dev/null", O_WRONLY, 0);
  const std::string dots = std::to_string(dpi);
  const std::array arguments{"Xvfb", "-displayfd", "3", "-screen", "0", "2560x1600x24", "-dpi", dots.c_str(), "-nolisten", "tcp"};
  std::array<char*, arguments.size() + 1> argv{};
  for (std::size_t i = 0; i < arguments.size(); ++i) argv[i] = const_cast<char*>(arguments[i]);
  const int error = posix_spawnp(&server_, "Xvfb", &actions, nullptr, argv.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  close(ends[1]);
  REQUIRE_MESSAGE(error == 0, "Xvfb cannot be started; install xvfb");
  for (char c; read(ends[0], &c, 1) == 1 && c != '\n';) name_ += c;
  close(ends[0]);
  REQUIRE_MESSAGE(!name_.empty(), "Xvfb ended at once");
  name_ = ":" + name_;
}

VirtualDisplay::~VirtualDisplay() {
  if (server_ <= 0) return;
  kill(server_, SIGTERM);
  waitpid(server_, nullptr, 0);
}

}  // namespace vasa::test
