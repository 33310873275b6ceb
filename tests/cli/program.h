#pragma once
#include <csignal>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace vasa::test {

/// What a run of the program left behind.
struct Outcome {
  int exit = -1;            ///< exit code; 128 + signal when it was killed
  double msFromSignal = 0;  ///< until it had ended, where one was sent
  std::string out, err;

  /// Standard output as JSON; fails the test if it is none.
  nlohmann::json json() const;
};

struct ProgramOptions {
  std::vector<std::string> environment;  ///< NAME=VALUE, on top of ours
  std::string folder;                    ///< to run in; empty: this one
  std::string standardOutput;            ///< a file instead of a pipe, e.g. /dev/full
  int signalAfterMs = -1;                ///< send a signal after so long
  int signal = SIGINT;                   ///< which; it is killed where that does not end it in time
  int signalPatience = 60;               ///< [s] that it has for that
  long memoryKiB = 0;                    ///< of addresses at most; 0: as many as there are
};

/// Runs vasa with these arguments and waits for it.
Outcome runProgram(const std::vector<std::string>& arguments, const ProgramOptions& options = {});

/// The built-in human of this build.
std::filesystem::path humanBody();
std::filesystem::path humanVessels();

/// Names of what is in a folder, sorted.
std::vector<std::string> listOf(const std::filesystem::path& folder);

}  // namespace vasa::test
