#include "edit/redraw.h"

#include <doctest/doctest.h>

#include <algorithm>

#include "curve/arc_length.h"
#include "edit/bump.h"

using namespace vasa;

namespace {

// A helix of 20 spans, some 300 mm long.
std::vector<vec4> helix() {
  std::vector<vec4> points;
  for (int i = 0; i < 23; ++i) {
    const float angle = 0.35f * float(i);
    points.emplace_back(0.03f * std::cos(angle), 0.03f * std::sin(angle), 0.01f * float(i),
                        0.004f - 0.00008f * float(i));
  }
  return points;
}

// The farthest that one course is from another, at the same arc length.
float farthest(std::span<const vec4> a, std::span<const vec4> b, float from, float to) {
  const ArcLength along(a), other(b);
  float most = 0;
  for (int k = 0; k <= 500; ++k) {
    const float s = std::lerp(from, to, float(k) / 500);
    most =
        std::max(most, glm::distance(evaluate(a, along.parameterAt(s)), evaluate(b, other.parameterAt(s))));
  }
  return most;
}

}  // namespace

TEST_CASE(
    "a stretch drawn anew with nothing changed stays where it was; what is far keeps its points to the last bit") {
  const auto points = helix();
  const ArcLength arc(points);
  const float middle = 0.5f * arc.length();
  const Redrawn drawn = redrawVessel(points, {middle - 0.006f, middle + 0.006f, 0.0012f, 0, 1e9f, {}});
  REQUIRE(drawn.points.size() > points.size());
  CHECK(drawn.points.size() < points.size() + 30);
  CHECK(drawn.centreError < 8e-5f);
  CHECK(farthest(points, drawn.points, 0, arc.length()) < 1e-4f);
  const std::size_t more = drawn.points.size() - points.size();
  for (std::uint32_t j = 0; j <= std::uint32_t(drawn.changedFrom) + 2; ++j)
    CHECK(drawn.points[j] == points[j]);
  for (std::uint32_t j = std::uint32_t(drawn.changedTo); j < points.size(); ++j)
    CHECK(drawn.points[j + more] == points[j]);
  CHECK(drawn.changedFrom >= 3);
  CHECK(drawn.changedTo <= 17);
  // Places keep where they are: exactly far off, within a fortieth of the radius elsewhere.
  CHECK(drawn.place(1.5f) == 1.5f);
  CHECK(drawn.place(19.25f) == 19.25f + float(more));
  for (int k = 0; k <= 100; ++k) {
    const float u = 20 * float(k) / 100;
    CHECK(glm::distance(vec3(evaluate(points, u)), vec3(evaluate(drawn.points, drawn.place(u)))) < 1e-4f);
  }
}

TEST_CASE("a radius is drawn as it was asked for, in the middle and over an end") {
  const auto points = helix();
  const ArcLength arc(points);
  for (const float middle : {0.5f * arc.length(), 0.004f, arc.length() - 0.004f}) {
    Redrawing redrawing{std::max(middle - 0.006f, 0.0f), std::min(middle + 0.006f, arc.length()), 0.0012f};
    redrawing.shape = [&](float along, vec4 was) {
      return vec4(vec3(was), was.w * (1 - 0.7f * bump((along - middle) / 0.006f)));
    };
    const Redrawn drawn = redrawVessel(points, redrawing);
    CHECK(drawn.radiusError < 0.006f);
    const ArcLength now(drawn.points);
    for (int k = 0; k <= 300; ++k) {
      const float s = arc.length() * float(k) / 300, was = evaluate(points, arc.parameterAt(s)).w;
      CHECK(evaluate(drawn.points, now.parameterAt(s)).w ==
            doctest::Approx(was * (1 - 0.7f * bump((s - middle) / 0.006f))).epsilon(0.01));
    }
  }
}

TEST_CASE("cutting an end off keeps the course of the rest") {
  const auto points = helix();
  const ArcLength arc(points);
  const float at = 0.4f * arc.length();
  const Redrawn head = redrawVessel(points, {at, at, 0.015f, 0, at, {}});
  CHECK(ArcLength(head.points).length() == doctest::Approx(at).epsilon(1e-3));
  CHECK(farthest(points, head.points, 0, at) < 1e-4f);
  CHECK(head.points[0] == points[0]);
  CHECK(head.points[3] == points[3]);
  const Redrawn tail = redrawVessel(points, {at, at, 0.015f, at, arc.length(), {}});
  CHECK(ArcLength(tail.points).length() == doctest::Approx(arc.length() - at).epsilon(1e-3));
  CHECK(tail.points.back() == points.back());
  CHECK(glm::distance(tail.points.front(), head.points.back()) < 1e-6f);
  CHECK(tail.place(20) == doctest::Approx(float(spanCount(tail.points))));
  CHECK(redrawVessel(points, {0, 0, 0.01f, at, at, {}}).points.empty());
}

TEST_CASE("vessels of one span can be drawn anew") {
  const std::vector<vec4> points{
      {0, 0, 0, 0.002f}, {0, 0, 0.01f, 0.002f}, {0, 0, 0.02f, 0.002f}, {0, 0, 0.03f, 0.002f}};
  Redrawing redrawing{0.01f, 0.02f, 0.001f};
  redrawing.shape = [](float along, vec4 was) {
    return vec4(vec3(was), was.w * (1 - 0.5f * bump((along - 0.015f) / 0.005f)));
  };
  const Redrawn drawn = redrawVessel(points, redrawing);
  CHECK(drawn.radiusError < 0.006f);
  CHECK(drawn.points.front() == points.front());
  CHECK(drawn.points.back() == points.back());
}
