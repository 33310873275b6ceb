#include "mesh/shape_basis.h"

#include <doctest/doctest.h>

using namespace vasa;

namespace {

// A bar that turns about its end, frame after frame.
std::vector<std::vector<vec3>> turning(int count, float angle) {
  std::vector<std::vector<vec3>> frames;
  for (int f = 0; f < count; ++f) {
    const float a = angle * float(f) / float(std::max(1, count - 1));
    std::vector<vec3> frame;
    for (int v = 0; v < 200; ++v)
      frame.push_back(0.01f * float(v) * vec3(std::cos(a), std::sin(a), 0.1f * float(v % 3)));
    frames.push_back(frame);
  }
  return frames;
}

float worstMiss(const std::vector<std::vector<vec3>>& frames, const ShapeBasis& basis) {
  float worst = 0;
  for (std::size_t f = 0; f < frames.size(); ++f)
    for (std::size_t v = 0; v < frames[f].size(); ++v) {
      vec3 p = frames[0][v];
      for (std::size_t k = 0; k < basis.shapes.size(); ++k) p += basis.weights[f][k] * basis.shapes[k][v];
      worst = std::max(worst, glm::distance(p, frames[f][v]));
    }
  return worst;
}

}  // namespace

TEST_CASE("a turn in a plane is two shapes, whatever the number of frames") {
  const auto frames = turning(40, 2.0f);
  auto work = frames;
  const ShapeBasis basis = shapeBasis(work, 1e-5f);
  CHECK(basis.shapes.size() <= 3);  // and one where a weight would be negative
  CHECK(basis.error <= 1e-5f);
  CHECK(worstMiss(frames, basis) <= 1.1e-5f);
  for (const auto& row : basis.weights)
    for (const float w : row) CHECK((w >= 0 && w <= 1));
  float start = 0;
  for (std::size_t v = 0; v < frames[0].size(); ++v) {
    vec3 moved(0);
    for (std::size_t k = 0; k < basis.shapes.size(); ++k) moved += basis.weights[0][k] * basis.shapes[k][v];
    start = std::max(start, glm::length(moved));
  }
  CHECK(start < 1e-6f);
}

TEST_CASE("a coarse tolerance takes fewer shapes; frames that do not move take none") {
  auto frames = turning(20, 0.01f);
  CHECK(shapeBasis(frames, 0.001f).shapes.size() <= 2);
  auto still = turning(5, 0);
  const ShapeBasis none = shapeBasis(still, 1e-6f);
  CHECK(none.shapes.empty());
  CHECK(none.error == 0);
  auto one = turning(1, 0);
  CHECK(shapeBasis(one, 1e-6f).weights.size() == 1);
}

TEST_CASE("another quantity of the same frames follows the same weights") {
  const auto frames = turning(30, 1.5f);
  auto work = frames;
  const ShapeBasis basis = shapeBasis(work, 1e-6f);
  std::vector<std::vector<vec3>> doubled = frames;
  for (auto& frame : doubled)
    for (vec3& p : frame) p *= 2;
  const auto shapes = shapesForWeights(doubled, basis.weights);
  REQUIRE(shapes.size() == basis.shapes.size());
  for (std::size_t k = 0; k < shapes.size(); ++k)
    for (std::size_t v = 0; v < shapes[k].size(); ++v)
      CHECK(glm::distance(shapes[k][v], 2.0f * basis.shapes[k][v]) < 1e-3f);
}
