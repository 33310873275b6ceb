#include "view/virtual_display.h"

#include <dlfcn.h>
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
  const std::array arguments{"Xvfb",         "-displayfd", "3",         "-screen", "0",
                             "2560x1600x24", "-noreset",   "-nolisten", "tcp"};
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
  if (dpi > 0) tellDpi(dpi);
}

// The X resource Xft.dpi on the root window. Xlib is there where GLFW is, its headers need not be.
void VirtualDisplay::tellDpi(int dpi) const {
  void* xlib = dlopen("libX11.so.6", RTLD_NOW);
  REQUIRE(xlib);
  const auto open = reinterpret_cast<void* (*)(const char*)>(dlsym(xlib, "XOpenDisplay"));
  const auto root = reinterpret_cast<unsigned long (*)(void*)>(dlsym(xlib, "XDefaultRootWindow"));
  const auto change = reinterpret_cast<int (*)(void*, unsigned long, unsigned long, unsigned long, int, int,
                                               const char*, int)>(dlsym(xlib, "XChangeProperty"));
  const auto close = reinterpret_cast<int (*)(void*)>(dlsym(xlib, "XCloseDisplay"));
  constexpr unsigned long kResourceManager = 23, kString = 31;
  void* display = open(name_.c_str());
  REQUIRE(display);
  const std::string resources = "Xft.dpi:\t" + std::to_string(dpi) + "\n";
  change(display, root(display), kResourceManager, kString, 8, 0, resources.c_str(), int(resources.size()));
  close(display);
}

VirtualDisplay::~VirtualDisplay() {
  if (server_ <= 0) return;
  kill(server_, SIGTERM);
  waitpid(server_, nullptr, 0);
}

}  // namespace vasa::test
