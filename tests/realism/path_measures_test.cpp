#include "realism/path_measures.h"

#include <glm/gtc/constants.hpp>

#include "realism/lines.h"

using namespace vasa;

namespace {

struct Case {
  Network network = test::landmarkNetwork();
  VesselPath path;
  Case() {
    auto found = PathFinder(network).find("left high", "left low");
    REQUIRE(found.ok());
    path = *found;
  }
  template <class Move>
  std::vector<vec4> moved(const Move& move) const {
    std::vector<vec4> points;
    for (const vec4& p : network.points()) points.emplace_back(move(vec3(p)), p.w);
    return points;
  }
};

}  // namespace

TEST_CASE("at rest a straight path has its length, no strain, no bend, no twist") {
  const Case c;
  const std::vector<quat> still(c.network.points().size(), quat(1, 0, 0, 0));
  const PathMeasures rest = measurePath(c.network, c.path, c.network.points(), still);
  CHECK(rest.length == doctest::Approx(0.1f).epsilon(1e-3));
  CHECK(std::abs(rest.strain) < 1e-5f);
  CHECK(rest.chordByArc == doctest::Approx(1));
  CHECK(rest.meanCurvature < 0.01f);
  CHECK(rest.leastBendRadius > 10);
  CHECK(rest.twist == 0);
  CHECK(rest.meanRadius == doctest::Approx(0.003f));
}

TEST_CASE("an arc has the arc's radius and chord, a squeezed path its strain") {
  const Case c;
  const float radius = 0.05f;
  const auto bent = c.moved([&](vec3 p) {
    const float angle = (1 - p.y) / radius;
    return vec3(0.1f + radius * (1 - std::cos(angle)), 1 - radius * std::sin(angle), p.z);
  });
  const PathMeasures arc = measurePath(c.network, c.path, bent, {});
  CHECK(1 / arc.meanCurvature == doctest::Approx(radius).epsilon(0.02));
  CHECK(arc.leastBendRadius == doctest::Approx(radius).epsilon(0.05));
  CHECK(arc.chordByArc == doctest::Approx(std::sin(1.0f)).epsilon(0.01));  // of 2 radians: 2 sin(1) / 2
  const auto squeezed =
      c.moved([](vec3 p) { return vec3(p.x, p.y > 0.9f ? 0.9f + 0.6f * (p.y - 0.9f) : p.y, p.z); });
  const PathMeasures half = measurePath(c.network, c.path, squeezed, {});
  CHECK(half.strain == doctest::Approx(-0.2f).epsilon(0.02));
  CHECK(half.leastStrain == doctest::Approx(-0.4f).epsilon(0.02));
}

TEST_CASE("what the surroundings turn about the course is twist; what they turn the course with is not") {
  const Case c;
  const float whole = glm::radians(60.0f);  // over the 10 cm of the path, and on at the same rate
  std::vector<quat> turning, turned;
  const quat over = glm::angleAxis(0.7f, glm::normalize(vec3(1, 2, 1)));
  for (const vec4& p : c.network.points()) {
    turning.push_back(over * glm::angleAxis(whole * (0.95f - p.y) / 0.1f, vec3(0, -1, 0)));
    turned.push_back(over);
  }
  const auto points = c.moved([&](vec3 p) { return over * p; });
  CHECK(measurePath(c.network, c.path, points, turned).twist == doctest::Approx(0).epsilon(1e-4));
  const PathMeasures twisted = measurePath(c.network, c.path, points, turning);
  CHECK(std::abs(twisted.twist) == doctest::Approx(whole).epsilon(0.01));
  CHECK(twisted.greatestTwist == doctest::Approx(whole / 0.1f).epsilon(0.02));
}
