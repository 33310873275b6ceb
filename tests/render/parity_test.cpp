#include <doctest/doctest.h>

#include <glm/gtc/matrix_transform.hpp>
#include <random>

#include "body/skinning.h"
#include "gpu/gpu_rig.h"
#include "render/frame_upload.h"
#include "render/skin_pass.h"
#include "render/tessellate_pass.h"
#include "shared/sweep.h"
#include "support/networks.h"
#include "surface/octahedral.h"
#include "surface/tessellate.h"

// The compute passes against their CPU references: 1e-5 of the body's height (here 1 m) in position, 1e-3 in
// normals, at sizes that are no multiple of the workgroup.

using namespace vasa;

namespace {

struct Difference {
  float position = 0, normal = 0;
  std::size_t vertices = 0;
};

void compare(Difference& worst, std::span<const shared::TubeVertex> found, std::span<const SurfacePoint> wanted) {
  REQUIRE(found.size() == wanted.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    const shared::TubeVertex& v = found[i];
    const float position = glm::distance(vec3(v.x, v.y, v.z), wanted[i].position);
    const float normal = glm::distance(unpackOctahedral(v.normal), wanted[i].normal);
    worst.position = std::max(worst.position, std::isfinite(position) ? position : 1e9f);
    worst.normal = std::max(worst.normal, std::isfinite(normal) ? normal : 1e9f);
  }
  worst.vertices += found.size();
}

std::vector<quat> framesOf(const Network& network, std::span<const vec4> points) {
  std::vector<quat> frames(network.sectionCount());
  networkFrames(network, points, restReferences(network), frames);
  return frames;
}

Difference passAgainstReference(const test::GpuRig& rig, const Network& network, const std::vector<vec4>& points,
                                const SweepShape& shape, std::uint32_t batchSweeps) {
  const std::vector<quat> frames = framesOf(network, points);
  const TessellatePass pass(rig.device());
  const TubeSet tubes(rig.device(), network, shape, batchSweeps);
  const gpu::Buffer pointBuffer = rig.upload(points), knotBuffer = rig.upload(frames);
  const PosedNetwork posed{tubes.table(), points, frames};
  Difference worst;
  for (const TubeBatch& batch : tubes.batches()) {
    const std::uint32_t each = tubes.verticesPerItem(batch);
    // One vertex more than needed, to see that nothing is written past the end.
    const shared::TubeVertex untouched{1, 2, 3, 4};
    const gpu::Buffer vertices = rig.upload(std::vector(batch.count * each + 1, untouched));
    rig.run([&](VkCommandBuffer commands) {
      pass.record(commands, {tubes, batch, pointBuffer.address(), knotBuffer.address(), vertices.address()});
    });
    const auto found = rig.download<shared::TubeVertex>(vertices);
    CHECK(found.back().normal == 4);
    std::vector<SurfacePoint> wanted(each);
    for (std::uint32_t i = 0; i < batch.count; ++i) {
      if (batch.caps)
        tessellateCap(posed, batch.first + i, shape, wanted);
      else
        tessellateSweep(posed, batch.first + i, shape, wanted);
      compare(worst, std::span(found).subspan(i * each, each), wanted);
    }
  }
  return worst;
}

std::vector<vec4> restPoints(const Network& network) {
  return {network.points().begin(), network.points().end()};
}

}  // namespace

TEST_CASE("the compute passes write what the CPU reference does, at all extremes of m and n") {
  VASA_REQUIRE_GPU(rig);
  const Network network = test::windingNetwork(37, 21);
  for (const SweepShape shape : {SweepShape{3, 2}, SweepShape{3, 20}, SweepShape{4, 5}, SweepShape{7, 3},
                                 SweepShape{8, 10}, SweepShape{16, 2}, SweepShape{16, 20}}) {
    CAPTURE(shape.around);
    CAPTURE(shape.along);
    const Difference worst = passAgainstReference(rig, network, restPoints(network), shape, 101);
    CHECK(worst.vertices > 0);
    CHECK(worst.position <= 1e-5f);
    CHECK(worst.normal <= 1e-3f);
  }
}

TEST_CASE("one sweep, and one more than a workgroup takes") {
  VASA_REQUIRE_GPU(rig);
  for (const std::uint32_t spans : {1u, 2u, 21u, 64u, 65u}) {
    const Network network = test::straightVessel(0.5f, 0.02f, 0.004f, spans);
    const Difference worst = passAgainstReference(rig, network, restPoints(network), {5, 2}, 1000);
    CHECK(worst.position <= 1e-5f);
    CHECK(worst.normal <= 1e-3f);
  }
}

TEST_CASE("skinning on the device is that of the body's") {
  VASA_REQUIRE_GPU(rig);
  std::mt19937 engine(17);
  std::uniform_real_distribution<float> number(-1, 1);
  SkinnedMesh mesh;
  mesh.name = "skin";
  for (int i = 0; i < 333; ++i) {
    mesh.mesh.positions.emplace_back(number(engine), number(engine), number(engine));
    mesh.normals.push_back(glm::normalize(mesh.mesh.positions.back() + vec3(0.01f)));
    SkinInfluence influence;
    for (int k = 0; k < 4; ++k) influence.joints[k] = std::uint16_t(engine() % 7);
    influence.weights = i % 3 == 0 ? vec4(1, 0, 0, 0) : vec4(0.4f, 0.3f, 0.2f, 0.1f);
    mesh.influences.push_back(influence);
  }
  std::vector<mat4> matrices;
  for (int k = 0; k < 7; ++k)
    matrices.push_back(glm::translate(glm::mat4_cast(glm::angleAxis(number(engine), vec3(0, 0.6f, 0.8f))),
                                      vec3(number(engine), number(engine), number(engine))));
  const MeshSet meshes(rig.device(), std::span(&mesh, 1));
  const SkinPass pass(rig.device());
  FrameUpload upload(rig.device(), 0, 0, meshes.jointCount());
  upload.write({}, {}, matrices);
  rig.run([&](VkCommandBuffer commands) {
    upload.record(commands);
    pass.record(commands, meshes, upload.joints(), upload.jointCount());
  });
  std::vector<SurfacePoint> wanted;
  std::vector<vec3> positions, normals;
  skinVertices(mesh, matrices, positions, normals);
  for (std::size_t i = 0; i < positions.size(); ++i) wanted.push_back({positions[i], normals[i]});
  Difference worst;
  compare(worst, rig.download<shared::TubeVertex>(meshes.posed()), wanted);
  CHECK(worst.position <= 1e-5f);
  CHECK(worst.normal <= 1e-3f);
}

TEST_CASE("degenerate curves: points that coincide, hairpins, a radius that falls steeply") {
  VASA_REQUIRE_GPU(rig);
  const Network network = test::windingNetwork(23, 4);
  std::vector<vec4> points = restPoints(network);
  std::mt19937 engine(5);
  for (const Vessel& vessel : network.vessels()) {
    const std::span<vec4> own = Network::pointsOf(vessel, std::span(points));
    switch (engine() % 4) {
      case 0:  // the whole vessel in one place
        for (vec4& p : own) p = own[0];
        break;
      case 1:  // stands still at its start
        own[1] = own[2] = own[3] = own[0];
        break;
      case 2:  // there and back again
        own[2] = own[0];
        break;
      default:
        own[2].w = 1e-6f;
        own[1].w = 0.2f;
    }
  }
  const Difference worst = passAgainstReference(rig, network, points, {6, 5}, 64);
  CHECK(worst.position <= 1e-5f);
  CHECK(worst.normal <= 1e-3f);
}
