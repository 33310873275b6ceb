#include <doctest/doctest.h>

#include <fstream>

#include "cli/program.h"
#include "support/shared_data.h"

using namespace vasa::test;

namespace {

// Two short ways: a knee's and a toe's.
std::string shortRanges(const TemporaryFolder& folder) {
  const auto path = folder.path() / "ranges.csv";
  std::ofstream(path)
      << "name,part,motion,low_deg,high_deg,source\nleft knee flexion,leftLowerLeg,flexion,0,60,x\n"
         "head turn,head,twist,-20,20,x\n";
  return path.string();
}

}  // namespace

TEST_CASE("poses in shards, resumed, write the map that one run writes") {
  TemporaryFolder folder;
  const std::string ranges = shortRanges(folder);
  const auto whole = folder.path() / "whole", parts = folder.path() / "parts";
  const auto run = [&](const std::filesystem::path& out, std::vector<std::string> more) {
    std::vector<std::string> all{"poses",    "--ranges", ranges,   "--step", "30",
                                 "--strain", "10",       "--json", "-o",     out.string()};
    all.insert(all.end(), more.begin(), more.end());
    return runProgram(all);
  };
  const auto one = run(whole, {});
  REQUIRE_MESSAGE(one.exit == 0, one.err);
  const auto findings = one.json()["findings"];
  REQUIRE_FALSE(findings.empty());
  CHECK(findings[0]["severity"].get<double>() >= 1);
  CHECK(findings[0]["joints"].size() == 1);
  CHECK(std::filesystem::exists(whole / "poses.png"));
  CHECK(std::filesystem::exists(whole / "strain.png"));

  const auto first = run(parts, {"--shard", "0/2"});
  REQUIRE_MESSAGE(first.exit == 0, first.err);
  CHECK(first.json()["complete"] == false);
  REQUIRE(run(parts, {"--shard", "1/2"}).exit == 0);
  std::filesystem::remove(parts / "rays" / "0001.json");
  REQUIRE(run(parts, {"--resume"}).exit == 0);
  CHECK(contentOf(parts / "poses.json") == contentOf(whole / "poses.json"));
  CHECK(contentOf(parts / "poses.csv") == contentOf(whole / "poses.csv"));
  CHECK(run(parts, {"--resume", "--kink", "2"}).exit == 7);
}

TEST_CASE("poses says what it does not know before it loads anything") {
  auto outcome = runProgram({"poses", "--joints", "tail"});
  CHECK(outcome.exit == 2);
  CHECK(outcome.err.find("left knee flexion") != std::string::npos);
  outcome = runProgram({"poses", "--pair", "left knee flexion", "left knee flexion"});
  CHECK(outcome.exit == 2);
  CHECK(runProgram({"poses", "--shard", "0/2"}).exit == 2);
  outcome = runProgram({"poses", "-o", "-", "--body", "missing.glb"});
  CHECK(outcome.exit == 2);
  CHECK_MESSAGE(outcome.err.find("name a folder") != std::string::npos, outcome.err);
}

TEST_CASE("poses writes names into its table as they are, commas and quotes within") {
  TemporaryFolder folder;
  const auto edits = folder.path() / "names.vedit";
  std::ofstream(edits) << "rename \"left popliteal artery\" \"artery, \\\"popliteal\\\"; left\"\n";
  const auto outcome =
      runProgram({"poses", "--ranges", shortRanges(folder), "--step", "30", "--strain", "1", "--edits",
                  edits.string(), "--json", "-o", (folder.path() / "out").string()});
  REQUIRE_MESSAGE(outcome.exit == 0, outcome.err);
  CHECK(contentOf(folder.path() / "out" / "poses.csv").find("\n\"artery, \"\"popliteal\"\"; left\",") !=
        std::string::npos);
}
