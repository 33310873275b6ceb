#include <doctest/doctest.h>

#include "cli/program.h"

using namespace vasa::test;

TEST_CASE("help and version succeed, on standard output") {
  const auto help = runProgram({"--help"});
  CHECK(help.exit == 0);
  CHECK(help.out.find("render") != std::string::npos);
  CHECK(runProgram({"--version"}).out.starts_with("vasa "));
  for (const char* command :
       {"convert", "render", "view", "info", "paper", "prepare", "profile", "devices"}) {
    const auto own = runProgram({command, "--help"});
    CHECK(own.exit == 0);
    CHECK(own.out.find("Examples") != std::string::npos);
  }
}

TEST_CASE("help tells of topics and commands alike, and of none that is not there") {
  const auto overview = runProgram({"help"});
  CHECK(overview.exit == 0);
  for (const char* topic : {"bodies", "clusters", "formats", "running", "scenes"}) {
    CAPTURE(topic);
    CHECK(overview.out.find(std::string("  ") + topic + " ") != std::string::npos);
    const auto text = runProgram({"help", topic});
    CHECK(text.exit == 0);
    CHECK(text.err.empty());
    CHECK(text.out.size() > 500);
  }
  CHECK(runProgram({"help", "bench", "collide"}).out == runProgram({"bench", "collide", "--help"}).out);
  const auto unknown = runProgram({"help", "dancing"});
  CHECK(unknown.exit == 2);
  CHECK(unknown.out.empty());
  CHECK(unknown.err.find("there is no help on dancing") != std::string::npos);
}

TEST_CASE("a wrong command line ends with 2 and a message on standard error") {
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{},
        {"dance"},
        {"render", "--nonsense"},
        {"render"},
        {"render", "-o", "x{frame}{frame}.png"},
        {"render", "--size", "0x5", "-o", "x.png"},
        {"render", "--quads", "2x5", "-o", "x.png"},
        {"render", "--look", "sepia", "-o", "x.png"},
        {"render", "--supersample", "5", "-o", "x.png"},
        {"render", "--quads", "auto:0", "-o", "x.png"},
        {"render", "--quads", "8x21", "-o", "x.png"},
        {"render", "--shard", "3/3", "-o", "x.png"},
        {"render", "--camera", "below", "-o", "x.png"},
        {"render", "--body", "b.glb", "-o", "x.png"},
        {"render", "--video", "x.txt"},
        {"render", "-o", "-", "--json"},
        {"render", "--hide", "hair", "-o", "x.png"},
        {"render", "--clip", "walk", "-o", "same.png"},
        {"render", "--clip", "walk", "--frames", "9:3", "-o", "{frame}.png"},
        {"profile", "--quads", "fine"},
        {"info", "notes.txt"},
        {"info", "--threads", "0"},
        {"info", "--threads", "1025"},
        {"info", "--threads", "-1"},
        {"info", "--threads", "two"},
        {"info", "--seed", "4294967296"},
        {"paper"},
        {"paper", "-o", "never", "--size", "fine"}}) {
    const auto outcome = runProgram(arguments);
    CHECK_MESSAGE(outcome.exit == 2, (arguments.empty() ? "" : arguments.back()) << ": " << outcome.err);
    CHECK(!outcome.err.empty());
    CHECK(outcome.out.empty());
  }
}
