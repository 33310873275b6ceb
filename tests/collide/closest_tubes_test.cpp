#include "collide/closest_tubes.h"

#include <doctest/doctest.h>

#include <algorithm>

#include "random_tubes.h"

using namespace vasa;

namespace {

dvec4 at(const Bezier& tube, double t) {
  const double s = 1 - t;
  return s * s * s * dvec4(tube.b[0]) + 3 * s * s * t * dvec4(tube.b[1]) + 3 * s * t * t * dvec4(tube.b[2]) +
         t * t * t * dvec4(tube.b[3]);
}

double value(const Bezier& a, const Bezier& b, double s, double t) {
  const dvec4 p = at(a, s), q = at(b, t);
  return glm::distance(dvec3(p), dvec3(q)) - p.w - q.w;
}

// Dense samples, then a shrinking pattern search from each of the best few.
double sampledMinimum(const Bezier& a, const Bezier& b) {
  constexpr int kSteps = 48;
  std::vector<std::array<double, 3>> samples;
  for (int i = 0; i <= kSteps; ++i)
    for (int j = 0; j <= kSteps; ++j) {
      const double s = double(i) / kSteps, t = double(j) / kSteps;
      samples.push_back({value(a, b, s, t), s, t});
    }
  std::partial_sort(samples.begin(), samples.begin() + 8, samples.end());
  double least = samples[0][0];
  for (int start = 0; start < 8; ++start) {
    auto [f, s, t] = samples[std::size_t(start)];
    double step = 1.0 / kSteps;
    for (int round = 0; round < 400 && step > 1e-9; ++round) {
      bool moved = false;
      for (int k = 0; k < 8; ++k) {
        constexpr double kDirections[8][2] = {{1, 0}, {-1, 0},  {0, 1},  {0, -1},
                                              {1, 1}, {-1, -1}, {1, -1}, {-1, 1}};
        const double ns = glm::clamp(s + step * kDirections[k][0], 0.0, 1.0),
                     nt = glm::clamp(t + step * kDirections[k][1], 0.0, 1.0);
        const double nf = value(a, b, ns, nt);
        if (nf < f) f = nf, s = ns, t = nt, moved = true;
      }
      if (!moved) step *= 0.5;
    }
    least = std::min(least, f);
  }
  return least;
}

}  // namespace

TEST_CASE("two straight tubes that cross") {
  const Bezier a = test::straight({-1, 0, 0}, {1, 0, 0}, 0.25f),
               b = test::straight({0, -1, 0.6f}, {0, 1, 0.6f}, 0.25f);
  const Contact contact = closestOfTubes(a, b, 1e-9);
  CHECK(contact.f == doctest::Approx(0.1).epsilon(1e-5));
  CHECK(contact.s == doctest::Approx(0.5).epsilon(1e-3));
  CHECK(contact.normal.z == doctest::Approx(-1));
  CHECK(!tubesIntersect(a, b, 1e-9));
  CHECK(tubesIntersect(a, b, 1e-9, 0.11));
  CHECK(!tubesIntersect(a, b, 1e-9, 0.09));
}

TEST_CASE("the search agrees with dense sampling") {
  const auto tubes = test::randomTubes(40, 5, 0.05f, 0.04f, 0.003f);
  int meeting = 0;
  for (std::size_t i = 0; i < tubes.size(); ++i)
    for (std::size_t j = i + 1; j < tubes.size(); ++j) {
      const double sampled = sampledMinimum(tubes[i], tubes[j]);
      CHECK(closestOfTubes(tubes[i], tubes[j], 1e-9).f == doctest::Approx(sampled).scale(1e-3).epsilon(1e-4));
      if (std::abs(sampled) > 1e-7) CHECK(tubesIntersect(tubes[i], tubes[j], 1e-8) == (sampled < 0));
      meeting += sampled < 0;
    }
  CHECK(meeting > 15);
}

TEST_CASE("degenerate tubes have an answer") {
  const Bezier point = test::straight(vec3(0), vec3(0), 0.1f),
               line = test::straight({0.05f, 0, 0}, {1, 0, 0}, 0.01f);
  CHECK(tubesIntersect(point, point, 1e-9));
  CHECK(closestOfTubes(point, point, 1e-9).f == doctest::Approx(-0.2));
  CHECK(closestOfTubes(point, line, 1e-9).f == doctest::Approx(-0.06));
  const Bezier thin = test::straight({0, 1e-6f, 0}, {1, 1e-6f, 0}, 1e-20f),
               huge = test::straight({0, 2e5f, 0}, {1, 2e5f, 0}, 1e5f);
  CHECK(!tubesIntersect(thin, test::straight({0, 0, 0}, {1, 0, 0}, 1e-20f), 5e-8));
  CHECK(!tubesIntersect(thin, huge, 5e-8));
  CHECK(tubesIntersect(huge, test::straight({0, 0.5e5f, 0}, {0, 1e5f, 0}, 1e3f), 5e-8));
}

TEST_CASE("nearly parallel tubes that just miss or just touch") {
  for (int k = 0; k < 200; ++k) {
    const float tilt = std::pow(10.0f, -1 - float(k % 40) / 5);
    const Bezier a = test::straight({0, 0, 0}, {0.04f, 0, 0}, 0.001f);
    const float gap = 0.002f + (k % 2 ? 2e-7f : -2e-7f);
    const Bezier b = test::straight({0, gap, -0.02f * tilt}, {0.04f, gap, 0.02f * tilt}, 0.001f);
    const double f = double(gap) - 2 * double(0.001f);
    CHECK(tubesIntersect(a, b, 2e-8) == (f < 0));
  }
}
