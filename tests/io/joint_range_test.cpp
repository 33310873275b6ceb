#include "io/joint_range.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <fstream>

#include "support/shared_data.h"

using namespace vasa;

namespace {

Result<std::vector<JointRange>> withRows(const std::string& rows) {
  test::TemporaryFolder folder;
  const auto path = folder.path() / "ranges.csv";
  std::ofstream(path) << "name,part,motion,low_deg,high_deg,source\n" << rows;
  return readJointRanges(path);
}

}  // namespace

TEST_CASE("ranges of the left side are those of the right side, too; those of the middle are there once") {
  const auto ranges = withRows(
      "neck turn,neck,twist,-35,30,Somebody\nleft knee flexion,leftLowerLeg,flexion,0,140,Somebody\n");
  REQUIRE_MESSAGE(ranges.ok(), ranges.error().message);
  REQUIRE(ranges->size() == 3);
  CHECK((*ranges)[2].name == "right knee flexion");
  CHECK((*ranges)[2].part == "rightLowerLeg");
  CHECK((*ranges)[0].low == doctest::Approx(glm::radians(-35.0f)));
  const JointAngles angles = (*ranges)[0].at(0.2f);
  CHECK(angles.part == "neck");
  CHECK(angles.twist == 0.2f);
  CHECK(angles.flexion == 0);
}

TEST_CASE("what ships names every range once, with a source, and knees bend one way only") {
  const auto ranges = readJointRanges(std::filesystem::path(VASA_REALISM_DATA) / "ranges.csv");
  REQUIRE_MESSAGE(ranges.ok(), ranges.error().message);
  CHECK(ranges->size() >= 30);
  const auto knee = std::ranges::find(*ranges, "right knee flexion", &JointRange::name);
  REQUIRE(knee != ranges->end());
  CHECK(knee->low == 0);
}

TEST_CASE("tables that cannot be are refused with the line and the cause") {
  const auto faultOf = [](const std::string& rows) { return withRows(rows).error().message; };
  CHECK(faultOf("a,neck,spin,-1,1,x\n").find("'spin' is no motion") != std::string::npos);
  CHECK(faultOf("a,neck,twist,5,30,x\n").find("on both sides of 0") != std::string::npos);
  CHECK(faultOf("a,neck,twist,-5,30,x\na,head,twist,-5,30,x\n").find("two ranges called 'a'") !=
        std::string::npos);
}
