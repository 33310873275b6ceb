#include "surface/section.h"

#include <doctest/doctest.h>

#include <random>

#include "surface/sweep_template.h"

using namespace vasa;

namespace {

const quat kIdentity(1, 0, 0, 0);

}  // namespace

TEST_CASE("a cone's normals lean by dr/ds") {
  // radius falls from 2 to 1 over a length of 3: slope -1/3, N = (cos, sin, 1/3) normalised
  const Bezier cone{{vec4(0, 0, 0, 2), vec4(0, 0, 1, 5.0f / 3), vec4(0, 0, 2, 4.0f / 3), vec4(0, 0, 3, 1)}};
  const Section section = sectionAt(cone, vec3(0, 0, 3), kIdentity, kIdentity, 0.5f);
  CHECK(section.radius == doctest::Approx(1.5));
  CHECK(section.slope == doctest::Approx(-1.0 / 3));
  const SurfacePoint point = surfacePoint(section, {1, 0});
  CHECK(glm::distance(point.position, vec3(1.5f, 0, 1.5f)) < 1e-6f);
  CHECK(glm::distance(point.normal, glm::normalize(vec3(1, 0, 1.0f / 3))) < 1e-6f);
}

TEST_CASE("normals are those of the surface, by central differences on random sweeps") {
  std::mt19937 engine(3);
  std::uniform_real_distribution<float> jitter(-0.2f, 0.2f);
  int checked = 0;
  for (int trial = 0; trial < 200; ++trial) {
    Bezier bezier;
    for (int i = 0; i < 4; ++i)
      bezier.b[i] = vec4(jitter(engine), jitter(engine), float(i) * 0.4f + jitter(engine),
                         0.1f + 0.3f * jitter(engine));
    const float t = 0.25f + 0.01f * float(trial % 50), h = 1e-3f;
    const auto at = [&](float u) { return sectionAt(bezier, vec3(0, 0, 1), kIdentity, kIdentity, u); };
    const Section section = at(t);
    for (const vec2 d : ringDirections(5)) {
      const vec3 direction = d.x * section.frame.u + d.y * section.frame.v;
      if (section.radius * glm::dot(section.curvature, direction) > 0.8f) continue;
      const vec3 along = surfacePoint(at(t + h), d).position - surfacePoint(at(t - h), d).position;
      const vec3 around = glm::cross(section.frame.tangent, direction);
      const vec3 normal = glm::normalize(glm::cross(around, along));
      CHECK(glm::distance(normal, surfacePoint(section, d).normal) < 5e-3f);
      ++checked;
    }
  }
  CHECK(checked > 800);
}

TEST_CASE("where the curve stands still the chord gives the direction") {
  const vec4 p(0, 0, 0, 1), q(0, 2, 0, 1);
  const Section start = sectionAt(Bezier{{p, p, q, q}}, vec3(5, 0, 0), kIdentity, kIdentity, 0);
  CHECK(glm::distance(start.frame.tangent, vec3(0, 1, 0)) < 1e-6f);
  CHECK(start.slope == 0);
  const Section point = sectionAt(Bezier{{p, p, p, p}}, vec3(5, 0, 0), kIdentity, kIdentity, 0.3f);
  CHECK(glm::distance(point.frame.tangent, vec3(1, 0, 0)) < 1e-6f);
  const Section nothing = sectionAt(Bezier{{p, p, p, p}}, vec3(0), kIdentity, kIdentity, 0.3f);
  CHECK(nothing.frame.tangent == vec3(0, 0, 1));
  CHECK(std::isfinite(surfacePoint(nothing, {0, 1}).normal.x));
}

TEST_CASE("normals stay finite where a bend folds over itself") {
  const Bezier hairpin{
      {vec4(0, 0, 0, 1), vec4(0, 0, 1, 0.8f), vec4(0.1f, 0, 1, 0.7f), vec4(0.1f, 0, 0, 0.5f)}};
  for (int i = 0; i <= 20; ++i) {
    const Section section = sectionAt(hairpin, vec3(0.1f, 0, 0), kIdentity, kIdentity, float(i) / 20);
    for (const vec2 d : ringDirections(16))
      CHECK(glm::length(surfacePoint(section, d).normal) == doctest::Approx(1).epsilon(1e-5));
  }
}

TEST_CASE("a cap starts on the tube's ring and ends a radius beyond the centre") {
  const Bezier tube{{vec4(0, 0, 0, 0.5f), vec4(0, 0, 1, 0.5f), vec4(0, 0, 2, 0.5f), vec4(0, 0, 3, 0.5f)}};
  const Section end = sectionAt(tube, vec3(0, 0, 3), kIdentity, kIdentity, 1);
  const std::vector<vec2> angles = capAngles();
  CHECK(capPoint(end, {0, 1}, angles.front(), 1).position == surfacePoint(end, {0, 1}).position);
  CHECK(glm::distance(capPoint(end, {1, 0}, angles.back(), 1).position, vec3(0, 0, 3.5f)) < 1e-6f);
  CHECK(glm::distance(capPoint(end, {1, 0}, angles.back(), -1).normal, vec3(0, 0, -1)) < 1e-6f);
}
