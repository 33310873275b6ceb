#include "render/mesh_levels.h"

#include <doctest/doctest.h>

#include <algorithm>

#include <glm/gtc/matrix_transform.hpp>

#include "body/body.h"
#include "body/skinning.h"
#include "mesh/triangle_tree.h"

using namespace vasa;

namespace {

constexpr float kRadius = 0.1f;

// A ball of rings and spokes, closed at its poles.
TriangleMesh ball(std::uint32_t rings, std::uint32_t spokes) {
  TriangleMesh mesh;
  const auto at = [&](std::uint32_t ring, std::uint32_t spoke) {
    return 1 + (ring - 1) * spokes + spoke % spokes;
  };
  mesh.positions.push_back({0, kRadius, 0});
  for (std::uint32_t i = 1; i < rings; ++i)
    for (std::uint32_t k = 0; k < spokes; ++k) {
      const float polar = kPi * float(i) / float(rings), around = 2 * kPi * float(k) / float(spokes);
      mesh.positions.push_back(kRadius * vec3(std::sin(polar) * std::cos(around), std::cos(polar),
                                              std::sin(polar) * std::sin(around)));
    }
  const std::uint32_t last = std::uint32_t(mesh.positions.size());
  mesh.positions.push_back({0, -kRadius, 0});
  for (std::uint32_t k = 0; k < spokes; ++k) {
    mesh.triangles.push_back({0, at(1, k + 1), at(1, k)});
    mesh.triangles.push_back({last, at(rings - 1, k), at(rings - 1, k + 1)});
    for (std::uint32_t i = 1; i + 1 < rings; ++i) {
      mesh.triangles.push_back({at(i, k), at(i, k + 1), at(i + 1, k)});
      mesh.triangles.push_back({at(i, k + 1), at(i + 1, k + 1), at(i + 1, k)});
    }
  }
  return mesh;
}

// How far the middles of the triangles lie from the ball [m].
float farthest(const TriangleMesh& mesh, const std::vector<uvec3>& triangles) {
  float worst = 0;
  for (const uvec3& t : triangles) {
    const vec3 middle = (mesh.positions[t.x] + mesh.positions[t.y] + mesh.positions[t.z]) / 3.0f;
    worst = std::max(worst, std::abs(glm::length(middle) - kRadius));
  }
  return worst;
}

SkinnedMesh skinned(TriangleMesh mesh) {
  SkinnedMesh result;
  result.mesh = std::move(mesh);
  for (const vec3& p : result.mesh.positions)
    result.normals.push_back(p == vec3(0) ? vec3(0, 0, 1) : glm::normalize(p));
  return result;
}

// A level's triangles over the mesh's own numbers.
std::vector<uvec3> trianglesOf(const MeshLevel& level) {
  std::vector<uvec3> triangles;
  for (const uvec3& t : level.triangles)
    triangles.push_back({level.vertices[t.x], level.vertices[t.y], level.vertices[t.z]});
  return triangles;
}

}  // namespace

TEST_CASE("coarser levels have fewer triangles, keep their error and stay closed") {
  const SkinnedMesh mesh = skinned(ball(80, 160));
  const LevelledMesh all = coarserLevels(mesh);
  const std::vector<MeshLevel>& levels = all.levels;
  CHECK(all.closed);
  REQUIRE(levels.size() >= 4);
  CHECK(levels[0].error == 0);
  CHECK(trianglesOf(levels[0]) == mesh.mesh.triangles);
  std::size_t before = mesh.mesh.triangles.size();
  float error = 0;
  for (std::size_t i = 1; i < levels.size(); ++i) {
    const MeshLevel& level = levels[i];
    const std::vector<uvec3> triangles = trianglesOf(level);
    CAPTURE(level.error);
    CHECK(triangles.size() < before);
    CHECK(level.vertices.size() <=
          1.05 * double(triangles.size() / 2 + 2));  // none that is not used, few twice
    CHECK(level.error > error);
    CHECK(farthest(mesh.mesh, triangles) <= 2 * level.error);
    const float volume = TriangleMesh{mesh.mesh.positions, triangles}.volume();
    CHECK(volume > 0);  // outward still
    CHECK(volume == doctest::Approx(mesh.mesh.volume()).epsilon(5 * level.error / kRadius));
    before = triangles.size(), error = level.error;
  }
  CHECK(levels.back().triangles.size() * 20 < mesh.mesh.triangles.size());
}

TEST_CASE("a large triangle at a sharp edge is shaded as itself, not as the edge") {
  // A thin sheet of many triangles, rounded at its edges: normals there point sideways.
  TriangleMesh sheet = ball(40, 80);
  for (vec3& p : sheet.positions) p.z *= 0.02f;
  SkinnedMesh mesh = skinned(sheet);
  for (std::size_t i = 0; i < mesh.normals.size(); ++i) {
    const vec3 p = mesh.mesh.positions[i];
    mesh.normals[i] = glm::normalize(vec3(p.x, p.y, p.z / (0.02f * 0.02f)));
  }
  const MeshLevel coarse = coarserLevels(mesh).levels.back();
  CHECK(coarse.triangles.size() < 200);
  for (const uvec3& t : coarse.triangles) {
    const vec3 a = mesh.mesh.positions[coarse.vertices[t.x]], b = mesh.mesh.positions[coarse.vertices[t.y]],
               c = mesh.mesh.positions[coarse.vertices[t.z]];
    const vec3 face = glm::normalize(glm::cross(b - a, c - a));
    for (int k = 0; k < 3; ++k) {
      CHECK(glm::dot(coarse.normals[t[k]], face) >= 0.69f);
      CHECK(glm::length(coarse.normals[t[k]]) == doctest::Approx(1).epsilon(1e-3));
    }
  }
}

TEST_CASE("levels of a straight arm hold where its elbow is bent") {
  // A tube along +X, bent in its middle by half of the joint's turn over 6 cm.
  constexpr int kRings = 100, kAround = 24;
  constexpr float kLength = 0.5f, kBlend = 0.06f;
  Skeleton arm;
  arm.joints.resize(2);
  arm.joints[1].parent = {0};
  arm.joints[1].rest.translation = {kLength / 2, 0, 0};
  arm.joints[1].restWorld = glm::translate(mat4(1), arm.joints[1].rest.translation);
  arm.joints[1].inverseBind = glm::inverse(arm.joints[1].restWorld);
  SkinnedMesh mesh;
  for (int i = 0; i <= kRings; ++i)
    for (int k = 0; k < kAround; ++k) {
      const float x = kLength * float(i) / kRings, angle = 2 * kPi * float(k) / kAround;
      const vec3 normal(0, std::cos(angle), std::sin(angle));
      mesh.mesh.positions.push_back(vec3(x, 0, 0) + 0.04f * normal);
      mesh.normals.push_back(normal);
      const float far = glm::smoothstep(-kBlend / 2, kBlend / 2, x - kLength / 2);
      mesh.influences.push_back({{0, 1, 0, 0}, vec4(1 - far, far, 0, 0)});
      const auto at = [&](int ring, int spoke) { return std::uint32_t(ring * kAround + spoke % kAround); };
      if (i == 0) continue;
      mesh.mesh.triangles.push_back({at(i - 1, k), at(i, k), at(i, k + 1)});
      mesh.mesh.triangles.push_back({at(i - 1, k), at(i, k + 1), at(i - 1, k + 1)});
    }
  // How far the mesh's vertices lie from a level of a few hundred triangles where the elbow has a right
  // angle.
  const auto error = [&](const Skeleton* skeleton) {
    const LevelledMesh all = coarserLevels(mesh, skeleton);
    const auto few =
        std::ranges::find_if(all.levels, [](const MeshLevel& l) { return l.triangles.size() < 700; });
    REQUIRE(few != all.levels.end());
    std::vector<JointTransform> local{arm.joints[0].rest, arm.joints[1].rest};
    local[1].rotation = glm::angleAxis(glm::radians(90.0f), vec3(0, 0, 1));
    std::vector<vec3> posed;
    skinPositions(mesh, skinMatrices(arm, poseFromLocal(arm, local)), posed);
    const TriangleMesh coarse{posed, trianglesOf(*few)};
    const TriangleTree tree(coarse);
    float worst = 0;
    for (const vec3& p : posed) worst = std::max(worst, tree.nearest(p).distance);
    MESSAGE(few->triangles.size() << " triangles, " << 1000 * worst << " mm");
    return worst;
  };
  CHECK(error(nullptr) > 0.01f);
  CHECK(error(&arm) < 0.004f);
  // A bone's mesh: vertices of an axial bone go with none of the skeleton's joints.
  const LevelledMesh atRest = coarserLevels(mesh);
  mesh.influences.front() = {{2, 0, 0, 0}, vec4(1, 0, 0, 0)};
  const LevelledMesh bone = coarserLevels(mesh, &arm);
  REQUIRE(bone.levels.size() == atRest.levels.size());
  for (std::size_t k = 0; k < bone.levels.size(); ++k)
    CHECK(bone.levels[k].triangles == atRest.levels[k].triangles);
}

TEST_CASE("a mesh of nothing and a triangle have no coarser levels") {
  CHECK(coarserLevels(SkinnedMesh{}).levels.size() == 1);
  CHECK(coarserLevels(skinned({{{0, 0, 0}, {0.05f, 0, 0}, {0, 0.05f, 0}}, {{0, 1, 2}}})).levels.size() == 1);
}

TEST_CASE("closed is what has no border and faces outwards, piece by piece") {
  const TriangleMesh whole = ball(6, 8);
  CHECK(isClosed(whole));
  CHECK_FALSE(isClosed({}));
  TriangleMesh open = whole;
  open.triangles.pop_back();
  CHECK_FALSE(isClosed(open));
  TriangleMesh inside = whole;
  for (uvec3& t : inside.triangles) std::swap(t.y, t.z);
  CHECK_FALSE(isClosed(inside));
  TriangleMesh both = whole;
  for (const vec3& p : inside.positions) both.positions.push_back(p * 0.5f + vec3(1, 0, 0));
  for (const uvec3& t : inside.triangles) both.triangles.push_back(t + std::uint32_t(whole.positions.size()));
  CHECK_FALSE(isClosed(both));
  TriangleMesh seam = whole;  // a corner of its own for one triangle, in the same place
  seam.positions.push_back(seam.positions[seam.triangles[5].x]);
  seam.triangles[5].x = std::uint32_t(seam.positions.size() - 1);
  CHECK(isClosed(seam));
}

TEST_CASE("the nearest depth is that of the nearest ball in front of the camera, where its joint has it") {
  SkinnedMesh mesh;
  mesh.mesh = ball(8, 8);
  for (const vec3& p : mesh.mesh.positions)
    mesh.influences.push_back({{std::uint16_t(p.y > 0 ? 1 : 0), 0, 0, 0}, {1, 0, 0, 0}});
  const std::vector<JointBall> balls = jointBalls(mesh);
  REQUIRE(balls.size() == 2);
  const Camera camera{.position = {0, 0, 4}, .target = {0, 0, 0}};
  const mat4 still(1);
  const std::vector<mat4> rest{still, still};
  const float before = nearestDepth(balls, rest, camera);
  CHECK(before < 4);
  CHECK(before > 4 - 3 * kRadius);
  const std::vector<mat4> nearer{still, glm::translate(still, {0, 0, 2})};
  CHECK(nearestDepth(balls, nearer, camera) == doctest::Approx(before - 2).epsilon(0.02));
  const std::vector<mat4> behind{still, glm::translate(still, {0, 0, 20})};
  CHECK(nearestDepth(balls, behind, camera) == doctest::Approx(before).epsilon(1e-3));
  CHECK(nearestDepth({}, rest, camera) == camera.farDistance);
}

TEST_CASE("a pixel's side grows with the depth, or is everywhere the same") {
  Camera camera{.position = {0, 0, 4}, .target = {0, 0, 0}};
  CHECK(pixelAt(3, camera, 100) == doctest::Approx(2 * std::tan(camera.verticalAngle / 2) * 3 / 100));
  CHECK(pixelAt(0, camera, 100) ==
        doctest::Approx(2 * std::tan(camera.verticalAngle / 2) * camera.nearDistance / 100));
  camera.orthographicHeight = 2;
  CHECK(pixelAt(3, camera, 100) == doctest::Approx(0.02));
}
