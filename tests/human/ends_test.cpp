#include <algorithm>
#include <cctype>

#include "human/made_human.h"
#include "make_human/solid.h"
#include "make_human/taper.h"

using namespace vasa;
using namespace vasa::human;

namespace {

constexpr float kThin = 0.3e-3f;       // [m] where capillaries take over
constexpr float kStraightest = 0.98f;  // chord over length

bool isGrown(const Vessel& vessel) { return std::isdigit(static_cast<unsigned char>(vessel.name.back())); }

}  // namespace

TEST_CASE("what thins out does so over its last stretch and never widens") {
  std::vector<float> radii(21, 1e-3f);
  thinOut(radii, 0.1f, 0.1f);
  CHECK(radii.front() == 1e-3f);
  CHECK(radii.back() == doctest::Approx(0.25e-3f));
  CHECK(std::is_sorted(radii.rbegin(), radii.rend()));
  std::vector<float> thin(5, 0.2e-3f);
  thinOut(thin, 0.1f, 0.1f);
  CHECK(thin.back() == 0.2e-3f);
  std::vector<float> late(21, 1e-3f);
  thinOut(late, 0.1f, 0.005f);
  CHECK(late[18] == 1e-3f);
}

TEST_CASE("every vessel that ends freely has thinned out, but for those of the heart") {
  const Network& network = madeHuman().vessels;
  const Solid heart(madeHuman().meshes[2].mesh);
  int ends = 0, blunt = 0;
  for (const Vessel& vessel : network.vessels()) {
    const auto points = network.pointsOf(vessel);
    for (bool last : {false, true}) {
      if ((last ? vessel.end : vessel.start).valid()) continue;
      const vec4 tip = last ? points.back() : points.front();
      if (heart.at(vec3(tip), tip.w)) continue;
      ++ends;
      if (tip.w <= kThin) continue;
      ++blunt;
      MESSAGE(vessel.name << " ends " << 1e3f * tip.w << " mm thick");
    }
  }
  MESSAGE(ends << " ends");
  CHECK(ends > 500);
  CHECK(blunt == 0);
}

TEST_CASE("no grown vessel is straight") {
  const Network& network = madeHuman().vessels;
  int grown = 0, straight = 0;
  for (const Vessel& vessel : network.vessels()) {
    if (!isGrown(vessel)) continue;
    const auto points = network.pointsOf(vessel);
    ++grown;
    const bool is =
        glm::distance(vec3(points.front()), vec3(points.back())) > kStraightest * lengthOf(points);
    straight += is;
    if (is) MESSAGE(vessel.name << " is straight");
  }
  CHECK(grown > 20);
  CHECK(straight == 0);
}
