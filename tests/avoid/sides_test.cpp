#include "avoid/sides.h"

#include <doctest/doctest.h>

#include "support/networks.h"

using namespace vasa;

namespace {

// Two vessels that cross at an angle, `height` apart at rest.
Network crossing(float angle, float height) {
  NetworkBuilder builder;
  for (int v = 0; v < 2; ++v) {
    const vec3 along = v == 0 ? vec3(1, 0, 0) : vec3(std::cos(angle), 0, std::sin(angle));
    std::vector<vec4> points;
    for (int k = 0; k < 13; ++k)
      points.emplace_back(along * (0.012f * float(k - 6)) + vec3(0, v == 0 ? 0 : height, 0), 0.002f);
    builder.addVessel({"vessel " + std::to_string(v), "", VesselKind::vein}, points);
  }
  return test::built(builder);
}

// The second vessel is moved, then all is turned.
std::size_t changedAfter(const Network& network, vec3 move, quat turn = {1, 0, 0, 0}) {
  Interference interference(network);
  RestSides sides(network, interference);
  std::vector<vec4> points(network.points().begin(), network.points().end());
  for (std::uint32_t p = network.vessels()[1].firstPoint; p < points.size(); ++p) points[p] += vec4(move, 0);
  for (vec4& p : points) p = vec4(turn * vec3(p), p.w);
  const std::vector<quat> rotations(points.size(), turn);
  interference.find(points);
  std::vector<RestSides::Turned> changed;
  sides.findChanged(interference.tubes(), rotations, changed);
  return changed.size();
}

std::size_t changedAfter(const Network& network, float lowered, quat turn = {1, 0, 0, 0}) {
  return changedAfter(network, vec3(0, -lowered, 0), turn);
}

}  // namespace

TEST_CASE("vessels that pass through one another have changed sides, overlapping or not") {
  for (const float angle : {0.2f, 0.8f, 1.57f, 2.6f}) {
    CAPTURE(angle);
    const Network network = crossing(angle, 0.006f);
    CHECK(changedAfter(network, 0) == 0);
    CHECK(changedAfter(network, 0.004f) == 0);
    CHECK(changedAfter(network, 0.0075f) > 0);  // overlap beyond one another's centre lines
    CHECK(changedAfter(network, 0.013f) > 0);   // all the way through
    CHECK(changedAfter(network, 0.03f) == 0);   // so far from one another that they are on no side
  }
}

TEST_CASE("what lies ahead of a vessel's end is on no side of it") {
  for (const float ahead : {-0.02f, 0.006f}) {
    CAPTURE(ahead);
    NetworkBuilder builder;
    std::vector<vec4> along, across;
    for (int k = 0; k < 12; ++k) {
      const float way = float(k) / 11;
      along.emplace_back(-0.1f + 0.1f * way, 0, 0, 0.004f);
      across.emplace_back(ahead, 0.006f, -0.1f + 0.2f * way, 0.004f);
    }
    builder.addVessel({"along", "", VesselKind::artery}, along);
    builder.addVessel({"across", "", VesselKind::artery}, across);
    const auto network = builder.build(1);
    REQUIRE(network.ok());
    CHECK((changedAfter(*network, 0.013f) > 0) == (ahead < 0));
  }
}

TEST_CASE("vessels that cross are known by it however far they have slid along one another") {
  const Network network = crossing(1.2f, 0.006f);
  for (const float slid : {0.0f, 0.02f, 0.04f}) {
    CAPTURE(slid);
    CHECK(changedAfter(network, vec3(slid, 0, 0)) == 0);
    CHECK(changedAfter(network, vec3(slid, -0.013f, 0)) > 0);
  }
}

TEST_CASE("vessels that cross through one another's centre lines at rest are on no side of one another") {
  for (const float height : {0.0f, 0.0003f}) {
    CAPTURE(height);
    const Network network = crossing(1.2f, height);
    for (const float moved : {-0.002f, 0.002f}) CHECK(changedAfter(network, vec3(0, moved, 0)) == 0);
  }
}

TEST_CASE("vessels are on no side of one another where they are joined") {
  // A branch beside its host, which turns about it as far as to the other side.
  NetworkBuilder builder;
  std::vector<vec4> host, branch;
  for (int k = 0; k < 12; ++k) {
    const float way = float(k) / 11;
    host.emplace_back(0.2f * way - 0.1f, 0, 0, 0.004f);
    branch.emplace_back(0.06f * way, 0.04f * way, 0, 0.002f);
  }
  const VesselId trunk = builder.addVessel({"host", "", VesselKind::artery}, host);
  const VesselId side = builder.addVessel({"branch", "", VesselKind::artery}, branch);
  builder.joinToSide({side, false}, {trunk, 4.5f});
  const Network network = test::built(builder);
  Interference interference(network);
  RestSides sides(network, interference);
  std::vector<vec4> points(network.points().begin(), network.points().end());
  for (std::uint32_t p = network.vessels()[1].firstPoint; p < points.size(); ++p) points[p].y *= -1;
  interference.find(points);
  std::vector<RestSides::Turned> changed;
  sides.findChanged(interference.tubes(), std::vector<quat>(points.size(), quat(1, 0, 0, 0)), changed);
  CHECK(changed.empty());
}

TEST_CASE("a turn of the whole changes nothing") {
  const quat turn = glm::angleAxis(2.0f, glm::normalize(vec3(1, 2, -1)));
  CHECK(changedAfter(crossing(1.2f, 0.006f), 0, turn) == 0);
  CHECK(changedAfter(crossing(1.2f, 0.006f), 0.013f, turn) > 0);
}
