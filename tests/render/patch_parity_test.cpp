#include <doctest/doctest.h>

#include "convert/forked_source.h"
#include "drawn_surface.h"
#include "surface/octahedral.h"

// The patches' pass against its CPU reference: 1e-6 m in position, 2e-4 in normals (they are packed to 7e-5), triangles
// alike; and with the tubes' and forks' passes: one closed surface, bit for bit.

using namespace vasa;

namespace {

using test::Forks;

void checkAgainstReference(const Forks& passes) {
  const PatchTable& table = passes.tubes.table().patches;
  float position = 0, normal = 0;
  const auto compare = [&](std::uint32_t vertex, const SurfacePoint& wanted) {
    const shared::TubeVertex& v = passes.patchesDrawn.vertices[vertex];
    position = std::max(position, glm::distance(vec3(v.x, v.y, v.z), wanted.position));
    normal = std::max(normal, glm::distance(unpackOctahedral(v.normal), wanted.normal));
  };
  const auto triangleAt = [&](std::uint32_t index) {
    const std::uint32_t* corner = &passes.patchesDrawn.indices[index];
    return uvec3(corner[0], corner[1], corner[2]);
  };
  std::vector<shared::JointRows> joints;
  for (std::uint32_t i = 0; i < table.seams.size(); ++i) {
    const shared::PatchSeam& seam = table.seams[i];
    const PosedSeam posed = poseSeam(passes.posed(), i, passes.around[seam.vessel]);
    joints.push_back(posed.joint);
    for (std::uint32_t k = 0; k < posed.ring.size(); ++k) compare(seam.vertex + k, posed.ring[k]);
    CHECK(posed.strip.size() == stripTriangles(seam, passes.around[seam.vessel]));
    std::size_t different = 0;
    for (std::uint32_t t = 0; t < posed.strip.size(); ++t) different += triangleAt(seam.index + 3 * t) != posed.strip[t];
    CHECK(different == 0);
  }
  for (const PatchTable::Patch& patch : table.patches)
    for (std::uint32_t i = patch.firstVertex; i < patch.firstVertex + patch.vertexCount; ++i)
      compare(i, poseVertex(table.vertices[i], joints));
  CHECK(position <= 1e-6f);
  CHECK(normal <= 2e-4f);
}

}  // namespace

TEST_CASE("patches on the device are those of the reference and close the surface, at rest and bent") {
  VASA_REQUIRE_GPU(rig);
  const test::Forked made = test::forked();
  REQUIRE(made.network.patches().size() == 2);
  const std::vector<vec3> references = restReferences(made.network);
  for (const float bend : {0.0f, 5.0f}) {
    std::vector<vec4> points(made.network.points().begin(), made.network.points().end());
    for (vec4& p : points) {  // twisted about the upright axis, and thinner
      const float angle = bend * p.y;
      p = vec4(p.x * std::cos(angle) - p.z * std::sin(angle), p.y, p.x * std::sin(angle) + p.z * std::cos(angle),
               p.w * (1 - 0.04f * bend));
    }
    pinEnds(made.network, points);
    std::vector<quat> frames(made.network.sectionCount());
    networkFrames(made.network, points, references, frames);
    for (const TubeDetail& detail : {TubeDetail{{3, 2}, 0}, TubeDetail{{7, 3}, 0}, TubeDetail{{8, 5}, 0},
                                     TubeDetail{{16, 4}, 0}, TubeDetail{{}, 0.02f}}) {
      CAPTURE(bend);
      CAPTURE(detail.shape.around);
      const Forks passes(rig, made.network, points, frames, detail);
      checkAgainstReference(passes);
      CHECK(test::openEdgesDrawn(passes) == 0);
    }
  }
}

TEST_CASE("without forks there are no patches either") {
  VASA_REQUIRE_GPU(rig);
  const test::Forked made = test::forked();
  TubeDetail detail{{8, 5}, 0};
  detail.forks = false;
  const TubeSet tubes(rig.device(), made.network, detail, 1024);
  CHECK(tubes.table().patches.patches.empty());
  CHECK(PatchSet(rig.device(), tubes.table().patches).empty());
}
