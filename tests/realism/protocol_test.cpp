#include "realism/protocol.h"

#include <doctest/doctest.h>

#include <fstream>
#include <set>

#include "support/shared_data.h"

using namespace vasa;

namespace {

void write(const std::filesystem::path& path, const std::string& text) { std::ofstream(path) << text; }

const std::string kHeader =
    "id,from,to,first_share,last_share,from_pose,to_pose,metric,level_mm,mean,sd,low,high,blind,source,link,note\n";

Result<Protocol> withRow(const std::string& row) {
  test::TemporaryFolder folder;
  write(folder.path() / "poses.csv", "pose,part,flex_deg,abduct_deg,twist_deg\nbent,leftLowerLeg,90,0,15\n");
  write(folder.path() / "protocol.csv", kHeader + row + "\n");
  write(folder.path() / "sweeps.csv", "sweep,pose,degrees,from,to,metric\n");
  return readProtocol(folder.path());
}

}  // namespace

TEST_CASE(
    "the protocol that ships: forty figures and more, each with its source, every eighth of the list blind") {
  const auto protocol = readProtocol(VASA_REALISM_DATA);
  REQUIRE_MESSAGE(protocol.ok(), protocol.error().message);
  CHECK(protocol->rows.size() >= 40);
  std::set<std::string> ids;
  for (const ProtocolRow& row : protocol->rows) {
    CHECK(ids.insert(row.id).second);
    CHECK_FALSE(row.source.empty());
    CHECK(row.blind == (std::stoi(row.id.substr(1)) % 8 == 0));
    if (row.low) CHECK(*row.low < *row.high);
  }
  CHECK(protocol->sweeps.size() >= 6);
}

TEST_CASE("a row is read, and what is wrong with one is told with its line") {
  const auto good = withRow("A1,a,b,0.5,,rest,bent,twist_degrees,,60,34,,,yes,Somebody 2006,,");
  REQUIRE_MESSAGE(good.ok(), good.error().message);
  const ProtocolRow& row = good->rows.front();
  CHECK(row.metric == PoseMetric::twist);
  CHECK(row.firstShare == 0.5f);
  CHECK(row.lastShare == 1);
  CHECK(row.deviation == 34.0f);
  CHECK_FALSE(row.low);
  CHECK(row.blind);
  CHECK(good->poses.find("bent")->second.front().flexion == doctest::Approx(glm::radians(90.0f)));
  CHECK(withRow("A1,a,b,,,rest,knelt,twist_degrees,,60,34,,,,S,,").error().message ==
        "protocol.csv:2: poses.csv has no pose 'knelt'");
  CHECK(withRow("A1,a,b,,,rest,bent,twits,,60,34,,,,S,,")
            .error()
            .message.find("protocol.csv:2: 'twits' is no metric; there are length_change_percent") == 0);
  CHECK(withRow("A1,a,b,0.6,0.5,rest,bent,twist_degrees,,60,34,,,,S,,").error().message ==
        "protocol.csv:2: shares must rise from 0 to 1");
  CHECK(withRow("A1,a,b,,,rest,bent,twist_degrees,,sixty,34,,,,S,,").error().message ==
        "protocol.csv:2: 'sixty' is not a number");
}
