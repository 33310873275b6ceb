#include "curve/fit.h"

#include <doctest/doctest.h>

#include <cmath>
#include <random>

#include "curve/bspline.h"

using namespace vasa;

TEST_CASE("a straight tapering run of sections is one span") {
  std::vector<vec4> samples;
  for (int i = 0; i <= 10; ++i) samples.push_back({0.01f * float(i), 0, 0, 0.004f - 0.0002f * float(i)});
  const Fit fit = fitSplineMeasured(samples, {});
  REQUIRE(fit.points.size() == 4);
  CHECK(fit.points.front() == samples.front());
  CHECK(fit.points.back() == samples.back());
  CHECK(fit.error < 0.05f);
  CHECK(evaluate(fit.points, 0.5f).w == doctest::Approx(0.003).epsilon(0.01));
}

TEST_CASE("two samples, worked by hand: points at thirds") {
  const std::vector<vec4> samples{{0, 0, 0, 0.001f}, {0.03f, 0, 0, 0.004f}};
  const auto points = fitSpline(samples, {});
  REQUIRE(points.size() == 4);
  CHECK(glm::distance(points[1], vec4(0.01f, 0, 0, 0.002f)) < 1e-8f);
  CHECK(glm::distance(points[2], vec4(0.02f, 0, 0, 0.003f)) < 1e-8f);
}

TEST_CASE("samples of a cubic Bézier give that Bézier back") {
  const Bezier bezier{{vec4(0, 0, 0, 0.01f), vec4(0.1f, 0.1f, 0, 0.012f), vec4(0.2f, -0.1f, 0.1f, 0.008f),
                       vec4(0.3f, 0, 0, 0.01f)}};
  std::vector<vec4> samples;
  for (int i = 0; i <= 60; ++i) samples.push_back(bezier.at(float(i) / 60));
  FitOptions options;
  options.position = options.radius = {0, 1e-4f, 1e-4f};
  const Fit fit = fitSplineMeasured(samples, options);
  CHECK(spanCount(fit.points) <= 6);  // parameters settle slowly; 1 would do
  CHECK(fit.error <= 1);
}

TEST_CASE("a narrow bend on a long straight way takes spans where it is, not all along") {
  std::vector<vec4> samples;
  for (int i = 0; i <= 800; ++i) {
    const float x = 0.4f * float(i) / 800, off = (x - 0.13f) / 0.003f;
    samples.push_back({x, 0.004f * std::exp(-off * off), 0, 0.002f});
  }
  FitOptions options;
  options.position = options.radius = {0, 2e-4f, 2e-4f};
  const Fit fit = fitSplineMeasured(samples, options);
  CHECK(fit.error <= 1);
  CHECK(spanCount(fit.points) <= 20);  // 64 where all are alike
}

TEST_CASE(
    "random smooth vessels: within tolerance, ends exact, radii positive, fewer spans for more tolerance") {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> value(-1, 1);
    const float a = value(random), b = value(random), c = value(random);
    std::vector<vec4> samples;
    for (int i = 0; i <= 200; ++i) {
      const float t = float(i) / 200;
      samples.push_back({0.3f * t, 0.03f * std::sin(9 * t + a), 0.02f * std::cos(7 * t + b),
                         0.003f + 0.001f * std::sin(5 * t + c)});
    }
    FitOptions fine, coarse;
    fine.position = fine.radius = {0.02f, 2e-5f, 1e-4f};
    coarse.position = coarse.radius = {0.2f, 2e-4f, 1e-3f};
    const Fit tight = fitSplineMeasured(samples, fine), loose = fitSplineMeasured(samples, coarse);
    CHECK(tight.error <= 1);
    CHECK(loose.error <= 1);
    CHECK(loose.points.size() < tight.points.size());
    CHECK(tight.points.size() < 60);
    for (const Fit* fit : {&tight, &loose}) {
      CHECK(fit->points.front() == samples.front());
      CHECK(fit->points.back() == samples.back());
      for (const vec4& p : fit->points) CHECK(p.w > 0);
    }
    // The promise, checked without the fit's own parameters.
    std::vector<vec4> course;
    for (int i = 0; i <= 12000; ++i)
      course.push_back(evaluate(tight.points, float(i) / 12000 * float(spanCount(tight.points))));
    for (const vec4& sample : samples) {
      float nearest = 1;
      for (const vec4& p : course) nearest = std::min(nearest, glm::distance(vec3(p), vec3(sample)));
      CHECK(nearest <= fine.position.at(sample.w) * 1.05f + 2e-5f);
    }
  }
}

TEST_CASE("repeated, jumping and turning samples still give a finite spline") {
  const std::vector<vec4> still(5, vec4(1, 2, 3, 0.01f));
  for (const vec4& p : fitSpline(still, {})) CHECK(p == still[0]);
  const std::vector<vec4> back{{0, 0, 0, 0.01f},   {0.1f, 0, 0, 0.01f},    {0.1f, 0, 0, 0.01f},
                               {0, 0, 0, 0.0001f}, {0.1f, 0.2f, 0, 0.02f}, {0, 0, 0, 0.01f}};
  const Fit fit = fitSplineMeasured(back, {});
  for (const vec4& p : fit.points) {
    CHECK(std::isfinite(p.x + p.y + p.z + p.w));
    CHECK(p.w > 0);
  }
  CHECK(fit.points.size() <= back.size() + 2);
}
