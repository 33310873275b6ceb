#include "body/clip.h"

#include <doctest/doctest.h>

#include <random>

using namespace vasa;

namespace {

/// One joint "only" at rest at (0, 0, 7).
Skeleton oneJoint() {
  Skeleton skeleton;
  Skeleton::Joint joint;
  joint.name = "only";
  joint.rest.translation = {0, 0, 7};
  joint.restWorld = joint.rest.matrix();
  skeleton.joints.push_back(joint);
  return skeleton;
}

Clip moving(Track<vec3> translation) {
  Clip clip;
  clip.start = translation.times.front();
  clip.end = translation.times.back();
  clip.tracks.push_back({JointId{0}, std::move(translation), {}, {}});
  return clip;
}

Clip turning(Track<quat> rotation) {
  Clip clip;
  clip.start = rotation.times.front();
  clip.end = rotation.times.back();
  clip.tracks.push_back({JointId{0}, {}, std::move(rotation), {}});
  return clip;
}

vec3 placeAt(const Clip& clip, float time) { return vec3(samplePose(oneJoint(), clip, time).world[0][3]); }

/// Where the joint's x axis points.
vec3 axisAt(const Clip& clip, float time) { return vec3(samplePose(oneJoint(), clip, time).world[0][0]); }

bool near(vec3 a, vec3 b, float tolerance = 1e-5f) { return glm::distance(a, b) < tolerance; }

quat aboutZ(float angle) { return glm::angleAxis(angle, vec3(0, 0, 1)); }

}  // namespace

TEST_CASE("step keys hold their value until the next") {
  const Clip clip = moving({Interpolation::step, {1, 2, 3}, {{1, 0, 0}, {2, 0, 0}, {3, 0, 0}}});
  CHECK(placeAt(clip, 0).x == 1);
  CHECK(placeAt(clip, 1).x == 1);
  CHECK(placeAt(clip, 1.99f).x == 1);
  CHECK(placeAt(clip, 2).x == 2);
  CHECK(placeAt(clip, 3).x == 3);
  CHECK(placeAt(clip, 9).x == 3);
}

TEST_CASE("linear keys are joined by straight lines, and hold outside") {
  const Clip clip = moving({Interpolation::linear, {1, 2, 4}, {{0, 0, 0}, {2, 4, 0}, {2, 0, 8}}});
  CHECK(placeAt(clip, 0.5f) == vec3(0, 0, 0));
  CHECK(placeAt(clip, 1.25f) == vec3(0.5f, 1, 0));
  CHECK(placeAt(clip, 2) == vec3(2, 4, 0));
  CHECK(placeAt(clip, 3) == vec3(2, 2, 4));
  CHECK(placeAt(clip, 5) == vec3(2, 0, 8));
}

TEST_CASE("rotations take the shorter arc at constant speed") {
  const Clip clip = turning({Interpolation::linear, {0, 1}, {aboutZ(0), aboutZ(kPi / 2)}});
  CHECK(near(axisAt(clip, 1.0f / 3), {std::cos(kPi / 6), std::sin(kPi / 6), 0}));
  // -q is the same rotation; the path must not go the long way round.
  const Clip flipped = turning({Interpolation::linear, {0, 1}, {aboutZ(0), -aboutZ(kPi / 2)}});
  CHECK(near(axisAt(flipped, 1.0f / 3), {std::cos(kPi / 6), std::sin(kPi / 6), 0}));
  const Clip still = turning({Interpolation::linear, {0, 1}, {aboutZ(1), aboutZ(1)}});
  CHECK(near(axisAt(still, 0.5f), {std::cos(1.0f), std::sin(1.0f), 0}));
}

TEST_CASE("cubic keys follow the Hermite polynomial, tangents scaled by the step") {
  // Two keys 2 s apart, values 0 and 1, leaving at 3 per second and arriving at -1 per second. At u = 1/2 the
  // polynomials are 1/2, 1/8, 1/2, -1/8: 0.5 * 0 + 2 * 0.125 * 3 + 0.5 * 1 + 2 * (-0.125) * (-1) = 1.5.
  const vec3 unused(99);
  const Clip clip =
      moving({Interpolation::cubic, {1, 3}, {unused, {0, 0, 0}, {3, 0, 0}, {-1, 0, 0}, {1, 0, 0}, unused}});
  CHECK(placeAt(clip, 1).x == 0);
  CHECK(placeAt(clip, 2).x == doctest::Approx(1.5));
  CHECK(placeAt(clip, 3).x == 1);
  CHECK(placeAt(clip, 0).x == 0);
  CHECK(placeAt(clip, 4).x == 1);
  // u = 1/4: 27/32 * 0 + 2 * 9/64 * 3 + 5/32 * 1 + 2 * (-3/64) * (-1) = 1.09375.
  CHECK(placeAt(clip, 1.5f).x == doctest::Approx(1.09375));
}

TEST_CASE("cubic rotations are made unit") {
  const quat zero(0, 0, 0, 0);
  const Clip clip =
      turning({Interpolation::cubic, {0, 1}, {zero, aboutZ(0), zero, zero, aboutZ(kPi / 2), zero}});
  CHECK(near(axisAt(clip, 0.5f), {std::cos(kPi / 4), std::sin(kPi / 4), 0}));
  CHECK(glm::length(axisAt(clip, 0.2f)) == doctest::Approx(1));
}

TEST_CASE("what a clip does not move stays at rest") {
  const Clip clip = turning({Interpolation::linear, {0, 1}, {aboutZ(0), aboutZ(1)}});
  CHECK(placeAt(clip, 0.5f) == vec3(0, 0, 7));
  CHECK(placeAt(Clip{}, 0.5f) == vec3(0, 0, 7));
}

TEST_CASE("a clip goes round by its last pose, also where that lies between two frames") {
  Clip clip = moving({Interpolation::linear, {0, 0.5f, 1}, {{0, 0, 0}, {1, 0, 0}, {0, 0, 0}}});
  clip.framesPerSecond = 10;
  CHECK(endsOnFrame(clip));
  CHECK(closes(oneJoint(), clip));
  clip.framesPerSecond = 10.4f;
  CHECK(clip.frameCount() == 11);
  CHECK(!endsOnFrame(clip));
  CHECK(closes(oneJoint(), clip));
}

TEST_CASE("what a clip scales to nothing keeps a thousandth, so that there is a way back") {
  Clip clip;
  clip.end = 2;
  clip.tracks.push_back(
      {JointId{0}, {}, {}, {Interpolation::linear, {0, 2}, {vec3(1, 1, 1), vec3(0, -1, 1)}}});
  const mat4 pose = samplePose(oneJoint(), clip, 2).world[0];
  CHECK(glm::length(vec3(pose[0])) == doctest::Approx(1e-3f));
  CHECK(pose[1].y == -1);
  CHECK(std::abs(glm::determinant(mat3(samplePose(oneJoint(), clip, 1).world[0]))) > 1e-9f);
}

TEST_CASE("children follow their parents") {
  Skeleton skeleton = oneJoint();
  Skeleton::Joint child;
  child.parent = JointId{0};
  child.rest.translation = {1, 0, 0};
  skeleton.joints.push_back(child);
  const Clip clip = turning({Interpolation::linear, {0, 1}, {aboutZ(0), aboutZ(kPi / 2)}});
  CHECK(near(vec3(samplePose(skeleton, clip, 1).world[1][3]), {0, 1, 7}));
}

TEST_CASE("frames run from the first key to the last, both included") {
  Clip clip;
  CHECK(clip.frameCount() == 1);
  clip.end = 85.0f / 30;
  CHECK(clip.frameCount() == 86);
  clip.start = 10;
  clip.end = 10 + 374.0f / 30;
  CHECK(clip.frameCount() == 375);
  CHECK(clip.timeOfFrame(0) == 10);
  CHECK(clip.timeOfFrame(374) == doctest::Approx(clip.end));
  clip.end = 10.05f;  // a frame and a half
  CHECK(clip.frameCount() == 2);
  clip.end = 9;
  CHECK(clip.frameCount() == 1);
}

TEST_CASE("a pose is rigid for any time where only rotations are keyed") {
  std::mt19937 random(7);
  std::normal_distribution<float> normal;
  Track<quat> track;
  for (int i = 0; i < 20; ++i) {
    track.times.push_back(float(i) * 0.1f);
    track.values.push_back(
        glm::normalize(quat(normal(random), normal(random), normal(random), normal(random))));
  }
  const Clip clip = turning(track);
  for (int i = 0; i < 500; ++i) {
    const mat3 pose(samplePose(oneJoint(), clip, float(i) * 0.005f - 0.2f).world[0]);
    const mat3 product = glm::transpose(pose) * pose;
    for (int k = 0; k < 3; ++k) CHECK(near(product[k], mat3(1)[k]));
  }
}
