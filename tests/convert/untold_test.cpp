#include "convert/untold.h"

#include <doctest/doctest.h>

#include <cmath>

#include "support/tubes.h"

using namespace vasa;
using namespace vasa::test;

TEST_CASE("between rings far apart sections go, beside rings and in dense meshes they stay") {
  const auto axis = [](float t) { return vec3(0, 0.3f * t, 0); };
  for (const int rings : {10, 300}) {
    const TriangleMesh mesh = tube(
        axis, [](float) { return 0.002f; }, rings, 8);
    const TriangleTree tree(mesh);
    std::vector<vec4> sections;
    for (int i = 0; i <= 300; ++i) sections.push_back(vec4(axis(float(i) / 300), 0.002f));
    dropUntold(sections, mesh, tree);
    CHECK(sections.front().y == 0);
    CHECK(sections.back().y == doctest::Approx(0.3f));
    if (rings == 300) CHECK(sections.size() == 301);
    if (rings == 10) {
      CHECK(sections.size() >= 11);
      CHECK(sections.size() <= 22);
      for (const vec4& section : sections)  // at a ring
        CHECK(std::abs(section.y / 0.03f - std::round(section.y / 0.03f)) < 0.05f);
    }
  }
}
