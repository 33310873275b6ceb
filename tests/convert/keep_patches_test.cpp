#include "convert/keep_patches.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <random>

#include "convert/forked_source.h"
#include "convert/unfold.h"
#include "convert/wall_thin.h"
#include "core/hash.h"
#include "core/parallel.h"
#include "io/gltf.h"
#include "mesh/triangle_tree.h"
#include "network/file.h"
#include "network/merge.h"
#include "network/reshape.h"
#include "support/frames.h"
#include "support/manifold.h"
#include "support/shared_data.h"
#include "surface/octahedral.h"
#include "surface/surface_mesh.h"

using namespace vasa;
using namespace vasa::test;

namespace {

std::size_t openEdgesOf(const Network& network, std::span<const vec4> points, const SweepShape& shape) {
  const SurfaceMesh mesh = surfaceMesh(network, points, framesOf(network, points), shape);
  return openEdges(mesh.triangles);
}

// Bent about the z axis, the more the higher up.
std::vector<vec4> bent(const Network& network) {
  std::vector<vec4> points(network.points().begin(), network.points().end());
  for (vec4& p : points) {
    const float angle = 4 * p.y;
    p = vec4(p.x * std::cos(angle) - 0.2f * (1 - std::cos(angle)), (p.x + 0.2f) * std::sin(angle), p.z,
             0.9f * p.w);
  }
  pinEnds(network, points);
  return points;
}

bool sameBytes(const Network& a, const Network& b) { return encodeNetwork(a) == encodeNetwork(b); }

}  // namespace

TEST_CASE(
    "the wall of a scanned fork is kept, closed with the tubes at rest and bent, whatever their quads") {
  const Forked& made = forked();
  REQUIRE(made.report.forks.size() == 2);
  for (const PatchReport::Fork& fork : made.report.forks) CHECK(outcomeName(fork.outcome) == "kept");
  REQUIRE(made.network.patches().size() == 2);
  const SweepTable table = makeSweepTable(made.network);
  CHECK(table.patches.patches.size() == 2);
  for (const shared::ForkRecord& fork : table.forks) CHECK(fork.branchCount == 0);
  for (const std::uint32_t around : {3u, 4u, 7u, 8u, 16u}) {
    CAPTURE(around);
    CHECK(openEdgesOf(made.network, made.network.points(), {around, 3}) == 0);
    CHECK(openEdgesOf(made.network, bent(made.network), {around, 3}) == 0);
  }
}

TEST_CASE("no triangle of a patch is folded at rest") {
  const Forked& made = forked();
  REQUIRE(!made.network.patches().empty());
  for (const ForkPatch& patch : made.network.patches())
    CHECK(foldedTriangles({patch.positions, patch.triangles}).empty());
  TriangleMesh drawn;  // normals on loops are those of the tubes
  std::vector<vec3> normals;
  const PatchTable table = makeSweepTable(made.network).patches;
  for (const shared::SkinVertex& v : table.vertices)
    drawn.positions.emplace_back(v.x, v.y, v.z), normals.push_back(unpackOctahedral(v.normal));
  drawn.triangles = table.triangles;
  CHECK(foldedTriangles(drawn, normals).empty());
}

TEST_CASE("at rest a patch is the source's wall, and eases into the tubes beside the rings") {
  const Forked& made = forked();
  REQUIRE(!made.network.patches().empty());
  const TriangleTree wall(made.elements[0].element.mesh);
  const Network& network = made.network;
  const SurfaceMesh mesh = surfaceMesh(network, network.points(), framesOf(network), {8, 5});
  std::size_t on = 0, all = 0;
  for (const ForkPatch& patch : network.patches())
    for (std::size_t i = 0; i < patch.positions.size(); ++i, ++all) {
      const float distance = wall.nearest(patch.positions[i]).distance;
      const auto most = *std::ranges::max_element(patch.weights[i]);
      on += distance < 1e-5f;
      CHECK(distance < 0.0015f);
      if (most < 127) CHECK(distance < 1e-5f);
    }
  CHECK(on > all / 4);
  // Drawn where it was cut out.
  const PatchTable table = makeSweepTable(network).patches;
  float moved = 0;
  std::size_t at = mesh.positions.size();
  for (const PatchTable::Patch& patch : table.patches) at -= patch.vertexCount;
  for (const PatchTable::Patch& patch : table.patches)
    for (std::uint32_t i = 0; i < patch.vertexCount; ++i, ++at) {
      const shared::SkinVertex& v = table.vertices[patch.firstVertex + i];
      moved = std::max(moved, glm::distance(mesh.positions[at], vec3(v.x, v.y, v.z)));
    }
  CHECK(moved < 1e-6f);
}

TEST_CASE("patches survive files, merging and other shapes; a plain network's file is as it was") {
  const Forked& made = forked();
  REQUIRE(made.network.patches().size() == 2);
  const auto bytes = encodeNetwork(made.network);
  const auto read = decodeNetwork(bytes, "x.vasa");
  REQUIRE(read.ok());
  CHECK(read->patches().size() == 2);
  CHECK(sameBytes(*read, made.network));
  for (std::size_t i = 0; i < read->patches()[0].positions.size(); ++i)
    CHECK(glm::distance(read->patches()[0].positions[i], made.network.patches()[0].positions[i]) < 1e-6f);
  const auto rounded = decodeNetwork(encodeNetwork(made.network, {.quantise = true}), "x.vasa");
  REQUIRE(rounded.ok());
  CHECK(makeSweepTable(*rounded).patches.patches.size() == 2);
  const std::vector<Network> two{*read, *read};
  const auto merged = mergeNetworks(two);
  REQUIRE(merged.ok());
  CHECK(merged->patches()[2].rings[0].vessel.value ==
        read->patches()[0].rings[0].vessel.value + read->vessels().size());
  const auto shaped = reshapeNetwork(*read, bent(*read), 1);
  REQUIRE(shaped.ok());
  CHECK(shaped->patches().size() == 2);
  CHECK(openEdgesOf(*shaped, shaped->points(), {8, 3}) == 0);
  const auto bare = withPatches(*read, {});
  REQUIRE(bare.ok());
  CHECK(encodeNetwork(*bare).size() < bytes.size());
  CHECK(makeSweepTable(*bare).patches.patches.empty());
}

TEST_CASE("what is wrong with a patch is told") {
  const Forked& made = forked();
  REQUIRE(!made.network.patches().empty());
  ForkPatch patch = made.network.patches()[0];
  const auto fault = [&] { return patchFault(made.network, patch); };
  CHECK(fault().empty());
  SUBCASE("rings") {
    patch.rings.pop_back();
    CHECK(fault() == "it has 2 rings, not 3 or 4");
  }
  SUBCASE("vessel") {
    patch.rings[1].vessel.value = 999;
    CHECK(fault() == "a ring is on a vessel that is not there");
  }
  SUBCASE("place") {
    patch.rings[1].parameter = NAN;
    CHECK(fault() == "a ring lies outside its vessel");
  }
  SUBCASE("radius") {
    patch.rings[0].radius = 0;
    CHECK(fault() == "a ring has no size or place");
  }
  SUBCASE("direction") {
    patch.rings[0].outward *= 2;
    CHECK(fault() == "a ring has no direction");
  }
  SUBCASE("loop") {
    patch.rings[0].vertices = 2;
    CHECK(fault() == "a loop has fewer than 3 vertices");
  }
  SUBCASE("long loop") {
    patch.rings[0].vertices = 60000;
    CHECK(fault() == "a loop has more than 4096 vertices");
  }
  SUBCASE("loops") {
    for (PatchRing& ring : patch.rings) ring.vertices = 4096;
    CHECK(fault() == "its loops have more vertices than it has");
  }
  SUBCASE("apart") {
    patch.rings[2].centre.x = 1e20f;
    CHECK(fault() == "its rings lie too far apart");
  }
  SUBCASE("vertex") {
    patch.positions.back().y = INFINITY;
    CHECK(fault() == "a vertex lies too far away");
  }
  SUBCASE("weights") {
    patch.weights.back()[0] ^= 1;
    CHECK(fault() == "weights do not add up");
  }
  SUBCASE("count of weights") {
    patch.weights.pop_back();
    CHECK(fault() == "vertices and weights differ in number");
  }
  SUBCASE("index") {
    patch.triangles[0].x = std::uint32_t(patch.positions.size());
    CHECK(fault() == "a triangle has no three vertices");
  }
  SUBCASE("twice") {
    patch.triangles.push_back(patch.triangles[0]);
    CHECK(fault() == "triangles overlap or disagree on the outside");
  }
  SUBCASE("hole") {
    patch.triangles.pop_back();
    CHECK(fault() == "its border is not its loops");
  }
  SUBCASE("told with its number") {
    patch.triangles.pop_back();
    const auto network = withPatches(made.network, {made.network.patches()[1], patch});
    REQUIRE(!network.ok());
    CHECK(network.error().message == "patch 1: its border is not its loops");
  }
}

TEST_CASE("no signed garbage in a patch makes the reader crash, and what it takes can be drawn") {
  std::mt19937 random(7);
  const Forked& made = forked();
  const auto good = encodeNetwork(made.network), bare = encodeNetwork(*withPatches(made.network, {}));
  int accepted = 0;
  for (int trial = 0; trial < 4000; ++trial) {
    auto bytes = good;
    for (int flips = 1 + int(random() % 3); flips; --flips)
      bytes[bare.size() + random() % (bytes.size() - bare.size())] = std::byte(random());
    const std::uint64_t sum = hashBytes(std::span(bytes).subspan(24));
    std::memcpy(&bytes[16], &sum, 8);
    const auto network = decodeNetwork(bytes, "x.vasa");
    accepted += network.ok();
    if (network.ok() && accepted % 16 == 0) CHECK(openEdgesOf(*network, network->points(), {5, 2}) == 0);
  }
  CHECK(accepted > 0);
  CHECK(accepted < 4000);
}

TEST_CASE("vessels that are surfaces of their own, or torn, keep what these make together") {
  TriangleMesh branch = tubeBetween({0.004f, 0.1f, 0}, {0.08f, 0.11f, 0}, 0.0035f, TubeEnds::open);
  SUBCASE("as they are") {}
  SUBCASE("inside out") {
    for (uvec3& t : branch.triangles) std::swap(t.y, t.z);
  }
  SUBCASE("torn") { branch.triangles.erase(branch.triangles.begin() + 200, branch.triangles.begin() + 204); }
  const std::vector<SourceElement> elements{source("aorta", tubeBetween({0, 0, 0}, {0, 0.2f, 0}, 0.008f)),
                                            source("left renal artery", branch)};
  auto conversion = convertElements(elements);
  REQUIRE(conversion.ok());
  KeptPatches kept = keepPatches(conversion->network, elements, conversion->elementOf);
  REQUIRE(kept.report.forks.size() == 1);
  CHECK(outcomeName(kept.report.forks[0].outcome) == "kept");
  CHECK(kept.report.joined() == 1);
  CHECK(kept.report.triangles < 1500);
  REQUIRE(kept.patches.size() == 1);
  for (const vec3& p : kept.patches[0].positions) {
    const float aorta = std::abs(glm::length(vec2(p.x, p.z)) - 0.008f);
    const float renal = std::abs(capsuleDistance(p, {0, 0.1f, 0}, {0.08f, 0.11f, 0}, 0.0035f));
    CHECK(std::min(aorta, renal) < 0.0008f);
  }
  const auto network = withPatches(std::move(conversion->network), std::move(kept.patches));
  REQUIRE(network.ok());
  for (const std::uint32_t around : {4u, 8u, 13u})
    CHECK(openEdgesOf(*network, network->points(), {around, 3}) == 0);
}

TEST_CASE("a short gap between vessels' walls is closed") {
  const std::vector<SourceElement> elements{
      source("aorta", tubeBetween({0, 0, 0}, {0, 0.2f, 0}, 0.008f)),
      source("left renal artery", tubeBetween({0.0105f, 0.1f, 0}, {0.08f, 0.11f, 0}, 0.003f))};
  auto conversion = convertElements(elements);
  REQUIRE(conversion.ok());
  KeptPatches kept = keepPatches(conversion->network, elements, conversion->elementOf);
  REQUIRE(kept.patches.size() == 1);
  const auto network = withPatches(std::move(conversion->network), std::move(kept.patches));
  REQUIRE(network.ok());
  CHECK(openEdgesOf(*network, network->points(), {8, 3}) == 0);
}

TEST_CASE("rings move out to where the walls of vessels have parted") {
  // A branch as thick as its trunk, beside it for a while: flattened walls that touch beyond their round
  // tubes.
  const std::vector<SourceElement> elements{
      source("aorta", tubeBetween({0, 0, 0}, {0, 0.2f, 0}, 0.006f)),
      source("left renal artery", tubeBetween({0.001f, 0.06f, 0}, {0.04f, 0.19f, 0}, 0.0045f))};
  auto conversion = convertElements(elements);
  REQUIRE(conversion.ok());
  KeptPatches kept = keepPatches(conversion->network, elements, conversion->elementOf);
  REQUIRE(kept.report.forks.size() == 1);
  CHECK(outcomeName(kept.report.forks[0].outcome) == "kept");
  const auto network = withPatches(std::move(conversion->network), std::move(kept.patches));
  REQUIRE(network.ok());
  REQUIRE(makeSweepTable(*network).patches.patches.size() == 1);
  CHECK(openEdgesOf(*network, network->points(), {8, 3}) == 0);
  CHECK(openEdgesOf(*network, bent(*network), {8, 3}) == 0);
}

TEST_CASE("forks whose walls do not meet, and centre lines, are told") {
  std::vector<SourceElement> elements{
      source("aorta", tubeBetween({0, 0, 0}, {0, 0.2f, 0}, 0.008f)),
      source("left renal artery", tubeBetween({0.0105f, 0.1f, 0}, {0.08f, 0.11f, 0}, 0.003f))};
  const auto conversion = convertElements(elements);
  REQUIRE(conversion.ok());
  for (SourceElement& element : elements)
    for (vec3& p : element.element.mesh.positions) p.z += 0.05f;  // the walls are elsewhere
  const KeptPatches kept = keepPatches(conversion->network, elements, conversion->elementOf);
  CHECK(kept.patches.empty());
  REQUIRE(kept.report.forks.size() == 1);
  CHECK(kept.report.forks[0].outcome == PatchOutcome::apart);
  CHECK(keepPatches(conversion->network, {}, {}).report.count(PatchOutcome::noMesh) == 1);
}

TEST_CASE("a thinned wall keeps its shape, its loops and its topology") {
  const Forked& made = forked();
  REQUIRE(!made.network.patches().empty());
  for (ForkPatch patch : made.network.patches()) {
    WallPiece wall{WallFault::none, {patch.positions, patch.triangles}, {}};
    for (const PatchRing& ring : patch.rings) wall.loops.push_back(ring.vertices);
    const WallPiece thin = thinned(wall, 0.0004f);
    CHECK(thin.mesh.triangles.size() < wall.mesh.triangles.size() / 4);
    patch.positions = thin.mesh.positions;
    patch.triangles = thin.mesh.triangles;
    patch.weights.assign(patch.positions.size(), {255, 0, 0, 0});
    for (std::size_t i = 0; i < patch.rings.size(); ++i) patch.rings[i].vertices = thin.loops[i];
    CHECK(patchFault(made.network, patch) == "");
    const TriangleTree tree(thin.mesh);
    for (const vec3& p : wall.mesh.positions) CHECK(tree.nearest(p).distance < 0.0005f);
  }
}

TEST_CASE("a real body's vessels keep walls and stay one closed surface, at rest and bent") {
  VASA_REQUIRE_SHARED_DATA(data);
  auto all = readGltfElements(data / "bp3d/bp3d_arteries.glb");
  REQUIRE(all.ok());
  std::erase_if(*all, [](const MeshElement& e) {
    const auto has = [&](const char* part) { return e.name.find(part) != std::string::npos; };
    return !has("renal artery") && !has("mesenteric");
  });
  const std::vector<SourceElement> elements = describeElements(std::move(*all), "bp3d_arteries");
  auto conversion = convertElements(elements);
  REQUIRE(conversion.ok());
  KeptPatches kept = keepPatches(conversion->network, elements, conversion->elementOf);
  MESSAGE(kept.patches.size() << " of " << kept.report.forks.size() << " forks keep their wall");
  CHECK(kept.patches.size() > 10);
  const auto network = withPatches(std::move(conversion->network), std::move(kept.patches));
  REQUIRE(network.ok());
  CHECK(makeSweepTable(*network).patches.patches.size() == network->patches().size());
  CHECK(openEdgesOf(*network, network->points(), {8, 5}) == 0);
  CHECK(openEdgesOf(*network, bent(*network), {8, 5}) == 0);
}

TEST_CASE("the same patches come out for any number of threads") {
  std::vector<std::byte> first;
  for (const unsigned threads : {1u, 3u}) {
    setThreadCount(threads);
    const auto bytes = encodeNetwork(makeForked().network);
    if (first.empty()) first = bytes;
    CHECK(bytes == first);
  }
  setThreadCount(0);
}
