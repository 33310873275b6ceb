#include <doctest/doctest.h>

#include <algorithm>

#include "convert/convert.h"
#include "convert/element.h"
#include "convert/strand_fit.h"
#include "curve/bspline.h"
#include "io/gltf.h"
#include "io/stl.h"
#include "io/vtp.h"
#include "math/closest_point.h"
#include "support/shared_data.h"

using namespace vasa;

namespace {

struct Coverage {
  double area = 0, covered = 0;
};

// Share of the mesh's area whose triangles' centres lie within max(1 mm, 20 % of the radius) of a fitted
// tube.
Coverage coverageOf(const TriangleMesh& mesh, const ElementSkeleton& skeleton) {
  std::vector<std::vector<vec4>> tubes;
  for (const ElementBranch& branch : skeleton.branches) {
    const auto points = fitStrand(branch.sections);
    for (const vec4& p : points) CHECK(p.w > 0);
    auto& tube = tubes.emplace_back();
    const std::uint32_t steps = 8 * spanCount(points);
    for (std::uint32_t i = 0; i <= steps; ++i) tube.push_back(evaluate(points, float(i) / 8));
  }
  Coverage coverage;
  for (const uvec3& t : mesh.triangles) {
    const vec3 a = mesh.positions[t.x], b = mesh.positions[t.y], c = mesh.positions[t.z];
    const vec3 p = (a + b + c) / 3.0f;
    const double area = 0.5 * glm::length(glm::cross(b - a, c - a));
    bool near = false;
    for (const auto& tube : tubes)
      for (std::size_t i = 0; i + 1 < tube.size() && !near; ++i) {
        const float at = closestOnSegment(p, vec3(tube[i]), vec3(tube[i + 1]));
        const vec4 q = glm::mix(tube[i], tube[i + 1], at);
        near = std::abs(glm::distance(p, vec3(q)) - q.w) <= std::max(1e-3f, 0.2f * q.w);
      }
    coverage.area += area;
    if (near) coverage.covered += area;
  }
  return coverage;
}

}  // namespace

TEST_CASE("every seventh artery and vein of a real body: a branch each, and its surface covered") {
  VASA_REQUIRE_SHARED_DATA(data);
  Coverage sum;
  std::size_t poor = 0, count = 0;
  for (const char* file : {"bp3d_arteries.glb", "bp3d_veins.glb"}) {
    const auto elements = readGltfElements(data / "bp3d" / file);
    REQUIRE(elements.ok());
    for (std::size_t i = 0; i < elements->size(); i += 7) {
      const TriangleMesh& mesh = (*elements)[i].mesh;
      const ElementSkeleton skeleton = skeletonise(mesh, {});
      INFO((*elements)[i].name);
      CHECK(!skeleton.branches.empty());
      const Coverage coverage = coverageOf(mesh, skeleton);
      sum.area += coverage.area;
      sum.covered += coverage.covered;
      poor += coverage.covered < 0.9 * coverage.area;
      ++count;
    }
  }
  CHECK(sum.covered / sum.area > 0.98);
  CHECK(poor <= count / 50);
}

TEST_CASE("VMTK's aorta: radii made of the surface agree with the reference centre lines in the median") {
  VASA_REQUIRE_SHARED_DATA(data);
  const ImportFrame millimetres{0.001, ImportFrame::Up::y};
  auto mesh = readStl(data / "centerlines/vmtk/aorta-surface.stl", millimetres);
  REQUIRE(mesh.ok());
  const auto made = convertElements(describeElements(std::move(*mesh), "aorta"));
  REQUIRE(made.ok());
  CHECK(made->report.summary.coverage > 0.98);
  const auto reference = readVtp(data / "centerlines/vmtk/aorta-centerline.vtp", millimetres);
  REQUIRE(reference.ok());
  std::vector<float> differences;
  for (const vec4& wanted : reference->points) {
    vec4 nearest(0);
    float least = 1;
    for (const Vessel& vessel : made->network.vessels())
      for (std::uint32_t i = 0; i <= 32 * vessel.spanCount(); ++i) {
        const vec4 at = evaluate(made->network.pointsOf(vessel), float(i) / 32);
        if (const float distance = glm::distance(vec3(at), vec3(wanted)); distance < least)
          least = distance, nearest = at;
      }
    differences.push_back(std::abs(nearest.w / wanted.w - 1));
  }
  std::ranges::sort(differences);
  MESSAGE("radii differ by " << 100 * differences[differences.size() / 2]
                             << " % in the median, 95 % of them by less than "
                             << 100 * differences[differences.size() * 95 / 100] << " %");
  CHECK(differences[differences.size() / 2] <= 0.05f);
  // Legs that start in the fork fill what they share of its lumen: no radius falls far short of the inscribed
  // sphere's.
  CHECK(differences[differences.size() * 95 / 100] < 0.15f);
}
