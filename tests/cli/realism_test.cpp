#include <doctest/doctest.h>

#include <fstream>

#include "cli/program.h"
#include "support/shared_data.h"

using namespace vasa::test;

namespace {

// One pose and a figure that the built-in human comes near, or one that nobody does.
void writeProtocol(const std::filesystem::path& folder, const std::string& row) {
  std::ofstream(folder / "poses.csv")
      << "pose,part,flex_deg,abduct_deg,twist_deg\nknee_60,leftLowerLeg,60,0,0\nknee_60,rightLowerLeg,60,0,0\n";
  std::ofstream(folder / "sweeps.csv") << "sweep,pose,degrees,from,to,metric\n";
  std::ofstream(folder / "protocol.csv")
      << "id,from,to,first_share,last_share,from_pose,to_pose,metric,level_mm,mean,sd,low,high,blind,source,link,note\n"
      << row << "\n";
}

}  // namespace

TEST_CASE(
    "realism takes a figure from the built-in human, writes a page, and ends with 1 below the score that is asked for") {
  TemporaryFolder folder;
  const std::string landmarks = "left deep femoral artery,left anterior tibial artery,,,rest,knee_60,";
  writeProtocol(folder.path(), "A1," + landmarks + "length_change_percent,,-6,3,,,,Somebody 2006,,");
  const auto out = folder.path() / "page";
  auto outcome = runProgram(
      {"realism", "--protocol", folder.path().string(), "--json", "--least", "1", "-o", out.string()});
  REQUIRE_MESSAGE(outcome.exit == 0, outcome.err);
  const auto row = outcome.json()["rows"][0];
  CHECK(row["ours"].get<double>() < -3);
  CHECK(row["ours"].get<double>() > -12);
  CHECK(row["right_sign"] == true);
  CHECK(row["on_the_way"].size() == 4);
  const auto report = outcome.json();
  CHECK(report["score"]["within_2_sd"] == 1);
  // Other tools rely on these.
  for (const char* key : {"sign_ok", "within_2sd", "used_in_tuning"}) CHECK_MESSAGE(row[key] == true, key);
  CHECK(row["within_1sd"].is_boolean());
  for (const char* key : {"usable", "sign_ok", "within_2sd"}) CHECK_MESSAGE(report[key] == 1, key);
  CHECK(report.contains("within_1sd"));
  CHECK(std::filesystem::exists(out / "report.json"));
  CHECK(contentOf(out / "index.html").find("Somebody 2006") != std::string::npos);
  writeProtocol(folder.path(), "A1," + landmarks + "length_change_percent,,6,1,,,,Somebody 2006,,");
  outcome = runProgram({"realism", "--protocol", folder.path().string(), "--least", "0.8"});
  CHECK(outcome.exit == 1);
  CHECK(outcome.out.find("wrong direction") != std::string::npos);
}

TEST_CASE("realism says what is wrong with a table") {
  TemporaryFolder folder;
  writeProtocol(
      folder.path(),
      "A1,left deep femoral artery,left anterior tibial artery,,,rest,kneel,twist_degrees,,60,34,,,,S,,");
  const auto outcome = runProgram({"realism", "--protocol", folder.path().string()});
  CHECK(outcome.exit == 3);
  CHECK(outcome.err.find("protocol.csv:2: poses.csv has no pose 'kneel'") != std::string::npos);
  CHECK(runProgram({"realism", "--protocol", (folder.path() / "nothing").string()}).exit == 6);
}
