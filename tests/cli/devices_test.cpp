#include <doctest/doctest.h>

#include "cli/program.h"

using namespace vasa::test;

TEST_CASE("devices lists at least one usable device") {
  const auto outcome = runProgram({"devices", "--json"});
  REQUIRE(outcome.exit == 0);
  const auto report = outcome.json();
  REQUIRE(!report["devices"].empty());
  bool usable = false;
  for (const auto& device : report["devices"]) {
    for (const char* key : {"index", "name", "type", "usable", "lacks"}) CHECK(device.contains(key));
    usable |= device["usable"].get<bool>();
  }
  CHECK(usable);
}

TEST_CASE("without a driver, commands that draw end with 4 and a remedy") {
  const ProgramOptions noDriver{
      .environment = {"VK_ICD_FILENAMES=/nonexistent.json", "VK_DRIVER_FILES=/nonexistent.json"}};
  for (const std::vector<std::string>& arguments : {std::vector<std::string>{"devices"},
                                                    {"render", "--size", "32x32", "-o", "/tmp/never.png"},
                                                    {"profile"}}) {
    const auto outcome = runProgram(arguments, noDriver);
    CHECK_MESSAGE(outcome.exit == 4, arguments[0] << ": " << outcome.err);
    CHECK(outcome.err.find("mesa-vulkan-drivers") != std::string::npos);
  }
  CHECK(runProgram({"info"}, noDriver).exit == 0);
}

TEST_CASE("an unknown device is told") {
  const auto outcome =
      runProgram({"render", "--device", "no such card", "--size", "32x32", "-o", "/tmp/never.png"});
  CHECK(outcome.exit == 4);
  CHECK(outcome.err.find("no such card") != std::string::npos);
}
