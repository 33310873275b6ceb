#include "realism/vessel_load.h"

#include "realism/lines.h"

using namespace vasa;

namespace {

// A vessel of 10 cm and radius 3 mm, alone.
Network oneVessel() {
  NetworkBuilder builder;
  builder.addVessel({"one", "", VesselKind::artery},
                    test::straightPoints({0, 1, 0}, {0, 0.9f, 0}, 0.003f, 20));
  auto network = builder.build(1.75f);
  REQUIRE(network.ok());
  return std::move(*network);
}

VesselLoad loadOf(const Network& network, const std::vector<vec4>& points) {
  return LoadMeter(network).run(points, Avoider(network)).front();
}

}  // namespace

TEST_CASE("at rest nothing is loaded") {
  const Network network = oneVessel();
  const VesselLoad load = loadOf(network, {network.points().begin(), network.points().end()});
  CHECK(load.kink == 0);
  CHECK(load.lumen == 1);
  CHECK(load.strain == doctest::Approx(0).epsilon(1e-5));
  CHECK(load.depth == 0);
}

TEST_CASE("a vessel drawn to 6/5 of its length, thinned to half its area and bent to a circle") {
  const Network network = oneVessel();
  std::vector<vec4> points(network.points().begin(), network.points().end());
  for (vec4& p : points) p.y = 1 + 1.2f * (p.y - 1);
  VesselLoad load = loadOf(network, points);
  CHECK(load.strain == doctest::Approx(0.2f).epsilon(1e-3));
  CHECK(load.severity(LoadKind::stretch, {.strain = 0.4f}) == doctest::Approx(0.5f).epsilon(1e-2));
  CHECK(load.severity(LoadKind::shortening, {}) == 0);
  CHECK(load.value(LoadKind::stretch) == doctest::Approx(20).epsilon(1e-2));

  for (std::size_t i = 0; i < points.size(); ++i)
    if (i >= 10 && i < 16) points[i].w *= std::sqrt(0.5f);
  load = loadOf(network, points);
  CHECK(load.lumen == doctest::Approx(0.5f).epsilon(1e-3));
  CHECK(load.lumenPlace > 0.4f);
  CHECK(load.lumenPlace < 0.7f);
  CHECK(load.severity(LoadKind::squeeze, {.lumen = 0.5f}) == doctest::Approx(1).epsilon(1e-2));

  // r κ = 3 mm / 20 mm.
  for (vec4& p : points) {
    const float angle = (1 - p.y) / 1.2f / 0.02f;
    p = {0.02f * std::sin(angle), 1, 0.02f * std::cos(angle), 0.003f};
  }
  load = loadOf(network, points);
  CHECK(load.kink == doctest::Approx(0.15f).epsilon(0.05));
}
