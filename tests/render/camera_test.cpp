#include "render/camera.h"

#include <doctest/doctest.h>

#include <cmath>

#include "render/look.h"

using namespace vasa;

namespace {

Aabb boxOf(vec3 low, vec3 high) {
  Aabb box;
  box.add(low);
  box.add(high);
  return box;
}

vec3 project(const mat4& m, vec3 point) {
  const vec4 clip = m * vec4(point, 1);
  return vec3(clip) / clip.w;
}

}  // namespace

TEST_CASE("a camera on +Z sees +X to the right and +Y up") {
  Camera camera;
  camera.position = {0, 0, 2};
  camera.target = {0, 0, 0};
  camera.verticalAngle = kPi / 2;
  camera.nearDistance = 0.5f;
  const mat4 m = viewProjection(camera, 2);
  CHECK(glm::distance(project(m, {4, 2, 0}), vec3(1, -1, 0.25f)) < 1e-6f);  // y down, depth near / distance
  CHECK(project(m, {0, 0, 1.5f}).z == doctest::Approx(1));
  CHECK(project(m, {0, 0, -1e6f}).z < 1e-6f);
}

TEST_CASE("an orthographic view keeps sizes and reverses depth") {
  Camera camera;
  camera.position = {0, 0, 3};
  camera.target = {0, 0, 0};
  camera.orthographicHeight = 4;
  camera.nearDistance = 1;
  camera.farDistance = 5;
  const mat4 m = viewProjection(camera, 1);
  CHECK(glm::distance(project(m, {1, 1, 2}), vec3(0.5f, -0.5f, 1)) < 1e-6f);
  CHECK(glm::distance(project(m, {1, 1, -2}), vec3(0.5f, -0.5f, 0)) < 1e-6f);
}

TEST_CASE("what is at the target is as large without perspective, and the eye sees all of it from outside") {
  Camera camera;
  camera.position = {0, 1, 0.5f};
  camera.target = {0, 1, 0};
  const Camera flat = orthographic(camera, 2);
  const float high = 0.5f * std::tan(0.5f * camera.verticalAngle);
  const auto seen = [](const Camera& by, vec3 p) {
    const vec4 q = viewProjection(by, 1) * vec4(p, 1);
    return vec3(q) / q.w;
  };
  CHECK(seen(flat, {0, 1 + high, 0}).y == doctest::Approx(seen(camera, {0, 1 + high, 0}).y));
  for (const float z : {-1.99f, 1.99f}) {
    const float depth = seen(flat, {0, 1, z}).z;
    CHECK(depth > 0);
    CHECK(depth < 1);
  }
}

TEST_CASE("every named view holds the whole box, and not much more") {
  const Aabb box = boxOf({-0.4f, -0.1f, -0.2f}, {0.5f, 1.7f, 0.3f});
  for (const View view : {View::front, View::back, View::left, View::right, View::top})
    for (const float aspect : {0.5f, 1.0f, 16.0f / 9})
      for (const float height : {0.0f, 1.0f}) {
        Camera camera = cameraFrom(view, box, aspect);
        camera.orthographicHeight = height;
        camera = focusOn(camera, box, aspect);
        const mat4 m = viewProjection(camera, aspect);
        float reach = 0;
        for (int i = 0; i < 8; ++i) {
          const vec3 p = project(m, {i & 1 ? box.low.x : box.high.x, i & 2 ? box.low.y : box.high.y,
                                     i & 4 ? box.low.z : box.high.z});
          reach = std::max({reach, std::abs(p.x), std::abs(p.y)});
          CHECK(p.z > 0);
          CHECK(p.z < 1);
        }
        CHECK(reach < 1);
        CHECK(reach > 0.9f);
      }
}

TEST_CASE("sides are the body's own") {
  const Aabb box = boxOf({-1, -1, -1}, {1, 1, 1});
  CHECK(cameraAxes(cameraFrom(View::front, box, 1))[0].x == doctest::Approx(1));  // its left is on our right
  CHECK(cameraAxes(cameraFrom(View::left, box, 1))[2].x == doctest::Approx(1));   // we stand at +X
  CHECK(cameraAxes(cameraFrom(View::top, box, 1))[1].z == doctest::Approx(-1));   // it faces the lower edge
  CHECK(viewNamed("back") == View::back);
  CHECK(!viewNamed("Front"));
}

TEST_CASE("a line of sight along `up` and a box without size still give a camera") {
  Camera camera;
  camera.position = {0, 5, 0};
  camera.target = {0, 0, 0};
  const mat3 axes = cameraAxes(camera);
  CHECK(glm::determinant(axes) == doctest::Approx(1));
  const Camera point = cameraFrom(View::front, boxOf({1, 2, 3}, {1, 2, 3}), 1);
  CHECK(glm::distance(point.position, point.target) > 0.005f);
}

TEST_CASE("roles and packed colours") {
  CHECK(roleNamed("Skin") == MeshRole::skin);
  CHECK(roleNamed("human_bones") == MeshRole::bones);
  CHECK(roleNamed("heart") == MeshRole::heart);
  CHECK(roleNamed("left Lung") == MeshRole::organs);
  CHECK(roleNamed("Object_4") == MeshRole::other);
  CHECK(packColour({1, 0, 0.5f, 1}) == 0xff8000ffu);
  CHECK(packColour({-1, 2, 0, 0}) == 0x0000ff00u);
}
