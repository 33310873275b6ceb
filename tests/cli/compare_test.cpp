#include <doctest/doctest.h>

#include "cli/program.h"

using namespace vasa::test;

TEST_CASE("a network compared with itself has all its vessels in common, in the same places") {
  const auto vessels = humanVessels().string();
  const auto outcome = runProgram({"compare", vessels, vessels, "--json"});
  REQUIRE_MESSAGE(outcome.exit == 0, outcome.err);
  const auto report = outcome.json();
  CHECK(report["summary"]["common"].get<int>() == int(report["vessels"].size()));
  CHECK(report["summary"]["common"].get<int>() >= 450);
  CHECK(report["summary"]["length_within_15_percent"].get<double>() == doctest::Approx(1));
  CHECK(report["summary"]["apart_mean_m"].get<double>() < 1e-5);
  CHECK(report["summary"]["length_ratio_median"].get<double>() == doctest::Approx(1));
  for (const auto& vessel : report["vessels"]) CHECK(vessel["distance_m"].get<double>() < 1e-5);
  const auto table = runProgram({"compare", vessels, vessels, "--rows", "3"});
  CHECK(table.exit == 0);
  CHECK(std::count(table.out.begin(), table.out.end(), '\n') == 5);
}

TEST_CASE("compare wants two networks that are there") {
  CHECK(runProgram({"compare", humanVessels().string()}).exit == 2);
  CHECK(runProgram({"compare", humanVessels().string(), "nowhere.vasa"}).exit != 0);
}
