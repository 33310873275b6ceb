#include "math/quadrature.h"

#include <doctest/doctest.h>

#include <cmath>

#include "math/types.h"

using namespace vasa;

TEST_CASE("four Gauss points integrate polynomials up to degree 7 exactly") {
  for (int degree = 0; degree <= 7; ++degree) {
    double sum = 0;
    for (const auto& [x, w] : kGauss4) sum += double(w) * std::pow(double(x), degree);
    CHECK(sum == doctest::Approx(1.0 / (degree + 1)).epsilon(1e-7));
  }
}

TEST_CASE("a perpendicular is perpendicular and of unit length, everywhere") {
  for (const vec3 n : {vec3(0, 0, 1), vec3(0, 0, -1), vec3(1, 0, 0), glm::normalize(vec3(1, -2, 3))}) {
    CHECK(std::abs(glm::dot(anyPerpendicular(n), n)) < 1e-6f);
    CHECK(glm::length(anyPerpendicular(n)) == doctest::Approx(1));
  }
}
