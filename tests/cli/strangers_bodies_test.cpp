#include <doctest/doctest.h>

#include "body/person.h"
#include "cli/program.h"
#include "core/atomic_file.h"
#include "support/shared_data.h"

using namespace vasa;
using namespace vasa::test;

// Bodies of others, and what lies in them, made here, through the program.

TEST_CASE("half a body, whose mirror was not applied, is warned of, and a whole one is not") {
  const TemporaryFolder folder;
  for (const bool half : {true, false}) {
    const auto path = (folder.path() / "body.glb").string();
    REQUIRE(writeFileAtomically(path, personGlb({.half = half})).ok());
    const auto told = runProgram({"info", path});
    REQUIRE_MESSAGE(told.exit == 0, told.err);
    CHECK_MESSAGE(
        (told.err.find("half a body: one side's arm and leg have no skin") != told.err.npos) == half,
        told.err);
  }
}

TEST_CASE("a body that a negative scale mirrors is told of, with what to do") {
  const TemporaryFolder folder;
  const auto path = (folder.path() / "body.glb").string();
  for (const bool mirrored : {true, false}) {
    REQUIRE(writeFileAtomically(path, personGlb({.mirrored = mirrored})).ok());
    const auto told = runProgram({"info", path});
    REQUIRE_MESSAGE(told.exit == 0, told.err);
    CHECK_MESSAGE(
        (told.err.find("a negative scale mirrors it; export it without") != told.err.npos) == mirrored,
        told.err);
  }
}

TEST_CASE("info tells which elements convert would leave out") {
  const TemporaryFolder folder;
  const auto path = (folder.path() / "scan.obj").string();
  std::string text;
  for (const char* name : {"Leber", "arteria"})
    text += std::string("o ") + name + "\nv 0 0 0\nv 0 900 0\nv 5 900 0\nv 5 0 0\nf -4 -3 -2 -1\n";
  REQUIRE(writeFileAtomically(path, text).ok());
  const auto told = runProgram({"info", path, "--json"}).json()["element"];
  REQUIRE(told.size() == 2);
  CHECK(told[0]["left_out"] == "organ");
  CHECK(!told[1].contains("left_out"));
}
