#include <doctest/doctest.h>

#include "body/person.h"
#include "cli/program.h"
#include "core/atomic_file.h"
#include "support/shared_data.h"

using namespace vasa;
using namespace vasa::test;

// Bodies of others, made here, through the program.

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
