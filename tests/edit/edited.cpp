#include "edit/edited.h"

#include <doctest/doctest.h>

#include <algorithm>

#include "curve/arc_length.h"
#include "curve/fit.h"
#include "network/builder.h"

namespace vasa::test {
namespace {

std::vector<vec4> line(vec3 from, vec3 to, float r0, float r1, std::uint32_t spans) {
  std::vector<vec4> points;
  for (std::uint32_t j = 0; j < spans + 3; ++j) {
    const float share = float(greville(j, spans)) / float(spans);
    points.emplace_back(glm::mix(from, to, share), glm::mix(r0, r1, share));
  }
  return points;
}

template <class Better>
float extremeRadius(const Network& network, const std::string& name, Better better) {
  const auto points = pointsOf(network, name);
  float best = points.front().w;
  for (std::uint32_t k = 0; k <= 32 * spanCount(points); ++k)
    best = better(best, evaluate(points, float(k) / 32).w);
  return best;
}

}  // namespace

Network smallTree() {
  NetworkBuilder builder;
  const VesselId trunk =
      builder.addVessel({"trunk", "", VesselKind::artery}, line({0, 1, 0}, {0, 1, 0.2f}, 0.005f, 0.004f, 10));
  const VesselId side = builder.addVessel({"side", "", VesselKind::artery},
                                          line({0, 1, 0.08f}, {0.06f, 1, 0.08f}, 0.002f, 0.002f, 6));
  const VesselId twig = builder.addVessel({"twig", "", VesselKind::artery},
                                          line({0.04f, 1, 0.08f}, {0.04f, 1.03f, 0.08f}, 0.001f, 0.001f, 3));
  builder.addVessel({"far", "", VesselKind::vein}, line({0, 1.04f, 0}, {0, 1.04f, 0.2f}, 0.003f, 0.003f, 10));
  builder.joinToSide({side, false}, {trunk, 4});
  builder.joinToSide({twig, false}, {side, 4});
  auto built = builder.build(1.7f);
  REQUIRE(built.ok());
  return std::move(*built);
}

Replay replayed(const Network& network, const std::string& journal) {
  const auto edits = parseJournal(journal, "t.vedit");
  REQUIRE_MESSAGE(edits.ok(), edits.error().message);
  return replayEdits(network, *edits);
}

Network edited(const Network& network, const std::string& journal) {
  Replay replay = replayed(network, journal);
  for (const ReplayRow& row : replay.rows) REQUIRE_MESSAGE(row.applied(), row.refusal);
  return std::move(replay.network);
}

std::string refusalOf(const Network& network, const std::string& journal) {
  const Replay replay = replayed(network, journal);
  REQUIRE(replay.rows.size() == 1);
  REQUIRE_MESSAGE(!replay.rows[0].applied(), replay.rows[0].change);
  CHECK(std::ranges::equal(replay.network.points(), network.points()));
  CHECK(replay.network.vessels().size() == network.vessels().size());
  CHECK(replay.network.nodes().size() == network.nodes().size());
  return replay.rows[0].refusal;
}

const Vessel& vesselNamed(const Network& network, const std::string& name) {
  for (const Vessel& vessel : network.vessels())
    if (vessel.name == name) return vessel;
  FAIL("no vessel is named " << name);
  return network.vessels()[0];
}

std::span<const vec4> pointsOf(const Network& network, const std::string& name) {
  return network.pointsOf(vesselNamed(network, name));
}

vec4 at(const Network& network, const std::string& name, float share) {
  const auto points = pointsOf(network, name);
  const ArcLength arc(points);
  return evaluate(points, arc.parameterAt(share * arc.length()));
}

float leastRadius(const Network& network, const std::string& name) {
  return extremeRadius(network, name, [](float a, float b) { return std::min(a, b); });
}

float greatestRadius(const Network& network, const std::string& name) {
  return extremeRadius(network, name, [](float a, float b) { return std::max(a, b); });
}

}  // namespace vasa::test
