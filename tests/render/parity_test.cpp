#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <glm/gtc/matrix_transform.hpp>
#include <random>

#include "body/skinning.h"
#include "gpu/barrier.h"
#include "gpu/gpu_rig.h"
#include "reference/detail.h"
#include "reference/visible.h"
#include "render/frame_upload.h"
#include "render/skin_pass.h"
#include "render/tube_pass.h"
#include "shared/sweep.h"
#include "support/frames.h"
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

void compare(Difference& worst, std::span<const shared::TubeVertex> found,
             std::span<const SurfacePoint> wanted) {
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

Camera cameraAt(vec3 position, float orthographic = 0) {
  Camera camera;
  camera.position = position;
  camera.target = {0, 0.5f, 0};
  camera.verticalAngle = 0.7f;
  camera.orthographicHeight = orthographic;
  camera.nearDistance = 0.05f;
  return camera;
}

// A network in device memory and the passes that draw it.
struct Tubes {
  Tubes(const test::GpuRig& used, const Network& network, std::vector<vec4> posed, const TubeDetail& detail,
        std::uint32_t samplesOfPixel = 1)
      : rig(used),
        samples(samplesOfPixel),
        points(std::move(posed)),
        frames(test::framesOf(network, points)),
        set(rig.device(), network, detail, 1u << 20),
        forks(rig.device(), set.table(), detail, 1u << 20),
        detailPass(rig.device(), set),
        pass(rig.device(), samples, set),
        planPass(rig.device()),
        pointBuffer(rig.upload(points)),
        knotBuffer(rig.upload(frames)) {}

  shared::DetailView view(const Camera& camera) const {
    return detailView(camera, {}, pictureGrid(rig.device(), {333, 222}, samples), set.detail());
  }
  NetworkDetail chosen(const shared::DetailView& wanted) const { return networkDetail(posed(), wanted); }
  PosedNetwork posed() const { return {set.table(), points, frames}; }

  const test::GpuRig& rig;
  std::uint32_t samples;
  std::vector<vec4> points;
  std::vector<quat> frames;
  TubeSet set;
  ForkSet forks;
  DetailPass detailPass;
  TubePass pass;
  PlanPass planPass;
  gpu::Buffer pointBuffer, knotBuffer;
};

struct Drawn {
  std::vector<shared::TubeVertex> vertices;
  std::vector<std::uint32_t> indices;
  std::vector<shared::DrawCommand> draws;
};

// Every group's triangles, in one round.
Drawn drawnTubes(const Tubes& tubes, const shared::DetailView& view, bool cull) {
  const FillRange all{0, std::uint32_t(tubes.set.table().sweeps.size()), 0, 0};
  const Filling filling(tubes.rig.device(), tubes.set, tubes.forks, roomForAll(tubes.set, tubes.forks, all));
  const Template filled(tubes.rig.device(), filling.room());
  tubes.rig.run([&](VkCommandBuffer commands) {
    filling.recordStart(commands, all);
    tubes.detailPass.record(commands, tubes.set, tubes.pointBuffer.address(), view);
    tubes.pass.record(commands, {tubes.set, tubes.detailPass, tubes.pointBuffer.address(),
                                 tubes.knotBuffer.address(), filling, filled, cull});
    gpu::stageBarrier(commands, VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT,
                      VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT);
    tubes.planPass.record(commands, filling, filled);
  });
  return {tubes.rig.download<shared::TubeVertex>(filled.pool), tubes.rig.download<std::uint32_t>(filled.pool),
          tubes.rig.download<shared::DrawCommand>(filled.draws)};
}

// The rings of one sweep with its caps, as shaders/tubes.comp writes them where all are needed.
struct Rings {
  std::vector<SurfacePoint> points;
  std::vector<char> near;  // each ring: may reach before the near plane
};

Rings ringsOf(const PosedNetwork& network, std::uint32_t sweep, std::uint32_t around, std::uint32_t along,
              const shared::DetailView& view) {
  const std::uint32_t caps = network.table.sweeps[sweep].caps, ringsOfCap = capRings(around, view);
  const std::vector<vec2> directions = ringDirections(around), angles = capAngles();
  Rings rings;
  const auto add = [&](std::uint32_t ring, std::uint32_t polar, float outward) {
    const Section section = ringSection(network, sweep, ring, along);
    for (const vec2& direction : directions)
      rings.points.push_back(capPoint(section, direction, angles[polar], outward));
    const vec4 centre(section.centre + section.radius * outward * angles[polar].y * section.frame.tangent, 1);
    rings.near.push_back(glm::dot(view.planes[4], centre) <= 1.01f * section.radius);
  };
  if (caps & 1)
    for (std::uint32_t j = ringsOfCap; j > 0; --j) add(0, j * shared::kCapRings / ringsOfCap, -1);
  for (std::uint32_t ring = 0; ring <= along; ++ring) add(ring, 0, 1);
  if (caps & 2)
    for (std::uint32_t j = 1; j <= ringsOfCap; ++j) add(along, j * shared::kCapRings / ringsOfCap, 1);
  return rings;
}

vec2 placeOf(const shared::TubeVertex& v, const shared::DetailView& view) {
  const vec4 p(v.x, v.y, v.z, 1);
  return vec2(glm::dot(view.picture[0], p), glm::dot(view.picture[1], p)) / glm::dot(view.picture[2], p);
}

struct Triangles {
  std::vector<uvec3> all, seen;
};

// The triangles of one sweep whose vertices begin at `base`, in the pass's order.
// @param near  of each ring
Triangles trianglesOf(const Drawn& drawn, const shared::DetailView& view, std::uint32_t base,
                      const std::vector<char>& near, std::uint32_t m, std::uint32_t samples) {
  Triangles triangles;
  for (std::uint32_t strip = 0; strip + 1 < near.size(); ++strip)
    for (std::uint32_t k = 0; k < m; ++k) {
      const std::uint32_t a = base + strip * m + k, b = base + strip * m + (k + 1) % m, c = b + m, d = a + m;
      const auto at = [&](std::uint32_t i) { return placeOf(drawn.vertices[i], view); };
      const std::uint32_t seen =
          near[strip] || near[strip + 1]
              ? 3
              : seenOfQuad(at(a), at(b), at(c), at(d), {{view.columns, view.rows}, view.snap, samples});
      triangles.all.insert(triangles.all.end(), {{a, b, c}, {a, c, d}});
      if (seen & 1) triangles.seen.push_back({a, b, c});
      if (seen & 2) triangles.seen.push_back({a, c, d});
    }
  return triangles;
}

using Corners = std::array<std::uint32_t, 12>;  // a triangle's vertices, bit for bit

Corners cornersOf(const Drawn& drawn, const uvec3& triangle) {
  Corners corners;
  for (int i = 0; i < 3; ++i)
    std::memcpy(&corners[4 * i], &drawn.vertices[triangle[i]], sizeof(shared::TubeVertex));
  return corners;
}

std::vector<Corners> drawnTriangles(const Drawn& drawn, std::uint32_t group) {
  const shared::DrawCommand& draw = drawn.draws[group];
  CHECK((draw.instanceCount == 1 || draw.indexCount == 0));
  CHECK(draw.indexCount % 3 == 0);
  std::vector<Corners> found;
  for (std::uint32_t i = 0; i < draw.indexCount; i += 3) {
    const std::uint32_t* index = &drawn.indices[draw.firstIndex + i];
    found.push_back(cornersOf(drawn, uvec3(index[0], index[1], index[2]) + std::uint32_t(draw.vertexOffset)));
  }
  return found;
}

struct Outcome {
  Difference vertices;
  std::size_t triangles = 0, drawn = 0, wrong = 0;  // wrong: drawn or left out against the reference
};

// With cull, against what the pass draws without: the same vertices, but only those that are needed.
Outcome passAgainstReference(const Tubes& tubes, const shared::DetailView& view, bool cull) {
  const NetworkDetail detail = tubes.chosen(view);
  Outcome outcome;
  const Drawn whole = drawnTubes(tubes, view, false), drawn = cull ? drawnTubes(tubes, view, true) : whole;
  const std::uint32_t size = tubes.set.groupSweeps(), sweeps = std::uint32_t(tubes.set.table().sweeps.size());
  for (std::uint32_t group = 0; group < gpu::groupsFor(sweeps, size); ++group) {
    std::vector<Corners> wanted;
    std::uint32_t next = std::uint32_t(whole.draws[group].vertexOffset);
    for (std::uint32_t sweep = group * size; sweep < std::min((group + 1) * size, sweeps); ++sweep) {
      const std::uint32_t along = detail.along[sweep];
      if (along == 0) continue;
      const std::uint32_t m = detail.around[tubes.set.table().vesselOfSweep[sweep]], base = next;
      const Rings rings = ringsOf(tubes.posed(), sweep, m, along, view);
      next += inBlocks(std::uint32_t(rings.points.size()));
      compare(outcome.vertices, std::span(whole.vertices).subspan(base, rings.points.size()), rings.points);
      const Triangles triangles = trianglesOf(whole, view, base, rings.near, m, tubes.samples);
      outcome.triangles += triangles.all.size();
      for (const uvec3& triangle : cull ? triangles.seen : triangles.all)
        wanted.push_back(cornersOf(whole, triangle));
    }
    std::vector<Corners> found = drawnTriangles(drawn, group), different;
    outcome.drawn += found.size();
    if (!cull) CHECK(found == wanted);  // in the same order, too
    std::ranges::sort(found);
    std::ranges::sort(wanted);
    std::ranges::set_symmetric_difference(found, wanted, std::back_inserter(different));
    outcome.wrong += different.size();
  }
  return outcome;
}

}  // namespace

TEST_CASE("tubes are what the CPU reference says, at all extremes of m and n") {
  VASA_REQUIRE_GPU(rig);
  const Network network = test::windingNetwork(37, 21);
  for (const SweepShape shape : {SweepShape{3, 2}, SweepShape{3, 20}, SweepShape{4, 5}, SweepShape{7, 3},
                                 SweepShape{8, 10}, SweepShape{16, 2}, SweepShape{16, 20}}) {
    CAPTURE(shape.around);
    CAPTURE(shape.along);
    const Tubes tubes(rig, network, test::restPoints(network), {shape, 0});
    const Outcome outcome = passAgainstReference(tubes, tubes.view(cameraAt({0, 0.5f, 9})), false);
    CHECK(outcome.triangles == tubes.set.triangleCount());
    CHECK(outcome.drawn == outcome.triangles);
    CHECK(outcome.wrong == 0);
    CHECK(outcome.vertices.position <= 1e-5f);
    CHECK(outcome.vertices.normal <= 1e-3f);
  }
}

TEST_CASE("one sweep, and one more than a workgroup takes") {
  VASA_REQUIRE_GPU(rig);
  for (const std::uint32_t spans : {1u, 2u, 21u, 64u, 65u}) {
    const Network network = test::straightVessel(0.5f, 0.02f, 0.004f, spans);
    const Tubes tubes(rig, network, test::restPoints(network), {{5, 2}, 0});
    const Outcome outcome = passAgainstReference(tubes, tubes.view(cameraAt({2, 0.5f, 1})), false);
    CHECK(outcome.triangles == 10 * (2 * spans + 6));
    CHECK(outcome.wrong == 0);
    CHECK(outcome.vertices.position <= 1e-5f);
    CHECK(outcome.vertices.normal <= 1e-3f);
  }
}

TEST_CASE("m, n and what is left out are what the CPU reference says, from near and far") {
  VASA_REQUIRE_GPU(rig);
  const Network network = test::windingNetwork(60, 4);
  std::size_t drawn = 0, wrong = 0;
  for (const float tolerance : {0.2f, 0.8f})
    for (const std::uint32_t samples : {1u, 4u}) {
      const Tubes tubes(rig, network, test::restPoints(network), {{}, tolerance}, samples);
      for (const Camera& camera :
           {cameraAt({0, 0.5f, 3}), cameraAt({0.3f, 0.5f, 0.4f}), cameraAt({0.05f, 0.45f, 0.1f}),
            cameraAt({1, 2, -1}, 1.5f), cameraAt({0, 9, 0.1f}, 0.2f)}) {
        const shared::DetailView view = tubes.view(camera);
        const NetworkDetail wanted = tubes.chosen(view);
        rig.run([&](VkCommandBuffer commands) {
          tubes.detailPass.record(commands, tubes.set, tubes.pointBuffer.address(), view);
        });
        CHECK(rig.download<std::uint32_t>(tubes.detailPass.aroundBuffer()) == wanted.around);
        CHECK(rig.download<std::uint32_t>(tubes.detailPass.alongBuffer()) == wanted.along);
        const Outcome outcome = passAgainstReference(tubes, view, true);
        CHECK(outcome.vertices.position <= 1e-5f);
        CHECK(outcome.drawn < outcome.triangles);
        drawn += outcome.drawn;
        wrong += outcome.wrong;
      }
    }
  CHECK(drawn > 1000);
  CHECK(double(wrong) <= 1e-3 * double(drawn));  // the reference's margins may round the other way
}

TEST_CASE("skinning on the device is that of the body's") {
  VASA_REQUIRE_GPU(rig);
  std::mt19937 engine(17);
  std::uniform_real_distribution<float> number(-1, 1);
  SkinnedMesh mesh;
  mesh.name = "skin";
  for (int i = 0; i < 333; ++i) {
    mesh.mesh.positions.push_back({number(engine), number(engine), number(engine)});
    mesh.normals.push_back(glm::normalize(mesh.mesh.positions.back() + vec3(0.01f)));
    SkinInfluence influence;
    for (int k = 0; k < 4; ++k) influence.joints[k] = std::uint16_t(engine() % 7);
    influence.weights = i % 3 == 0 ? vec4(1, 0, 0, 0) : vec4(0.4f, 0.3f, 0.2f, 0.1f);
    mesh.influences.push_back(influence);
  }
  std::vector<mat4> matrices;
  for (int k = 0; k < 7; ++k)
    matrices.push_back(glm::translate(glm::mat4_cast(glm::angleAxis(number(engine), vec3(0, 0.6f, 0.8f))),
                                      vec3{number(engine), number(engine), number(engine)}));
  const MeshSet meshes(rig.device(), std::span(&mesh, 1), {oneLevel(mesh)});
  std::vector<MeshSet::Level> levels;
  meshes.levelsFor({}, matrices, {}, 100, 0, levels);
  const SkinPass pass(rig.device());
  FrameUpload upload(rig.device(), 0, 0, meshes.jointCount());
  upload.write({}, {}, matrices);
  rig.run([&](VkCommandBuffer commands) {
    upload.record(commands);
    pass.record(commands, meshes, levels, upload.joints(), upload.jointCount());
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
  std::vector<vec4> points = test::restPoints(network);
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
  const Tubes tubes(rig, network, points, {{6, 5}, 0});
  const Difference worst = passAgainstReference(tubes, tubes.view(cameraAt({0, 0.5f, 3})), false).vertices;
  CHECK(worst.position <= 1e-5f);
  CHECK(worst.normal <= 1e-3f);
}
