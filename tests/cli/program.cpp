#include "cli/program.h"

#include <doctest/doctest.h>
#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <thread>

#include "support/shared_data.h"

extern char** environ;

namespace vasa::test {
nlohmann::json Outcome::json() const {
  auto parsed = nlohmann::json::parse(out, nullptr, false);
  REQUIRE_MESSAGE(!parsed.is_discarded(), "not JSON: " << out << err);
  return parsed;
}

Outcome runProgram(const std::vector<std::string>& arguments, const ProgramOptions& options) {
  TemporaryFolder folder;
  const auto out =
      options.standardOutput.empty() ? folder.path() / "out" : std::filesystem::path(options.standardOutput);
  const auto err = folder.path() / "err";
  // A limit on memory is set by a shell that becomes the program.
  std::vector<std::string> words{VASA_PROGRAM};
  if (options.memoryKiB > 0)
    words = {"/bin/sh", "-c", "ulimit -v \"$0\"; exec \"$@\"", std::to_string(options.memoryKiB),
             VASA_PROGRAM};
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  for (const auto& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);
  std::vector<char*> environment;
  for (char** entry = environ; *entry; ++entry) {
    const std::string_view name = std::string_view(*entry).substr(0, std::string_view(*entry).find('=') + 1);
    if (std::ranges::none_of(options.environment, [&](const auto& own) { return own.starts_with(name); }))
      environment.push_back(*entry);
  }
  for (const auto& entry : options.environment) environment.push_back(const_cast<char*>(entry.c_str()));
  environment.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, 0, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, 1, out.c_str(), O_WRONLY | O_CREAT, 0600);
  posix_spawn_file_actions_addopen(&actions, 2, err.c_str(), O_WRONLY | O_CREAT, 0600);
  if (!options.folder.empty()) posix_spawn_file_actions_addchdir_np(&actions, options.folder.c_str());
  pid_t child = -1;
  REQUIRE(posix_spawn(&child, argv[0], &actions, nullptr, argv.data(), environment.data()) == 0);
  posix_spawn_file_actions_destroy(&actions);
  if (options.signalAfterMs >= 0) {
    std::this_thread::sleep_for(std::chrono::milliseconds(options.signalAfterMs));
    kill(child, options.signal);
  }
  const auto signalled = std::chrono::steady_clock::now();
  const auto since = [&] { return std::chrono::steady_clock::now() - signalled; };
  int status = 0;
  while (options.signalAfterMs >= 0 && waitpid(child, &status, WNOHANG) == 0) {
    if (since() > std::chrono::seconds(options.signalPatience)) kill(child, SIGKILL);
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  if (options.signalAfterMs < 0) waitpid(child, &status, 0);
  Outcome outcome;
  outcome.msFromSignal = std::chrono::duration<double, std::milli>(since()).count();
  outcome.exit = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  if (options.standardOutput.empty()) outcome.out = contentOf(out);
  outcome.err = contentOf(err);
  return outcome;
}

std::filesystem::path humanBody() { return std::filesystem::path(VASA_BUILD_DATA_DIR) / "human.glb"; }
std::filesystem::path humanVessels() { return std::filesystem::path(VASA_BUILD_DATA_DIR) / "human.vasa"; }

std::vector<std::string> listOf(const std::filesystem::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    names.push_back(entry.path().filename().string());
  std::ranges::sort(names);
  return names;
}

}  // namespace vasa::test
