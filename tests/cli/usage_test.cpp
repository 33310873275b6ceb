#include <doctest/doctest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "cli/program.h"
#include "support/shared_data.h"

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

TEST_CASE("help and version that cannot be written fail, as everything else does") {
  for (const auto& arguments : std::vector<std::vector<std::string>>{
           {"--version"}, {"--help"}, {"render", "--help"}, {"help"}, {"help", "plate"}}) {
    const auto outcome = runProgram(arguments, {.standardOutput = "/dev/full"});
    CHECK_MESSAGE(outcome.exit == 6, arguments.back());
    CHECK(outcome.err.find("standard output") != std::string::npos);
  }
}

TEST_CASE("what is no stream is not written to a file or a folder called -") {
  const TemporaryFolder folder;
  std::ofstream(folder.path() / "a.tubes") << "0 0\n";
  for (const auto& arguments : std::vector<std::vector<std::string>>{
           {"poses", "--joints", "elbow", "-o", "-"},
           {"realism", "-o", "-"},
           {"paper", "--quick", "-o", "-"},
           {"bench", "collide", "--tubes", "a.tubes", "--pairs", "-"},
           {"check", "--clip", "walk", "--frames", "0:0", "--track", "-"}}) {
    const auto outcome = runProgram(arguments, {.folder = folder.path().string()});
    CHECK_MESSAGE(outcome.exit == 2, arguments.front() << ": " << outcome.err);
    CHECK_MESSAGE(outcome.err.find(" -: ") != std::string::npos, outcome.err);
    CHECK_FALSE(std::filesystem::exists(folder.path() / "-"));
  }
}

TEST_CASE("help tells of topics and commands alike, and of none that is not there") {
  const auto overview = runProgram({"help"});
  CHECK(overview.exit == 0);
  for (const char* topic : {"bodies", "clusters", "formats", "running", "scenes", "view"}) {
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
        {"info", "--threads", "0"},
        {"info", "--threads", "1025"},
        {"info", "--threads", "-1"},
        {"info", "--threads", "two"},
        {"info", "--seed", "4294967296"},
        {"render", "-o", "x.jpg"},
        {"render", "--video", "x.mp4", "--shard", "0/2"},
        {"render", "-o", "x.png", "--shard", ""},
        {"render", "-o", "x.png", "--size", "8193x8", "--supersample", "2"},
        {"render", "--transparent", "--video", "x.webm"},
        {"profile", "--quads", ""},
        {"plate", "front", "--frame", "3", "-o", "x.png"},
        {"compare", "a.vasa", "b.vasa", "--rows", "-1"},
        {"place", "x.vasa", "-o", "y.vasa", "--move", "nan", "0", "0"},
        {"place", "x.vasa", "-o", "y.vasa", "--scale", "inf"},
        {"convert", "x.glb", "-o", "-"},
        {"render", "-o", "pictures"},
        {"paper"},
        {"paper", "-o", "never", "--size", "fine"}}) {
    const auto outcome = runProgram(arguments);
    CHECK_MESSAGE(outcome.exit == 2, (arguments.empty() ? "" : arguments.back()) << ": " << outcome.err);
    CHECK(!outcome.err.empty());
    CHECK(outcome.out.empty());
  }
}

TEST_CASE("a number that must be above 0 is told as that") {
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"place", "x.vasa", "-o", "y.vasa", "--scale", "0"},
        {"convert", "x.glb", "-o", "y.vasa", "--tolerance", "-1"},
        {"convert", "x.glb", "-o", "y.vasa", "--body-height", "0"}}) {
    const auto outcome = runProgram(arguments);
    CHECK(outcome.exit == 2);
    CHECK_MESSAGE(outcome.err.find(arguments.back() + ": must be above 0") != std::string::npos, outcome.err);
    CHECK(outcome.err.size() < 150);
  }
}

TEST_CASE("words that are not known are answered with those that were likely meant") {
  const auto refusal = [](const std::vector<std::string>& arguments, int exit = 2) {
    const auto outcome = runProgram(arguments);
    CHECK(outcome.exit == exit);
    return outcome.err;
  };
  CHECK(refusal({"rendr"}) == "error: 'rendr' is no command of vasa; did you mean render?\n");
  CHECK(refusal({"bench", "colide"}) ==
        "error: 'colide' is no command of vasa bench; did you mean collide?\n");
  CHECK(refusal({"render", "--clpi", "walk"}) ==
        "error: vasa render has no option --clpi; did you mean --clip?\n");
  CHECK(refusal({"check", "--thread=3"}) ==
        "error: vasa check has no option --thread; did you mean --threads?\n");
  CHECK(refusal({"help", "bdoies"}).find("did you mean bodies?") != std::string::npos);
  CHECK(refusal({"check", "--clip", "wlak"}, 3).find("did you mean walk?") != std::string::npos);
  CHECK(refusal({"render", "--focus", "left femral artery", "-o", "never.png"}, 3)
            .find("did you mean \"left femoral artery\"") != std::string::npos);
  CHECK(refusal({"xyzzy"}) == "error: 'xyzzy' is no command of vasa; vasa help lists them\n");
  CHECK(refusal({}) == "error: give a command; vasa help lists commands and topics\n");
}

TEST_CASE("no folder is begun at the root of the file system") {
  const auto outcome = runProgram({"help", "--write", "/no-such-folder-of-vasa/out"});
  CHECK(outcome.exit == 6);
  CHECK(outcome.err.find("there is no /no-such-folder-of-vasa; choose one inside a folder that exists") !=
        std::string::npos);
  CHECK(!std::filesystem::exists("/no-such-folder-of-vasa"));
}

TEST_CASE("a reader who has seen enough is told nothing") {
  CHECK(std::system("(" VASA_PROGRAM
                    " info --vessels 2> closed_pipe.txt; echo $? >> closed_pipe.txt) | true") == 0);
  std::ifstream file("closed_pipe.txt");
  const std::string all{std::istreambuf_iterator<char>(file), {}};
  CHECK(all == "141\n");
  std::filesystem::remove("closed_pipe.txt");
}

TEST_CASE("colours can be left out, and the version has a short way") {
  CHECK(runProgram({"-V"}).out == runProgram({"--version"}).out);
  CHECK(runProgram({"--no-color", "help"}).exit == 0);
}
