#include <doctest/doctest.h>

#include <fstream>

#include "cli/program.h"
#include "support/shared_data.h"

// Where memory ends, a command ends with 1 and a sentence: it neither aborts nor crashes nor hangs, wherever
// that is. tests/soak/interrupted.py looks at many more limits.

using namespace vasa::test;

TEST_CASE("a command that runs out of memory says so and ends with 1, at any limit") {
  const TemporaryFolder folder;
  const auto lines = (folder.path() / "lines.swc").string();
  {
    std::ofstream file(lines);
    for (int i = 1; i <= 60000; ++i)
      file << i << " 3 " << i % 300 << ' ' << i / 300 << " 0 0.4 " << (i % 300 == 1 ? -1 : i - 1) << '\n';
  }
  const auto out = (folder.path() / "a.vasa").string();
  int told = 0;
  for (const std::vector<std::string>& command :
       {std::vector<std::string>{"convert", lines, "--scale", "0.001", "-o", out},
        {"info"},
        {"export", "-o", out + ".obj"}})
    for (const long megabytes : {100, 140, 200, 280, 390}) {
      CAPTURE(command[0]);
      CAPTURE(megabytes);
      for (const std::string& file : {out, out + ".obj"}) std::filesystem::remove(file);
      const auto outcome = runProgram(command, {.memoryKiB = 1024 * megabytes});
      INFO(outcome.err);
      const bool loads = outcome.exit != 127;  // else the loader has told that libraries do not fit
      if (outcome.exit == 0 || !loads) continue;
      CHECK(outcome.exit == 1);
      CHECK(
          outcome.err.starts_with("error: "));  // of memory, or of a thread that finds no room for its stack
      for (const std::string& file : {out, out + ".obj"}) CHECK(!std::filesystem::exists(file));
      ++told;
    }
  CHECK(told > 0);
}
