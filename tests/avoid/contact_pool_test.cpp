#include "avoid/contact_pool.h"

#include <doctest/doctest.h>

#include <array>
#include <cmath>

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
