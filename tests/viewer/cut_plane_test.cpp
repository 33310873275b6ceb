#include "viewer/cut_plane.h"

#include <doctest/doctest.h>

using namespace vasa;
using namespace vasa::viewer;

namespace {

const Aabb kBox{{-1, 0, -0.5f}, {1, 2, 0.5f}};

float heightOver(const CutPlane& cut, vec3 place) { return glm::dot(cutThrough(cut, kBox), vec4(place, 1)); }

}  // namespace

TEST_CASE("a plane from the front cuts off what is before it, by its place in the box") {
  CutPlane cut{.on = true};
  CHECK(glm::distance(cutDirection(cut), vec3(0, 0, 1)) < 1e-6f);
  CHECK(heightOver(cut, {0, 1, 0.2f}) < 0);
  CHECK(heightOver(cut, {0, 1, -0.2f}) == doctest::Approx(0.2));
  cut.place = 0;
  CHECK(heightOver(cut, {0.3f, 1.7f, 0.499f}) > 0);  // nothing
  cut.place = 1;
  CHECK(heightOver(cut, {0.3f, 1.7f, -0.499f}) < 0);  // all
}

TEST_CASE("turned and tilted planes hold the box between their first and last place") {
  for (const float turn : {-120.0f, 35.0f, 90.0f})
    for (const float tilt : {-90.0f, -20.0f, 60.0f}) {
      CutPlane cut{.on = true, .turn = turn, .tilt = tilt, .place = 0};
      CHECK(glm::length(cutDirection(cut)) == doctest::Approx(1));
      float least = 1e9f;
      for (int corner = 0; corner < 8; ++corner)
        least = std::min(
            least, heightOver(cut, {corner & 1 ? 1 : -1, corner & 2 ? 2 : 0, corner & 4 ? 0.5f : -0.5f}));
      CHECK(least == doctest::Approx(0).epsilon(1e-5));
      for (const vec3& place : cutOutline(cut, kBox))
        CHECK(heightOver(cut, place) == doctest::Approx(0).epsilon(1e-4));
    }
}

TEST_CASE("a plane can face the viewer") {
  CutPlane cut;
  const vec3 forward = glm::normalize(vec3(0.3f, -0.5f, -0.8f));
  faceViewer(cut, forward);
  CHECK(glm::distance(cutDirection(cut), -forward) < 1e-5f);
}
