#include "scene/holds.h"

#include <doctest/doctest.h>

#include "core/atomic_file.h"
#include "network/builder.h"
#include "support/shared_data.h"

using namespace vasa;

namespace {

Network arteries(std::initializer_list<float> sides = {-0.1f, 0.1f}) {
  NetworkBuilder builder;
  for (const float x : sides) {
    std::vector<vec4> points;
    for (int i = 0; i < 6; ++i) points.emplace_back(x, 0.01f * float(i), 0, 0.002f);
    builder.addVessel({x > 0 ? "left ulnar artery" : "right ulnar artery", "", VesselKind::artery}, points);
  }
  auto network = builder.build(1.75f);
  REQUIRE(network.ok());
  return std::move(network).value();
}

}  // namespace

TEST_CASE("a table of holds: what is said of the left is held on the right, too") {
  const test::TemporaryFolder folder;
  const auto path = folder.path() / "holds.csv";
  REQUIRE(writeFileAtomically(path, "# bands\nvessel,at,held_by\nleft ulnar artery,0.9,ulnar canal\n"));
  const auto holds = readHolds(path, arteries());
  REQUIRE_MESSAGE(holds.ok(), holds.error().message);
  REQUIRE(holds->size() == 2);
  CHECK((*holds)[0].vessel == "left ulnar artery");
  CHECK((*holds)[1].vessel == "right ulnar artery");
  CHECK((*holds)[1].at == 0.9f);
  CHECK(readHolds(path, arteries({0.1f}))->size() == 1);  // where there is one
}

TEST_CASE("a hold that is nowhere is refused with its line and a name that was likely meant") {
  const test::TemporaryFolder folder;
  const auto path = folder.path() / "holds.csv";
  const auto refusal = [&](std::string_view row) {
    REQUIRE(writeFileAtomically(path, "vessel,at,held_by\n" + std::string(row) + "\n"));
    const auto holds = readHolds(path, arteries());
    REQUIRE(!holds.ok());
    CHECK(holds.error().fault == Fault::badInput);
    return holds.error().message;
  };
  CHECK(refusal("left ulnr artery,0.9,").find("holds.csv:2") != std::string::npos);
  CHECK(refusal("left ulnr artery,0.9,").find("did you mean \"left ulnar artery\"") != std::string::npos);
  CHECK(refusal("left ulnar artery,1.2,").find("share from 0 to 1") != std::string::npos);
  CHECK(refusal("left ulnar artery,far,").find("far") != std::string::npos);
}
