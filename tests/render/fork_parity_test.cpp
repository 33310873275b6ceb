#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <map>
#include <set>

#include "drawn_surface.h"
#include "reference/detail.h"
#include "support/frames.h"
#include "support/networks.h"
#include "surface/fork_check.h"
#include "surface/fork_template.h"
#include "surface/octahedral.h"

// The forks' pass against its CPU reference: 1e-6 of the body's height (here 1 m) in position, 2e-4 in
// normals (they are packed to 7e-5), triangles alike; and against the tubes' pass: the rings that they share,
// bit for bit.

using namespace vasa;

namespace {

using test::Forks;

void checkAgainstReference(const Forks& passes) {
  float position = 0, normal = 0;
  std::vector<uvec3> wanted;
  const auto& records = passes.tubes.table().forks;
  const std::vector<std::uint32_t> first = passes.firstForkVertices();
  for (std::uint32_t i = 0; i < records.size(); ++i) {
    const ForkShape shape = passes.shapeOf(records[i]);
    const std::uint32_t base = first[i];
    std::vector<SurfacePoint> points(shape.vertices());
    const ForkLayout layout = evaluateFork(passes.posed(), records[i], shape, points);
    for (std::uint32_t k = 0; k < points.size(); ++k) {
      const shared::TubeVertex& v = passes.forksDrawn.vertices[base + k];
      position = std::max(position, glm::distance(vec3(v.x, v.y, v.z), points[k].position));
      normal = std::max(normal, glm::distance(unpackOctahedral(v.normal), points[k].normal));
    }
    for (const uvec3& t : forkTriangles(shape, layout, points)) wanted.push_back(t + base);
  }
  CHECK(position <= 1e-6f);
  CHECK(normal <= 2e-4f);
  std::vector<uvec3> found;
  for (const shared::DrawCommand& draw : passes.forksDrawn.draws)
    for (std::uint32_t i = 0; i < draw.indexCount; i += 3)
      found.push_back(test::cornersAt(passes.forksDrawn, draw, i));
  CHECK(found == wanted);
}

using Bits = std::array<std::uint32_t, 3>;

Bits bitsOf(const shared::TubeVertex& v) {
  return {std::bit_cast<std::uint32_t>(v.x), std::bit_cast<std::uint32_t>(v.y),
          std::bit_cast<std::uint32_t>(v.z)};
}

// Every vertex of a fork's rings is a vertex of a tube or of another fork's ring.
void checkSeams(const Forks& passes) {
  std::map<Bits, int> rings;
  const SweepTable& table = passes.tubes.table();
  const std::vector<std::uint32_t> tubes = passes.firstTubeVertices(), forks = passes.firstForkVertices();
  for (std::uint32_t i = 0; i < table.sweeps.size(); ++i) {
    const std::uint32_t m = passes.around[table.vesselOfSweep[i]], rows = passes.along[i];
    const std::uint32_t first = tubes[i] + capRings(m, passes.view) * (table.sweeps[i].caps & 1) * m;
    REQUIRE(rows > 0);
    for (std::uint32_t k = 0; k < m; ++k) {
      ++rings[bitsOf(passes.tubesDrawn.vertices[first + k])];
      ++rings[bitsOf(passes.tubesDrawn.vertices[first + rows * m + k])];
    }
  }
  const auto eachRing = [&](const auto& act) {
    for (std::uint32_t i = 0; i < table.forks.size(); ++i) {
      const ForkShape shape = passes.shapeOf(table.forks[i]);
      std::vector<std::uint32_t> ringRows{0, shared::kTrunkRows - 1};
      for (std::uint32_t branch = 0; branch < shape.branchCount; ++branch)
        ringRows.push_back(branchRow(branch));
      for (const std::uint32_t row : ringRows) {
        for (std::uint32_t k = 0; k < shape.rowSize(row); ++k)
          act(bitsOf(passes.forksDrawn.vertices[forks[i] + shape.rowStart(row) + k]));
      }
    }
  };
  eachRing([&](const Bits& bits) { ++rings[bits]; });
  std::size_t alone = 0;
  eachRing([&](const Bits& bits) { alone += rings[bits] < 2; });
  CHECK(alone == 0);
}

// Folds a good part of the forks, whatever smoothing does.
std::vector<vec4> inWaves(const Network& network) {
  std::vector<vec4> points = test::restPoints(network);
  for (vec4& p : points) p += 0.010f * vec4(std::sin(200 * p.y), std::sin(200 * p.z), std::sin(200 * p.x), 0);
  pinEnds(network, points);
  return points;
}

using Triangle = std::array<Bits, 3>;

std::set<Triangle> trianglesOf(const test::Drawn& drawn) {
  std::set<Triangle> triangles;
  for (const shared::DrawCommand& draw : drawn.draws)
    for (std::uint32_t i = 0; i < draw.indexCount; i += 3) {
      const uvec3 t = test::cornersAt(drawn, draw, i);
      REQUIRE(std::max({t.x, t.y, t.z}) < drawn.vertices.size());
      triangles.insert(
          {bitsOf(drawn.vertices[t.x]), bitsOf(drawn.vertices[t.y]), bitsOf(drawn.vertices[t.z])});
    }
  return triangles;
}

}  // namespace

TEST_CASE("forks on the device are those of the reference, and meet the tubes bit for bit") {
  VASA_REQUIRE_GPU(rig);
  const Network network = test::branchingNetwork(101, 5);
  for (const TubeDetail& detail : {TubeDetail{{3, 2}, 0}, TubeDetail{{4, 5}, 0}, TubeDetail{{7, 3}, 0},
                                   TubeDetail{{8, 20}, 0}, TubeDetail{{16, 2}, 0}, TubeDetail{{}, 0.02f}}) {
    CAPTURE(detail.shape.around);
    const Forks passes(rig, network, test::restPoints(network), test::framesOf(network), detail);
    REQUIRE(!passes.tubes.table().forks.empty());
    checkAgainstReference(passes);
    checkSeams(passes);
  }
}

TEST_CASE("forks of bent networks keep to the reference and to their seams") {
  VASA_REQUIRE_GPU(rig);
  const Network network = test::branchingNetwork(64, 8);
  std::vector<vec4> points = test::restPoints(network);
  for (vec4& p : points) {
    const float angle = 6 * p.y;  // twisted about the upright axis
    const vec2 c(std::cos(angle), std::sin(angle));
    p = vec4(c.x * p.x - c.y * p.z, p.y, c.y * p.x + c.x * p.z, p.w);
  }
  pinEnds(network, points);
  const Forks passes(rig, network, points, test::framesOf(network, points), {{8, 5}, 0});
  checkAgainstReference(passes);
  checkSeams(passes);
}

TEST_CASE("forks that waves fold are smoothed, and some turned into stumps, as in the reference") {
  VASA_REQUIRE_GPU(rig);
  const Network network = test::branchingNetwork(61, 4);
  const std::vector<vec4> points = inWaves(network);
  const Forks passes(rig, network, points, test::framesOf(network, points), {{8, 5}, 0});
  std::uint32_t folded = 0, stumps = 0;
  for (const shared::ForkRecord& fork : passes.tubes.table().forks) {
    folded += foldedUnsmoothed(passes.posed(), fork, 8) > 0;
    stumps += isStump(passes.posed(), fork, 8);
  }
  CHECK(folded > stumps);
  CHECK(stumps > 0);
  checkAgainstReference(passes);
  checkSeams(passes);
}

// All steps of smoothing, with the most vertices and what tells which triangles are seen: a shader that goes
// round more often than the device lets it leaves holes in the list of triangles.
TEST_CASE("forks that are smoothed most draw triangles of theirs and nothing else, with most quads around") {
  VASA_REQUIRE_GPU(rig);
  const Network network = test::branchingNetwork(61, 4);
  const std::vector<vec4> points = inWaves(network);
  const std::vector<quat> frames = test::framesOf(network, points);
  const TubeDetail detail{{shared::kMaxAround, 2}, 0};
  const Forks all(rig, network, points, frames, detail), seen(rig, network, points, frames, detail, true);
  const std::set<Triangle> whole = trianglesOf(all.forksDrawn), some = trianglesOf(seen.forksDrawn);
  CHECK(some.size() > whole.size() / 4);
  CHECK(some.size() < whole.size() * 3 / 4);
  CHECK(std::ranges::includes(whole, some));
  checkAgainstReference(all);
}
