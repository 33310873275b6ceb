#include "viewer/orbit.h"

#include <doctest/doctest.h>

using namespace vasa;
using viewer::Orbit;

namespace {

vec2 seenAt(const Orbit& orbit, vec3 place) {
  const vec4 clip = viewProjection(orbit.camera(0, 1), 1) * vec4(place, 1);
  return vec2(clip) / clip.w;
}

}  // namespace

TEST_CASE("views look along the axes, upright") {
  Orbit orbit;
  orbit.look(View::front);
  CHECK(glm::distance(cameraAxes(orbit.camera(0, 1))[2], vec3(0, 0, 1)) < 1e-5f);
  orbit.look(View::left);
  CHECK(glm::distance(cameraAxes(orbit.camera(0, 1))[2], vec3(1, 0, 0)) < 1e-5f);
  orbit.look(View::top);
  const mat3 axes = cameraAxes(orbit.camera(0, 1));
  CHECK(glm::distance(axes[2], vec3(0, 1, 0)) < 1e-5f);
  CHECK(glm::distance(axes[1], vec3(0, 0, -1)) < 1e-5f);  // as cameraFrom(View::top)
  orbit.lookFromBelow();
  CHECK(glm::distance(cameraAxes(orbit.camera(0, 1))[2], vec3(0, -1, 0)) < 1e-5f);
}

TEST_CASE("turning keeps the pivot in the middle and stops straight above") {
  Orbit orbit;
  orbit.orbit({0.7f, 0.4f});
  CHECK(glm::length(seenAt(orbit, orbit.pivot())) < 1e-5f);
  orbit.orbit({0, 10});
  CHECK(glm::distance(cameraAxes(orbit.camera(0, 1))[2], vec3(0, 1, 0)) < 1e-4f);
}

TEST_CASE("panning moves what lies in the pivot's plane along with the pointer") {
  Orbit orbit;
  orbit.orbit({0.7f, 0.4f});
  const vec3 before = orbit.pivot();
  orbit.pan({100, 50}, 400);
  const vec2 now = seenAt(orbit, before);
  CHECK(now.x == doctest::Approx(0.5).epsilon(1e-4));   // of a square picture 400 pixels high
  CHECK(now.y == doctest::Approx(0.25).epsilon(1e-4));  // down
}

TEST_CASE("going nearer keeps the place under the pointer") {
  Orbit orbit;
  const mat3 axes = cameraAxes(orbit.camera(0, 1));
  const vec3 place = orbit.pivot() + 0.3f * axes[0] + 0.2f * axes[1];
  const vec2 before = seenAt(orbit, place);
  orbit.dolly(5, {before.x, -before.y});
  CHECK(orbit.distance() < 2);
  CHECK(glm::distance(seenAt(orbit, place), before) < 1e-4f);
}

TEST_CASE("an orthographic view is as large as the perspective one at the pivot") {
  Orbit orbit;
  const vec3 place = orbit.pivot() + vec3(0.2f, 0.3f, 0);
  const vec2 before = seenAt(orbit, place);
  orbit.setOrthographic(true);
  CHECK(glm::distance(seenAt(orbit, place), before) < 1e-5f);
}

TEST_CASE("framing a box and taking a camera over") {
  Orbit orbit;
  Aabb box;
  box.add(vec3(1, 1, 1), 0.5f);
  orbit.frame(box, 1.5f);
  CHECK(glm::distance(orbit.pivot(), vec3(1)) < 1e-5f);
  CHECK(std::abs(seenAt(orbit, {1.5f, 1.5f, 1.5f}).y) <= 1);
  Orbit other;
  other.take(orbit.camera(0, 1));
  CHECK(glm::distance(other.camera(0, 1).position, orbit.camera(0, 1).position) < 1e-4f);
  orbit.frame({}, 1);  // nothing to look at: stays
  CHECK(glm::distance(orbit.pivot(), vec3(1)) < 1e-5f);
}

TEST_CASE("the cut goes from in front of the scene to behind it") {
  Orbit orbit;
  CHECK(orbit.camera(0, 1).nearDistance < 0.1f);
  CHECK(orbit.camera(0.5f, 1).nearDistance == doctest::Approx(orbit.distance()));
  CHECK(orbit.camera(1, 1).nearDistance == doctest::Approx(orbit.distance() + 1));
}
