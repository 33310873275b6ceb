#include <doctest/doctest.h>

#include "cli/program.h"

using namespace vasa::test;

TEST_CASE("check has a row a frame and the worst of each in its summary") {
  const auto outcome = runProgram({"check", "--clip", "walk", "--frames", "8:10", "--json"});
  REQUIRE(outcome.exit == 0);
  const auto report = outcome.json();
  REQUIRE(report["frames"].size() == 3);
  CHECK(report["frames"][0]["frame"] == 8);
  for (const auto& frame : report["frames"])
    for (const char* key : {"frame", "contacts_before", "contacts_after", "depth_before_m", "depth_after_m", "certified",
                            "volume_error", "moved_max_m", "moved_rms_m", "kinks", "solve_ms"})
      CHECK_MESSAGE(frame.contains(key), key);
  for (const auto& frame : report["frames"]) {
    CHECK(frame["certified"] == (frame["contacts_after"] == 0));
    CHECK(frame["contacts_after"] <= frame["contacts_before"]);
    CHECK(report["summary"]["contacts_before"] >= frame["contacts_before"]);
  }
  for (const char* key : {"frames_with_penetration_after", "excluded_pairs", "depth_after_m"})
    CHECK_MESSAGE(report["summary"].contains(key), key);
}

TEST_CASE("check refuses a clip and frames that do not exist") {
  CHECK(runProgram({"check", "--clip", "no such clip"}).exit == 3);
  CHECK(runProgram({"check", "--clip", "walk", "--frames", "9000"}).exit == 2);
}
