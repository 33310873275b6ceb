#include "avoid/contact_pool.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <vector>

#include "network/builder.h"

using namespace vasa;

namespace {

Bezier straight(vec3 from, vec3 to) {
  Bezier tube;
  for (int k = 0; k < 4; ++k) tube.b[std::size_t(k)] = vec4(glm::mix(from, to, float(k) / 3), 0.001f);
  return tube;
}

// One tube along z, and one beside it at an angle [degrees] around it.
std::array<Bezier, 2> pairAt(float degrees, float distance) {
  const float angle = glm::radians(degrees);
  const vec3 aside = distance * vec3(std::cos(angle), std::sin(angle), 0), along(0, 0, 0.01f);
  return {straight(vec3(0), along), straight(aside, aside + along)};
}

// From a place at 0 degrees.
bool keepsSideAt(float degrees, float distance, quat turn = quat(1, 0, 0, 0)) {
  const std::array<Bezier, 2> last = pairAt(0, 0.003f), now = pairAt(degrees, distance);
  const std::array<quat, 2> turns{turn, turn};
  const std::array<char, 2> anew{0, 0};
  return keepsSide({0, 1, 0.5f, 0.5f}, now, {last, turns, {}, anew});
}

}  // namespace

TEST_CASE("a vessel keeps its side as long as it lies within sixty degrees of where it lay") {
  CHECK(keepsSideAt(0, 0.001f));
  CHECK(keepsSideAt(55, 0.001f));
  CHECK_FALSE(keepsSideAt(65, 0.001f));
  CHECK_FALSE(keepsSideAt(180, 0.001f));  // it has passed through
  CHECK_FALSE(keepsSideAt(0, 0));
}

TEST_CASE("a limb that turns takes the side along") {
  const quat quarter = glm::angleAxis(glm::radians(90.0f), vec3(0, 0, 1));
  CHECK(keepsSideAt(90, 0.001f, quarter));
  CHECK_FALSE(keepsSideAt(0, 0.001f, quarter));
}

TEST_CASE("what an ascent would hardly move stays where it is, to the bit") {
  // Two vessels of a metre side by side, pressed into one another at one place.
  NetworkBuilder builder;
  for (const float x : {0.0f, 0.0021f}) {
    std::vector<vec4> points;
    for (int k = 0; k < 201; ++k) points.emplace_back(x, 0.005f * float(k), 0, 0.001f);
    builder.addVessel({"vessel", "", VesselKind::artery}, points);
  }
  const auto network = builder.build(1);
  REQUIRE(network.ok());
  Interference interference(*network);
  const MotionSpace space(*network, 200);
  const RestSides sides(*network, interference);
  ContactPool pool(space, interference, sides);
  std::vector<vec4> pressed(network->points().begin(), network->points().end());
  for (std::size_t p = 98; p < 103; ++p) pressed[p].x += 0.0005f;
  const auto places = interference.find(pressed, 1e-4f);
  REQUIRE_FALSE(places.empty());
  const std::vector<quat> still(pressed.size(), quat(1, 0, 0, 0));
  const std::vector<char> anew(interference.tubes().size(), 0);
  constexpr float kStill = 3e-6f;
  const std::vector<char> stayed(interference.tubes().size(), 0);
  const auto add = [&](std::span<const char> moved, std::span<vec3> z) {
    pool.refresh(interference.tubes(), z);
    pool.add(places, {}, interference.tubes(), {interference.restTubes(), still, still, anew}, moved, z);
    return pool.size();
  };
  const auto countMoved = [](std::span<const vec3> z) {
    return std::ranges::count_if(z, [](vec3 motion) { return motion != vec3(0); });
  };
  std::vector<vec3> z(space.variableCount(), vec3(0)), all = z;
  CHECK(add(stayed, z) == 0);
  CHECK(add({}, z) > 0);
  pool.ascend(200, kStill, z);
  for (const vec3& motion : z) CHECK((motion == vec3(0) || glm::length(motion) > kStill));
  CHECK(countMoved(std::span(z).subspan(98, 5)) == 5);
  pool.clear();
  add({}, all);
  pool.ascend(200, 0, all);
  CHECK(countMoved(z) < countMoved(all));
  for (std::size_t v = 0; v < z.size(); ++v) CHECK(glm::distance(z[v], all[v]) <= kStill);
}
