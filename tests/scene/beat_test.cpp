#include "scene/beat.h"

#include <doctest/doctest.h>

#include <glm/gtc/matrix_transform.hpp>

#include "support/meshes.h"
#include "support/networks.h"

using namespace vasa;

namespace {

Scene sceneWith(const char* mesh) {
  Scene scene;
  scene.body.skeleton.joints.resize(1);
  scene.body.meshes = {test::boxMesh(mesh, {-0.1f, -0.1f, -0.1f}, {0.1f, 0.1f, 0.1f})};
  scene.network = test::straightVessel(1, 0.01f, 0.01f, 40);  // from the middle of the heart along +z
  return scene;
}

}  // namespace

TEST_CASE("the heart is at rest between beats, draws together once a beat, and repeats itself") {
  float least = 1;
  for (int i = 0; i < 1000; ++i) {
    const float scale = HeartBeat::scaleAt(float(i) * 0.01f);
    CHECK(scale <= 1);
    least = std::min(least, scale);
  }
  CHECK(least == doctest::Approx(0.92).epsilon(0.001));
  CHECK(HeartBeat::scaleAt(0) == 1);
  CHECK(HeartBeat::scaleAt(0.6f) == 1);
  CHECK(HeartBeat::scaleAt(0.1f) == doctest::Approx(HeartBeat::scaleAt(0.1f + 1 / 1.2f)).epsilon(1e-4));
}

TEST_CASE("vessels on the heart follow it, those far off do not, wherever the body has carried it") {
  const Scene scene = sceneWith("Heart");
  const HeartBeat beat(scene);
  const std::vector<vec4> rest(scene.network.points().begin(), scene.network.points().end());
  const mat4 carried = glm::rotate(glm::translate(mat4(1), vec3(1, 2, 3)), 1.0f, vec3(0, 1, 0));
  std::vector<vec4> posed;
  for (const vec4& p : rest) posed.push_back(vec4(vec3(carried * vec4(vec3(p), 1)), p.w));
  std::vector<vec4> beating = posed;
  beat.apply(0.9f, std::vector{carried}, beating);
  const vec3 centre(carried[3]);
  for (std::size_t i = 0; i < rest.size(); ++i) {
    const float before = glm::distance(vec3(posed[i]), centre),
                after = glm::distance(vec3(beating[i]), centre);
    CHECK(beating[i].w == posed[i].w);
    if (rest[i].z < 0.13f) CHECK(after == doctest::Approx(0.9f * before));
    if (rest[i].z > 0.3f) CHECK(beating[i] == posed[i]);
    CHECK(after <= before * 1.0001f);
  }
}

TEST_CASE("a body without a heart has no beat") {
  const Scene scene = sceneWith("liver");
  std::vector<vec4> points(scene.network.points().begin(), scene.network.points().end());
  const std::vector<vec4> before = points;
  HeartBeat(scene).apply(0.9f, std::vector{mat4(1)}, points);
  CHECK(points == before);
}
