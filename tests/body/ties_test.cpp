#include "body/ties.h"

#include <doctest/doctest.h>

#include <algorithm>

#include "network/builder.h"

using namespace vasa;

TEST_CASE("vessels side by side are tied, those apart are not") {
  NetworkBuilder builder;
  const auto line = [&](const char* name, float x) {
    std::vector<vec4> points;
    for (int k = 0; k < 12; ++k) points.emplace_back(x, 0.01f * float(k), 0, 0.002f);
    builder.addVessel({name, "", VesselKind::artery}, points);
  };
  line("artery", 0), line("vein", 0.005f), line("far", 0.03f);
  const auto network = builder.build(2);
  REQUIRE(network.ok());
  const auto vesselOf = [&](std::uint32_t point) {
    std::uint32_t v = 0;
    while (point >= network->vessels()[v].firstPoint + network->vessels()[v].pointCount) ++v;
    return v;
  };
  std::size_t beside = 0;
  for (const Tie& tie : tiesOf(*network)) {
    const std::uint32_t a = vesselOf(tie.a), b = vesselOf(tie.b), low = std::min(a, b), high = std::max(a, b);
    CHECK((high != 2 || low == 2));  // nothing leads to the third
    if (low == 0 && high == 1) ++beside;
  }
  CHECK(beside >= 10);
}
