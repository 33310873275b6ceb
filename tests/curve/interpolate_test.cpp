#include <doctest/doctest.h>

#include <random>

#include "curve/bspline.h"
#include "curve/interpolate.h"

using namespace vasa;

namespace {

float largestMiss(const std::vector<vec4>& samples, const SampledSpline& spline) {
  float miss = 0;
  for (std::size_t i = 0; i < samples.size(); ++i)
    miss = std::max(miss, glm::distance(evaluate(spline.points, spline.parameters[i]), samples[i]));
  return miss;
}

}  // namespace

TEST_CASE("two samples give a straight sweep") {
  const std::vector<vec4> samples{{0, 0, 0, 1}, {3, 0, 0, 4}};
  const SampledSpline spline = interpolateSamples(samples);
  REQUIRE(spline.points.size() == 4);
  CHECK(spline.points[1] == vec4(1, 0, 0, 2));
  CHECK(spline.points[2] == vec4(2, 0, 0, 3));
  CHECK(spline.parameters == std::vector<float>{0, 1});
}

TEST_CASE("evenly spaced samples of a line stay a line, a span between two of them") {
  std::vector<vec4> samples;
  for (int i = 0; i < 6; ++i) samples.push_back(vec4(0.1f * float(i), 0, 0, 0.02f));
  const SampledSpline spline = interpolateSamples(samples);
  CHECK(spline.points.size() == 8);
  CHECK(largestMiss(samples, spline) < 1e-6f);
  CHECK(evaluate(spline.points, 2.5f).x == doctest::Approx(0.25));
}

TEST_CASE("jagged samples are met, and no radius coefficient falls towards zero") {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> step(-1, 1), radius(0.05f, 1.0f);
  for (int round = 0; round < 200; ++round) {
    std::vector<vec4> samples{{0, 0, 0, radius(random)}};
    for (int i = 0; i < 3 + round % 40; ++i) {
      const float scale = i % 5 == 0 ? 3.0f : 0.2f;
      samples.push_back(
          vec4(vec3(samples.back()) + scale * vec3(step(random), step(random), 0.01f + step(random)),
               radius(random)));
    }
    const SampledSpline spline = interpolateSamples(samples);
    CHECK(largestMiss(samples, spline) < 1e-4f);
    for (const vec4& p : spline.points) CHECK(p.w > 0.01f);
  }
}

TEST_CASE("smooth samples are followed with few spans, within the tolerance at each parameter") {
  std::vector<vec4> samples;
  for (int i = 0; i <= 300; ++i) {
    const float t = float(i) / 300 + (i % 7 == 3 ? 0.003f : 0.0f);  // uneven steps
    samples.push_back(vec4(std::cos(3 * t), std::sin(3 * t), t, 0.1f + 0.02f * std::sin(8 * t)));
  }
  const SampledSpline spline = followSamples(samples, 0.05f, 0.005f);
  REQUIRE(spline.parameters.size() == samples.size());
  CHECK(spline.points.size() < 80);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const vec4 at = evaluate(spline.points, spline.parameters[i]);
    CHECK(glm::distance(vec3(at), vec3(samples[i])) <= 0.0501f * samples[i].w);
    CHECK(std::abs(at.w - samples[i].w) <= 0.00501f * samples[i].w);
    if (i > 0) CHECK(spline.parameters[i] >= spline.parameters[i - 1]);
  }
}
