#include "body/binding.h"

#include <doctest/doctest.h>

#include <random>

#include "body/chain.h"
#include "body/deform.h"
#include "body/stillness.h"
#include "core/hash.h"
#include "core/parallel.h"

namespace {

using namespace vasa;
using namespace vasa::test;

const std::vector<vec3> kStraight{{0, 0, 0}, {0, 1, 0}, {0, 2, 0}};
const std::vector<vec3> kBent{{0, 0, 0}, {0, 1, 0.1f}, {0.3f, 1.6f, 0}, {0.5f, 1.7f, 0.2f}};

std::vector<vec4> deformed(const Binding& binding, const std::vector<vec4>& rest, const Pose& pose) {
  std::vector<vec4> out(rest.size());
  Deformer(binding).run(rest, pose, out);
  return out;
}

/// Points within 0.15 of a chain's links.
std::vector<vec4> pointsAround(const std::vector<vec3>& chain, std::size_t count, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> unit(0, 1);
  std::vector<vec4> points;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t link = random() % (chain.size() - 1);
    const vec3 way{unit(random) - 0.5f, unit(random) - 0.5f, unit(random) - 0.5f};
    points.emplace_back(glm::mix(chain[link], chain[link + 1], unit(random)) + 0.15f * way, 0.002f);
  }
  return points;
}

Pose wildPose(const Body& body) {
  return turned(body, {{0, glm::angleAxis(0.4f, glm::normalize(vec3(1, 2, 0)))},
                       {1, glm::angleAxis(1.3f, glm::normalize(vec3(2, -1, 1)))},
                       {2, glm::angleAxis(0.9f, glm::normalize(vec3(0, 1, 3)))}});
}

float cross2(vec2 a, vec2 b) { return a.x * b.y - a.y * b.x; }

bool segmentsCross(vec2 a, vec2 b, vec2 c, vec2 d) {
  return cross2(b - a, c - a) * cross2(b - a, d - a) < 0 && cross2(d - c, a - c) * cross2(d - c, b - c) < 0;
}

/// Pairs of vessels, drawn in the plane x = 0, that cross each other.
int crossingPairs(const std::vector<vec4>& points, std::size_t along) {
  const auto at = [&](std::size_t i) { return vec2(points[i].y, points[i].z); };
  const std::size_t vessels = points.size() / along;
  int pairs = 0;
  for (std::size_t v = 0; v < vessels; ++v)
    for (std::size_t w = v + 1; w < vessels; ++w) {
      bool cross = false;
      for (std::size_t i = v * along; i + 1 < (v + 1) * along; ++i)
        for (std::size_t k = w * along; k + 1 < (w + 1) * along; ++k)
          cross = cross || segmentsCross(at(i), at(i + 1), at(k), at(k + 1));
      pairs += cross;
    }
  return pairs;
}

}  // namespace

TEST_CASE("at rest every point stays where it is") {
  const Body body = chainBody(kBent);
  const std::vector<vec4> rest = pointsAround(kBent, 3000, 1);
  const Result<Binding> binding = bindPoints(body, rest, "net.vasa");
  REQUIRE(binding);
  const std::vector<vec4> out = deformed(*binding, rest, restPose(body.skeleton));
  float worst = 0;
  for (std::size_t i = 0; i < rest.size(); ++i)
    worst = std::max(worst, glm::distance(vec3(rest[i]), vec3(out[i])));
  CHECK(worst < 1e-6f);
}

TEST_CASE("a point on the axis turns by the smoothstep of its place in the arc") {
  Body body = chainBody(kStraight);
  std::vector<vec4> rest = bundle({0, 0, 0}, {0, 2, 0}, {0.14f}, 8, 41);
  const std::size_t first = rest.size();
  for (const float y : {0.2f, 0.9f, 1.0f, 1.05f, 1.2f, 1.8f}) rest.emplace_back(0, y, 0, 0.001f);
  const Result<Binding> binding = bindPoints(body, rest, "net.vasa");
  REQUIRE(binding);
  const float arc = binding->spines.joints[1].arc;
  CHECK(arc == doctest::Approx(1.65 * 1.1 * 100 * kPi / 180 * 0.14).epsilon(0.1));

  const std::vector<vec4> out =
      deformed(*binding, rest, turned(body, {{1, glm::angleAxis(1.5f, vec3(1, 0, 0))}}));
  for (std::size_t i = first; i < rest.size(); ++i) {
    const float z = rest[i].y - 1, x = std::clamp(0.5f + z / std::sqrt(1.04f) / arc, 0.0f, 1.0f);
    const quat turn = glm::angleAxis(1.5f * x * x * (3 - 2 * x), vec3(1, 0, 0));
    CHECK(glm::distance(vec3(out[i]), vec3(0, 1, 0) + turn * vec3(0, z, 0)) < 2e-4f);
  }
}

TEST_CASE("turning and moving the whole body turns and moves the vessels") {
  const Body body = chainBody(kBent);
  const std::vector<vec4> rest = pointsAround(kBent, 500, 2);
  const Result<Binding> binding = bindPoints(body, rest, "net.vasa");
  REQUIRE(binding);
  const Pose pose = wildPose(body);
  const mat4 motion = glm::translate(mat4(1), vec3(3, -1, 2)) *
                      glm::mat4_cast(glm::angleAxis(2.1f, glm::normalize(vec3(1, 1, -2))));
  Pose moved = pose;
  for (mat4& joint : moved.world) joint = motion * joint;
  const std::vector<vec4> a = deformed(*binding, rest, pose), b = deformed(*binding, rest, moved);
  float worst = 0;
  for (std::size_t i = 0; i < rest.size(); ++i)
    worst = std::max(worst, glm::distance(vec3(motion * vec4(vec3(a[i]), 1)), vec3(b[i])));
  CHECK(worst < 5e-6f);
}

TEST_CASE("neighbouring points stay neighbours") {
  const Body body = chainBody(kBent);
  std::vector<vec4> rest = pointsAround(kBent, 4000, 3);
  const std::size_t count = rest.size();
  constexpr float kStep = 1e-4f;
  std::mt19937 random(4);
  std::normal_distribution<float> normal;
  for (std::size_t i = 0; i < count; ++i) {
    const vec3 way = glm::normalize(vec3(normal(random), normal(random), normal(random)));
    rest.emplace_back(vec3(rest[i]) + kStep * way, 0.002f);
  }
  const Result<Binding> binding = bindPoints(body, rest, "net.vasa");
  REQUIRE(binding);
  const std::vector<vec4> out = deformed(*binding, rest, wildPose(body));
  float worst = 0;
  for (std::size_t i = 0; i < count; ++i)
    worst = std::max(worst, glm::distance(vec3(out[i]), vec3(out[count + i])));
  CHECK(worst < 40 * kStep);
}

TEST_CASE("twist is spread along the link") {
  const Body body = chainBody({{0, 0, 0}, {0, 1, 0}, {0, 2, 0}, {0, 2.5f, 0}});
  std::vector<vec4> rest;
  for (int i = 0; i <= 20; ++i) rest.emplace_back(0.04f, 0.9f + 0.06f * float(i), 0, 0.001f);
  const Result<Binding> binding = bindPoints(body, rest, "net.vasa");
  REQUIRE(binding);
  const std::vector<vec4> out =
      deformed(*binding, rest, turned(body, {{1, glm::angleAxis(1.6f, vec3(0, 1, 0))}}));
  float before = 0, largest = 0;
  for (const vec4& p : out) {
    const float angle = std::atan2(-p.z, p.x);
    CHECK(angle >= before - 1e-4f);
    CHECK(std::hypot(p.x, p.z) == doctest::Approx(0.04).epsilon(1e-4));
    largest = std::max(largest, angle - before);
    before = angle;
  }
  CHECK(std::atan2(-out[10].z, out[10].x) == doctest::Approx(0.8).epsilon(0.01));
  CHECK(before == doctest::Approx(1.6));
  CHECK(largest < 1.6f * 1.6f * 0.06f);
}

TEST_CASE("where a joint has bent whole and its link's twist has not begun, nothing is twisted") {
  // Close behind another joint the arc is short, and ends where the link has hardly begun.
  const Body body = chainBody({{0, 0, 0}, {0, 1, 0}, {0, 1.06f, 0}, {0, 2.06f, 0}, {0, 2.5f, 0}});
  std::vector<vec4> rest;
  for (int i = 0; i <= 40; ++i) rest.emplace_back(0.04f, 1.06f + 0.002f * float(i), 0, 0.001f);
  const Result<Binding> binding = bindPoints(body, rest, "net.vasa");
  REQUIRE(binding);
  const std::vector<vec4> out =
      deformed(*binding, rest, turned(body, {{2, glm::angleAxis(1.6f, vec3(0, 1, 0))}}));
  for (std::size_t i = 1; i < out.size(); ++i)
    CHECK(std::abs(glm::distance(vec3(out[i]), vec3(out[i - 1])) / 0.002f - 1) < 0.05f);
  CHECK(std::abs(std::atan2(-out.back().z, out.back().x)) < 0.05f);
}

TEST_CASE("a bundle that is bent sharply keeps its order, where a hinge loses it") {
  Body body = chainBody(kStraight);
  body.clips.push_back(turningClip(1, glm::angleAxis(145 * kPi / 180, vec3(1, 0, 0))));
  std::vector<vec4> rest;
  constexpr std::size_t kAlong = 321;
  for (int v = -6; v <= 6; ++v)
    for (std::size_t i = 0; i < kAlong; ++i)
      rest.emplace_back(0, 0.5f + float(i) / float(kAlong - 1), 0.01f * float(v), 0.002f);
  const Result<Binding> binding = bindPoints(body, rest, "net.vasa");
  REQUIRE(binding);
  for (const float degrees : {130.0f, 145.0f}) {
    const Pose pose = turned(body, {{1, glm::angleAxis(degrees * kPi / 180, vec3(1, 0, 0))}});
    CHECK(crossingPairs(deformed(*binding, rest, pose), kAlong) == 0);
    std::vector<vec4> hinged;
    for (const vec4& point : rest) {
      const vec3 pivot(0, 1, 0), turned = pivot + mat3(pose.world[1]) * (vec3(point) - pivot);
      hinged.emplace_back(point.y > pivot.y ? turned : vec3(point), point.w);
    }
    CHECK(crossingPairs(hinged, kAlong) > 0);
  }
}

TEST_CASE("a vessel that comes to lie as far out as the next joint is does not make arcs jump") {
  Body body = chainBody({{0, 0, 0}, {0, 1, 0}, {0, 1.3f, 0}, {0, 2.3f, 0}});
  for (const std::uint32_t joint : {1u, 2u})
    body.clips.push_back(turningClip(joint, glm::angleAxis(0.6f, vec3(1, 0, 0))));
  float before = 0;
  for (float reach = 0.18f; reach < 0.34f; reach += 0.004f) {
    const auto binding = bindPoints(body, bundle({0, 0.9f, 0}, {0, 1.4f, 0}, {reach}, 8, 60), "net.vasa");
    REQUIRE(binding);
    const float arc = binding->spines.joints[1].arc;
    if (before > 0) CHECK(std::abs(arc / before - 1) < 0.25f);
    before = arc;
  }
  CHECK(before > 0.3f);
}

TEST_CASE("the result is the same for any number of threads") {
  const Body body = chainBody(kBent);
  const std::vector<vec4> rest = pointsAround(kBent, 5000, 5);
  std::vector<std::uint64_t> hashes;
  for (const unsigned threads : {1u, 2u, 8u}) {
    setThreadCount(threads);
    const Result<Binding> binding = bindPoints(body, rest, "net.vasa");
    REQUIRE(binding);
    hashes.push_back(hashOf(std::span<const vec4>(deformed(*binding, rest, wildPose(body))),
                            hashOf(std::span<const BindingRecord>(binding->records))));
  }
  setThreadCount(0);
  CHECK(hashes[0] == hashes[1]);
  CHECK(hashes[0] == hashes[2]);
}

TEST_CASE("every point's shares add up, and a point needs 16 bytes or less on a chain") {
  const Body body = chainBody(kBent);
  const std::vector<vec4> rest = pointsAround(kBent, 2000, 6);
  const Result<Binding> binding = bindPoints(body, rest, "net.vasa");
  REQUIRE(binding);
  std::uint64_t sum = 0;
  for (const BindingRecord& record : binding->records) sum += record.share;
  CHECK(sum == std::uint64_t(kWholeShare) * rest.size());
  CHECK(binding->bytes() <= 16 * rest.size());
}

TEST_CASE("nothing to bind is refused") {
  const Result<Binding> binding = bindPoints(chainBody(kStraight), {}, "net.vasa");
  REQUIRE_FALSE(binding);
  CHECK(binding.error().fault == Fault::badInput);
  CHECK(binding.error().message == "net.vasa: there are no vessels to bind to chain.glb");
}

TEST_CASE("vessels of another body are refused") {
  const Body body = chainBody(kStraight);
  std::vector<vec4> far = bundle({900, 0, 0}, {900, 1700, 0}, {5}, 4, 50);  // millimetres
  const Result<Binding> binding = bindPoints(body, far, "net.vasa");
  REQUIRE_FALSE(binding);
  CHECK(binding.error().fault == Fault::badInput);
  CHECK(binding.error().message.find(
            "net.vasa: these vessels do not belong to the body chain.glb: 100 % of them lie "
            "far from all of its joints at rest") == 0);
  CHECK(binding.error().message.find("Choose the body that they were made for") != std::string::npos);
}

TEST_CASE("rigid eyes in a smooth body are no bones: vessels follow the limbs as without them") {
  Body body = chainBody({{0, 0, 0}, {0, 1, 0}, {0, 2, 0}, {0, 2.5f, 0}, {0, 2.7f, 0}});
  body.clips.push_back(turningClip(1, glm::angleAxis(1.0f, vec3(1, 0, 0))));
  SkinnedMesh skin;  // a box around all of it, smoothly bound
  skin.name = "body/skin";
  for (std::uint32_t v = 0; v < 8; ++v) {
    skin.mesh.positions.emplace_back(v & 1 ? 0.2f : -0.2f, v & 2 ? 2.8f : -0.1f, v & 4 ? 0.2f : -0.2f);
    skin.influences.push_back({{1, 2, 0, 0}, vec4(0.5f, 0.5f, 0, 0)});
    skin.normals.emplace_back(0, 0, 1);
  }
  skin.mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                         {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  body.meshes.push_back(skin);
  const std::vector<vec4> points = bundle({0, 0, 0}, {0, 2.7f, 0}, {0.05f}, 6, 40);
  const auto without = bindPoints(body, points, "vessels");
  REQUIRE(without.ok());
  SkinnedMesh eyes;
  eyes.name = "body/eyes";
  for (std::uint32_t v = 0; v < 64; ++v) {
    const float angle = float(v);
    eyes.mesh.positions.emplace_back(0.02f * std::cos(angle), 2.6f + 0.001f * angle, 0.1f);
    eyes.influences.push_back({{std::uint16_t(v % 2 ? 3 : 4), 0, 0, 0}, vec4(1, 0, 0, 0)});
    eyes.normals.emplace_back(0, 0, 1);
    if (v > 1) eyes.mesh.triangles.emplace_back(v - 2, v - 1, v);
  }
  body.meshes.push_back(eyes);
  const auto with = bindPoints(body, points, "vessels");
  if (!with.ok()) FAIL(with.error().message);
  CHECK(shareLeftBehind(body, *with, points) == 0);
  const Pose pose = turned(body, {{1, glm::angleAxis(1.0f, vec3(1, 0, 0))}});
  const auto wanted = deformed(*without, points, pose), got = deformed(*with, points, pose);
  for (std::size_t i = 0; i < points.size(); ++i) CHECK(glm::distance(vec3(wanted[i]), vec3(got[i])) < 1e-5f);

  // What hangs on a joint that stays is told from what moves.
  Binding still = *with;
  for (BindingRecord& record : still.records)
    record.joint = 0, record.along = BindingRecord({{0}, 2}, 0).along;
  CHECK(shareLeftBehind(body, still, points) > 0.4f);
}

TEST_CASE("a root on the floor below the hips is no bone: what lies beside its link goes with the body") {
  Body body = chainBody({{0, 0, 0}, {0, 1, 0}, {0, 1.3f, 0}, {0, 1.6f, 0}});
  SkinnedMesh skin;
  skin.name = "skin";
  for (std::uint32_t v = 0; v < 8; ++v) {
    skin.mesh.positions.emplace_back(v & 1 ? 0.2f : -0.2f, v & 2 ? 1.8f : -0.1f, v & 4 ? 0.2f : -0.2f);
    skin.influences.push_back({{1, 2, 0, 0}, vec4(0.5f, 0.5f, 0, 0)});
    skin.normals.emplace_back(0, 0, 1);
  }
  skin.mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                         {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  body.meshes.push_back(skin);
  const std::vector<vec4> points = bundle({0, 0.4f, 0}, {0, 1.5f, 0}, {0.05f}, 6, 20);
  const auto binding = bindPoints(body, points, "vessels");
  if (!binding.ok()) FAIL(binding.error().message);
  // The hips come down by half a metre; the root stays.
  std::vector<JointTransform> local;
  for (const auto& joint : body.skeleton.joints) local.push_back(joint.rest);
  local[1].translation.y -= 0.5f;
  const auto posed = deformed(*binding, points, poseFromLocal(body.skeleton, local));
  for (std::size_t i = 0; i < points.size(); ++i)
    CHECK(glm::distance(vec3(posed[i]), vec3(points[i]) - vec3(0, 0.5f, 0)) < 1e-4f);
}
