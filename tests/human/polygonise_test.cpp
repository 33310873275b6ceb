#include "make_human/polygonise.h"

#include <doctest/doctest.h>

#include <cmath>

#include "curve/bspline.h"
#include "make_human/table.h"
#include "make_human/through.h"

using namespace vasa;
using namespace vasa::human;

TEST_CASE("a ball polygonised at two sizes keeps its area and volume and stays closed") {
  const float radius = 0.1f;
  const ImplicitSurface ball{[&](vec3 p) { return glm::length(p) - radius; },
                             [](vec3 p, float reach) { return p.y + reach > 0 ? 0.004f : 0.02f; },
                             {vec3(-radius), vec3(radius)}};
  const TriangleMesh mesh = polygonise(ball, 0.02f);
  CHECK(mesh.area() == doctest::Approx(4 * double(kPi) * 0.01).epsilon(0.01));
  CHECK(mesh.volume() == doctest::Approx(4.0 / 3 * double(kPi) * 0.001).epsilon(0.015));
  // A closed surface of genus 0: V - E + F = 2 with 2 E = 3 F.
  CHECK(mesh.positions.size() * 2 == mesh.triangles.size() + 4);
}

TEST_CASE("a curve through points passes through them and its B-spline through its knots") {
  const std::vector<vec3> waypoints{{0, 0, 0}, {0.1f, 0.02f, 0}, {0.15f, 0.1f, 0.03f}, {0.1f, 0.2f, 0.05f}};
  const ThroughPoints curve(waypoints);
  for (std::size_t i = 0; i < waypoints.size(); ++i)
    CHECK(glm::distance(curve.position(curve.lengthAt(i)), waypoints[i]) < 1e-5f);
  std::vector<vec3> knots;
  const float length = curve.lengthAt(3);
  for (int k = 0; k <= 8; ++k) knots.push_back(curve.position(length * float(k) / 8));
  std::vector<vec4> points;
  for (vec3 p : interpolateAtKnots(knots, curve.tangent(0), curve.tangent(length)))
    points.emplace_back(p, 0.001f);
  REQUIRE(points.size() == 11);
  for (int k = 0; k <= 8; ++k)
    CHECK(glm::distance(vec3(evaluate(points, float(k))), knots[std::size_t(k)]) < 1e-5f);
  const vec3 start = glm::normalize(vec3(evaluateDerivative(points, 0)));
  CHECK(glm::distance(start, curve.tangent(0)) < 1e-3f);
}

TEST_CASE("numbers of a table are finite decimals and nothing else") {
  CHECK(*parseNumber("-2.5") == -2.5f);
  CHECK_FALSE(parseNumber("2.5mm").ok());
  CHECK_FALSE(parseNumber("").ok());
  CHECK_FALSE(parseNumber("inf").ok());
  CHECK(*parseVector("1  -2 3") == vec3(1, -2, 3));
  CHECK_FALSE(parseVector("1 2").ok());
}
