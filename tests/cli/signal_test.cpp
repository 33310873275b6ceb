#include <doctest/doctest.h>

#include <fstream>

#include "cli/program.h"
#include "support/shared_data.h"

// Signals in the middle of whatever a command does. How long an answer takes is told, not asserted, but for a
// bound far above it: 0.2 s are promised, and a loop that never asks goes on for minutes.

using namespace vasa::test;

namespace {

constexpr int kBound = 5;  // [s]

// A line that winds through all of a box, of samples that lie near one another: long in every stage.
void writeLongLine(const std::filesystem::path& path, int samples) {
  std::ofstream file(path);
  for (int i = 1; i <= samples; ++i) {
    const int row = i / 1000, column = row % 2 ? 999 - i % 1000 : i % 1000;
    file << i << " 3 " << column << ' ' << row % 1000 << ' ' << row / 1000 << " 0.4 " << (i == 1 ? -1 : i - 1)
         << '\n';
  }
}

// A sheet of triangles: one element.
void writeSheet(const std::filesystem::path& path, int side) {
  std::ofstream file(path);
  for (int i = 0; i < side; ++i)
    for (int k = 0; k < side; ++k) file << "v " << i << ' ' << k << ' ' << (i * 7 + k * 3) % 5 << '\n';
  for (int i = 1; i < side; ++i)
    for (int k = 1; k < side; ++k) {
      const int a = (i - 1) * side + k, b = a + side;
      file << "f " << a << ' ' << b << ' ' << b + 1 << "\nf " << a << ' ' << b + 1 << ' ' << a + 1 << '\n';
    }
}

void writeTubes(const std::filesystem::path& path, int count) {
  std::ofstream file(path);
  file << count << " 0\n";
  for (int i = 0; i < count; ++i) {
    for (int pose = 0; pose < 2; ++pose)
      for (int k = 0; k < 4; ++k)
        file << 0.01 * (i % 100) + 0.004 * k << ' ' << 0.01 * (i / 100 % 100) << ' ' << 0.01 * (i / 10000)
             << " 0.003 ";
    file << '\n';
  }
}

}  // namespace

TEST_CASE("every command answers SIGINT and SIGTERM whatever it is doing, and leaves no file") {
  const TemporaryFolder folder, in;
  const auto line = (in.path() / "line.swc").string(), sheet = (in.path() / "sheet.obj").string(),
             tubes = (in.path() / "tubes.txt").string();
  writeLongLine(line, 400000);
  writeSheet(sheet, 500);
  writeTubes(tubes, 40000);
  const auto vessels = humanVessels().string(), body = humanBody().string();
  const auto at = [&](const char* name) { return (folder.path() / name).string(); };
  const std::vector<std::vector<std::string>> commands{
      {"convert", line, "--scale", "0.001", "-o", at("a.vasa")},
      {"convert", sheet, "--scale", "0.001", "-o", at("a.vasa")},
      {"info"},
      {"compare", vessels, vessels},
      {"fit", vessels, "--from", body, "--to", body, "-o", at("a.vasa")},
      {"check", "--clip", "run"},
      {"export", "--clip", "run", "-o", at("a.glb")},
      {"bench", "collide", "--tubes", tubes, "--runs", "1000"},
      {"render", "--clip", "run", "--size", "2000x2000", "--video", at("a.mp4")},
      {"profile", "--clip", "walk", "--quads", "8x5"},
      {"plate", "front", "-o", at("a.pdf")},
      {"poses", "-o", (in.path() / "poses").string()},  // these keep what is done, for the next run
      {"realism", "-o", (in.path() / "realism").string()},
      {"paper", "-o", (in.path() / "paper").string()},
      {"prepare"},
  };
  int turn = 0;
  for (const auto& command : commands)
    for (const int after : {150, 900}) {
      const int signal = ++turn % 2 ? SIGTERM : SIGINT;
      CAPTURE(command[0]);
      CAPTURE(after);
      const auto outcome = runProgram(command, {.environment = {"XDG_CACHE_HOME=" + in.path().string()},
                                                .signalAfterMs = after,
                                                .signal = signal,
                                                .signalPatience = kBound});
      INFO(outcome.err);
      // What was done by then is done.
      if (outcome.exit != 0) {
        CHECK(outcome.exit == 128 + signal);
        CHECK(outcome.err.find("stopped by a signal") != std::string::npos);
        CHECK(listOf(folder.path()).empty());
      }
      MESSAGE(command[0] << " answers after " << outcome.msFromSignal << " ms with " << outcome.exit);
      for (const auto& file : listOf(folder.path())) std::filesystem::remove(folder.path() / file);
    }
}
