#pragma once
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace vasa::test {

/// What a run of the program left behind.
struct Outcome {
  int exit = -1;  ///< exit code; 128 + signal when it was killed
  std::string out, err;

  /// Standard output as JSON; fails the test if it is none.
  nlohmann::json json() const;
};

struct ProgramOptions {
  std::vector<std::string> environment;  ///< NAME=VALUE, on top of ours
  std::string folder;                    ///< to run in; empty: this one
  std::string standardOutput;            ///< a file instead of a pipe, e.g. /dev/full
  int signalAfterMs = -1;                ///< send SIGINT after so long
};

/// Runs vasa with these arguments and waits for it.
Outcome runProgram(const std::vector<std::string>& arguments, const ProgramOptions& options = {});

/// The built-in human of this build.
std::filesystem::path humanBody();
std::filesystem::path humanVessels();

/// Names of what is in a folder, sorted.
std::vector<std::string> listOf(const std::filesystem::path& folder);

}  // namespace vasa::test
