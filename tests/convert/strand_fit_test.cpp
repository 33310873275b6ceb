#include "convert/strand_fit.h"

#include <doctest/doctest.h>

#include <cmath>

#include "convert/sources.h"
#include "curve/bspline.h"

using namespace vasa;
using namespace vasa::test;

TEST_CASE("a noisy tube costs no more spans than its budget and stays near its sections") {
  Sections sections;
  for (int i = 0; i <= 200; ++i) {
    const float noise = 0.0008f * std::sin(12.9898f * float(i) * float(i));
    sections.push_back(vec4(noise, 0.001f * float(i), 0, 0.002f + 0.3f * noise));
  }
  const auto points = fitStrand(sections);
  CHECK(float(spanCount(points)) <= 3 + lengthOf(sections) / 0.006f);  // three radii a span
  for (int i = 0; i <= 100; ++i) {
    const vec4 at = evaluate(points, float(spanCount(points)) * float(i) / 100);
    CHECK(std::abs(at.x) < 0.0015f);
    CHECK(at.w == doctest::Approx(0.002f).epsilon(0.3));
  }
}

TEST_CASE("widely spaced sections: the spline does not swing out between them") {
  const Sections sections{
      {0, 0, 0, 0.001f}, {0, 0.05f, 0, 0.001f}, {0.02f, 0.06f, 0, 0.001f}, {0.02f, 0.2f, 0, 0.001f}};
  const auto points = fitStrand(sections);
  for (int i = 0; i <= 200; ++i) {
    const vec4 at = evaluate(points, float(spanCount(points)) * float(i) / 200);
    CHECK(nearestAlong(sections, vec3(at)).distance < 0.002f);
  }
}

TEST_CASE("rings far apart on a bend: the spline follows the bend, not the corners of lines between them") {
  Sections sections;  // of a circle of 100 mm, 30 mm apart
  const auto at = [](float i) { return 0.1f * vec3(std::cos(0.3f * i), std::sin(0.3f * i), 0.1f * i); };
  for (int i = 0; i <= 12; ++i) sections.push_back(vec4(at(float(i)), 0.0015f));
  const auto points = fitStrand(sections);
  CHECK(spanCount(points) <= 12);
  for (float i = 0; i <= 12; i += 0.1f) {
    float away = 1e9f;
    for (float u = 0; u <= float(spanCount(points)); u += 0.01f)
      away = std::min(away, glm::distance(at(i), vec3(evaluate(points, u))));
    CHECK(away < 0.0005f);
  }
}

TEST_CASE("a slanted end loses its taper, a whole one nothing") {
  Sections sections = sectionsBetween({0, 0, 0}, {0, 0.05f, 0}, 0.004f, 0.001f);
  Sections whole = sections;
  for (int i = 0; i < 3; ++i) sections[sections.size() - 1 - std::size_t(i)].w = 0.001f * float(i + 1) * 0.8f;
  trimTaper(sections, true);
  CHECK(sections.back().y == doctest::Approx(0.047f));
  trimTaper(whole, true);
  trimTaper(whole, false);
  CHECK(whole.size() == 51);
}

TEST_CASE("the paper's way goes through every section, a span between two") {
  Sections sections;
  for (int i = 0; i <= 24; ++i) {
    const float t = 0.2f * float(i);
    sections.push_back(
        vec4(0.05f * std::cos(t), 0.01f * t, 0.05f * std::sin(t), 0.003f + 0.0005f * std::sin(3 * t)));
  }
  const auto through = fitStrand(sections, {.interpolate = true}), fitted = fitStrand(sections);
  REQUIRE(spanCount(through) == 24);
  CHECK(spanCount(fitted) < 24);
  for (std::uint32_t i = 0; i <= 24; ++i) {
    const vec4 at = evaluate(through, float(i));
    CHECK(glm::distance(vec3(at), vec3(sections[i])) < 1e-6f);
    CHECK(at.w == doctest::Approx(sections[i].w).epsilon(1e-4));
  }
}
