#include "surface/octahedral.h"

#include <doctest/doctest.h>

#include <random>

using namespace vasa;

TEST_CASE("the axes survive packing exactly") {
  for (const vec3 axis :
       {vec3(1, 0, 0), vec3(-1, 0, 0), vec3(0, 1, 0), vec3(0, -1, 0), vec3(0, 0, 1), vec3(0, 0, -1)})
    CHECK(glm::distance(unpackOctahedral(packOctahedral(axis)), axis) < 1e-7f);
}

TEST_CASE("any direction comes back within 7e-5") {
  std::mt19937 engine(7);
  std::normal_distribution<float> normal;
  for (int i = 0; i < 20000; ++i) {
    const vec3 unit = glm::normalize(vec3(normal(engine), normal(engine), normal(engine)));
    CHECK(glm::distance(unpackOctahedral(packOctahedral(unit)), unit) < 7e-5f);
  }
}
