#include "curve/bounds.h"

#include <doctest/doctest.h>

#include <random>

#include "math/closest_point.h"

using namespace vasa;

namespace {

Bezier randomTube(std::mt19937& random, float size, float offset) {
  std::uniform_real_distribution<float> value(-1, 1);
  Bezier tube;
  for (vec4& p : tube.b) {
    p = vec4{size * value(random), size * value(random), size * value(random),
             size * (1.05f + value(random))};
    p += vec4(vec3(offset), 0);
  }
  return tube;
}

float distanceToSegment(vec3 p, const Capsule& c) {
  return glm::distance(p, glm::mix(c.a, c.b, closestOnSegment(p, c.a, c.b)));
}

}  // namespace

TEST_CASE("a straight, evenly spaced segment has no deviation") {
  const Bezier straight{{vec4(0, 0, 0, 1), vec4(1, 0, 0, 1), vec4(2, 0, 0, 1), vec4(3, 0, 0, 1)}};
  CHECK(filipConstant(straight) == 0);
  CHECK(boundingSphere(straight).centre == vec3(1.5f, 0, 0));
  CHECK(boundingSphere(straight).radius == doctest::Approx(2.5).epsilon(1e-5));
}

TEST_CASE("Filip's bound quarters with each level") {
  const Bezier arch{{vec4(0, 0, 0, 1), vec4(0, 1, 0, 1), vec4(1, 1, 0, 3), vec4(1, 0, 0, 1)}};
  CHECK(filipConstant(arch) == doctest::Approx(std::sqrt(2.0)));
  CHECK(filipRadiusConstant(arch) == 4);
  CHECK(filipBound(1, 0) == 0.75f);
  CHECK(filipBound(1, 2) == 0.75f / 16);
  CHECK(radiusBound(arch) == 3);
}

TEST_CASE("no tube leaves its bounds, whatever its size and place") {
  std::mt19937 random(3);
  for (int trial = 0; trial < 300; ++trial) {
    const float size = std::pow(10.0f, float(trial % 7) - 4), offset = trial % 3 == 0 ? 0.0f : 100 * size;
    const Bezier tube = randomTube(random, size, offset);
    const Sphere sphere = boundingSphere(tube);
    for (int k = 0; k <= 64; ++k) {
      const vec4 ball = tube.at(float(k) / 64);
      CHECK(glm::distance(vec3(ball), sphere.centre) + ball.w <= sphere.radius);
      CHECK(ball.w <= radiusBound(tube) * 1.00001f);
    }
    for (int level : {0, 1, 3, 6, 10}) {
      const int index = int(random() % (1u << level));
      const Capsule piece = pieceCapsule(tube, level, index);
      for (int k = 0; k <= 16; ++k) {
        const vec4 ball = tube.at((float(index) + float(k) / 16) / float(1 << level));
        CHECK(distanceToSegment(vec3(ball), piece) + ball.w <= piece.radius);
      }
    }
  }
}
