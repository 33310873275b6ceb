#include "curve/frame.h"

#include <doctest/doctest.h>

#include <random>

#include "curve/bspline.h"

using namespace vasa;

namespace {

std::vector<vec4> wavyVessel(std::uint32_t spans, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> side(-0.3f, 0.3f);
  std::vector<vec4> points;
  for (std::uint32_t i = 0; i < spans + 3; ++i)
    points.push_back({side(random), float(i), side(random), 0.1f});
  return points;
}

bool orthonormal(const Frame& f) {
  return std::abs(glm::dot(f.u, f.v)) < 1e-5f && std::abs(glm::dot(f.u, f.tangent)) < 1e-5f &&
         std::abs(glm::length(f.u) - 1) < 1e-5f && glm::distance(glm::cross(f.u, f.v), f.tangent) < 1e-5f;
}

}  // namespace

TEST_CASE("along a straight line and a plane arc nothing turns") {
  std::vector<vec3> points, tangents;
  for (int i = 0; i <= 20; ++i) {
    const float a = float(i) / 20 * kPi;  // half a circle in the x-y plane
    points.push_back({std::cos(a), std::sin(a), 0});
    tangents.push_back({-std::sin(a), std::cos(a), 0});
  }
  std::vector<Frame> frames(points.size());
  minimisingFrames(points, tangents, {0, 0, 1}, frames);
  for (const Frame& f : frames) CHECK(glm::distance(f.u, vec3(0, 0, 1)) < 1e-5f);
}

TEST_CASE("four steps a span come near the exact minimising frame") {
  for (unsigned seed = 0; seed < 20; ++seed) {
    const auto points = wavyVessel(6, seed);
    std::vector<quat> knots(7);
    knotFrames(points, {1, 0, 0}, knots);
    std::vector<vec3> fine, tangents;
    for (int i = 0; i <= 6 * 200; ++i) {
      fine.push_back(vec3(evaluate(points, float(i) / 200)));
      tangents.push_back(unitTangent(points, float(i) / 200));
    }
    std::vector<Frame> exact(fine.size());
    minimisingFrames(fine, tangents, {1, 0, 0}, exact);
    CHECK(glm::dot(knots.back() * vec3(1, 0, 0), exact.back().u) > std::cos(0.01f));
  }
}

TEST_CASE("knot frames are orthonormal, follow the tangent, and neighbours share a hemisphere") {
  const auto points = wavyVessel(9, 5);
  std::vector<quat> knots(10);
  knotFrames(points, {0, 0, 1}, knots);
  for (std::uint32_t i = 0; i < knots.size(); ++i) {
    CHECK(glm::distance(knots[i] * vec3(0, 0, 1), unitTangent(points, float(i))) < 1e-5f);
    if (i) CHECK(glm::dot(knots[i], knots[i - 1]) >= 0);
  }
  for (int step = 0; step < 90; ++step) {
    const float u = float(step) / 10;
    const Frame f = interpolateFrame(knots[std::uint32_t(u)], knots[std::uint32_t(u) + 1], u - std::floor(u),
                                     unitTangent(points, u));
    CHECK(orthonormal(f));
  }
}

TEST_CASE("degenerate input still gives frames: equal points, a parallel reference, no length") {
  const std::vector<vec3> points(3, vec3(1)), tangents(3, vec3(0, 1, 0));
  std::vector<Frame> frames(3);
  minimisingFrames(points, tangents, {0, 1, 0}, frames);
  for (const Frame& f : frames) CHECK(orthonormal(f));
  const std::vector<vec4> dot(5, vec4(2, 2, 2, 1));
  std::vector<quat> knots(3);
  knotFrames(dot, {1, 0, 0}, knots);
  for (const quat& q : knots) CHECK(glm::length(q) == doctest::Approx(1));
}

TEST_CASE("turning the vessel and its reference turns the frames") {
  const auto points = wavyVessel(5, 8);
  const quat turn = glm::angleAxis(1.1f, glm::normalize(vec3(1, 2, 3)));
  std::vector<vec4> turned;
  for (const vec4& p : points) turned.push_back(vec4(turn * vec3(p), p.w));
  std::vector<quat> a(6), b(6);
  knotFrames(points, {1, 0, 0}, a);
  knotFrames(turned, turn * vec3(1, 0, 0), b);
  for (std::size_t i = 0; i < a.size(); ++i) CHECK(std::abs(glm::dot(turn * a[i], b[i])) > 0.99999f);
}
