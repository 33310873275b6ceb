#include <doctest/doctest.h>

#include <fstream>

#include "view/session.h"

using namespace vasa;
using namespace vasa::test;

TEST_CASE("without a display there is a message with a remedy, and no device is asked for") {
  const auto outcome = runProgram({"view"}, {.environment = {"DISPLAY="}});
  CHECK(outcome.exit == 1);
  CHECK(outcome.err.find("xvfb-run") != std::string::npos);
  CHECK(outcome.out.empty());
}

TEST_CASE("what is wrong is told before a window opens, or by its closing") {
  const VirtualDisplay display;
  const TemporaryFolder folder;
  CHECK(runProgram({"view", "--script", "no-such-script.txt"}, on(display, folder)).exit == 6);
  CHECK(runProgram({"view", "--look", "sepia"}, on(display, folder)).exit == 2);
  CHECK(runProgram({"view", "--size", "big"}, on(display, folder)).exit == 2);
  CHECK(runProgram({"view", "--device", "no such device"}, on(display, folder)).exit == 4);
  std::ofstream(folder.path() / "bad.json") << "{ \"body\": 3 }";
  CHECK(runProgram({"view", (folder.path() / "bad.json").string()}, on(display, folder)).exit == 3);
  const auto missing =
      runProgram({"view", "--body", "none.glb", "--network", "none.vasa"}, on(display, folder));
  CHECK(missing.exit == 6);
  const auto recorded = [&](const std::string& file) {
    const auto script = scriptIn(folder.path(), "settle\nwindow OUT/late.png\n").string();
    return runProgram({"view", "--size", "400x300", "--script", script, "--record-script", file},
                      on(display, folder));
  };
  const std::string nowhere = (folder.path() / "none" / "session.txt").string();
  const auto early = recorded(nowhere);
  CHECK(early.exit == 6);
  CHECK_MESSAGE(early.err.find("error: " + nowhere) == 0, early.err);
  CHECK(!std::filesystem::exists(folder.path() / "late.png"));
  const auto full = recorded("/dev/full");
  CHECK(full.exit == 6);
  CHECK_MESSAGE(full.err.find("/dev/full") == full.err.rfind("/dev/full"), full.err);
}
