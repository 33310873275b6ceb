#include "surface/patch.h"

#include <algorithm>
#include <cmath>

#include "surface/octahedral.h"

namespace vasa {
namespace {

constexpr float kSamePlace = 0.25f;  // of the radius: a ring this near is the patch's
constexpr std::size_t kMostSeams = 65536;

struct ForkRings {
  std::array<const shared::ForkRing*, ForkPatch::kMostRings> ring{};
  std::array<std::uint32_t, ForkPatch::kMostRings> vessel{};
  std::size_t count = 0;
};

ForkRings ringsOf(const ForkPlan& plan, const shared::ForkRecord& fork) {
  ForkRings rings{{&fork.a, &fork.b}, {fork.vesselA, fork.vesselB}, 2 + std::size_t(fork.branchCount)};
  for (std::uint32_t i = 0; i < fork.branchCount; ++i) {
    rings.ring[2 + i] = &plan.branches[fork.firstBranch + i].ring;
    rings.vessel[2 + i] = plan.branches[fork.firstBranch + i].vessel;
  }
  return rings;
}

bool meets(const Network& network, const ForkPatch& patch, const ForkRings& rings) {
  if (patch.rings.size() != rings.count) return false;
  for (std::size_t i = 0; i < rings.count; ++i) {
    if (patch.rings[i].vessel.value != rings.vessel[i]) return false;
    const Vessel& vessel = network.vessels()[rings.vessel[i]];
    const vec4 own = evaluate(network.pointsOf(vessel), patch.rings[i].parameter);
    const vec4 there = evaluate(network.pointsOf(vessel), forkRingParameter(network, *rings.ring[i], rings.vessel[i]));
    if (glm::distance(vec3(own), vec3(there)) > kSamePlace * own.w) return false;
  }
  return true;
}

// The patch's frame at rest; see turnOf() of patch_pose.cpp.
std::array<vec3, 2> frameOf(const ForkPatch& patch) {
  const vec3 along = patch.rings[1].centre - patch.rings[0].centre, side = patch.rings[2].centre - patch.rings[0].centre;
  const float length = glm::length(along);
  const vec3 across = length > 0 ? along / length : vec3(1, 0, 0);
  const vec3 level = side - glm::dot(side, across) * across;
  const float size = glm::length(level);
  return {across, size > 0 ? level / size : anyPerpendicular(across)};
}

// How far around its loop each vertex of it lies, from the first on.
void addShares(const ForkPatch& patch, std::vector<float>& shares) {
  std::size_t vertex = 0;
  for (const PatchRing& ring : patch.rings) {
    const vec3 start = patch.positions[vertex] - ring.centre, side = glm::cross(ring.outward, start);
    float before = 0;
    for (std::uint32_t k = 0; k < ring.vertices; ++k, ++vertex) {
      const vec3 d = patch.positions[vertex] - ring.centre;
      float share = std::atan2(glm::dot(d, side), glm::dot(d, start - glm::dot(start, ring.outward) * ring.outward)) / (2 * kPi);
      if (share < 0) share += 1;
      before = k == 0 ? 0 : std::clamp(share, before, 1.0f);
      shares.push_back(before);
    }
  }
}

// The patch's own, and across the vessel on its loops, where tubes go on.
std::vector<vec3> normalsOf(const ForkPatch& patch) {
  std::vector<vec3> normals(patch.positions.size(), vec3(0));
  for (const uvec3& t : patch.triangles) {
    const vec3 a = patch.positions[t.x];
    const vec3 normal = glm::cross(patch.positions[t.y] - a, patch.positions[t.z] - a);
    for (int k = 0; k < 3; ++k) normals[t[k]] += normal;
  }
  std::size_t vertex = 0;
  for (const PatchRing& ring : patch.rings)
    for (std::uint32_t k = 0; k < ring.vertices; ++k, ++vertex) {
      const vec3 d = patch.positions[vertex] - ring.centre;
      normals[vertex] = d - glm::dot(d, ring.outward) * ring.outward;
    }
  for (vec3& n : normals) {
    const float size = glm::length(n);
    n = size > 0 ? n / size : vec3(0, 0, 1);
  }
  return normals;
}

void addVertices(const ForkPatch& patch, std::uint32_t firstSeam, std::vector<shared::SkinVertex>& vertices) {
  const std::vector<vec3> normals = normalsOf(patch);
  for (std::size_t i = 0; i < patch.positions.size(); ++i) {
    const auto joint = [&](std::size_t k) { return k < patch.rings.size() ? std::uint32_t(firstSeam + k) : firstSeam; };
    const auto& w = patch.weights[i];
    const vec3 p = patch.positions[i];
    vertices.push_back({p.x, p.y, p.z, packOctahedral(normals[i]), joint(0) | joint(1) << 16, joint(2) | joint(3) << 16,
                        vec4(w[0], w[1], w[2], w[3]) / 255.0f});
  }
}

void add(const Network& network, const ForkPatch& patch, const ForkRings& rings, PatchTable& table) {
  table.vertices.resize((table.vertices.size() + shared::kBlockVertices - 1) >> shared::kBlockShift << shared::kBlockShift);
  table.shares.resize(table.vertices.size());
  PatchTable::Patch added{.firstSeam = std::uint32_t(table.seams.size()),
                          .seamCount = std::uint32_t(rings.count),
                          .firstVertex = std::uint32_t(table.vertices.size()),
                          .vertexCount = std::uint32_t(patch.positions.size()),
                          .firstTriangle = std::uint32_t(table.triangles.size()),
                          .triangleCount = std::uint32_t(patch.triangles.size()),
                          .vessel = rings.vessel[0]};
  for (std::uint32_t v = 0; v < added.vessel; ++v) added.span += network.vessels()[v].spanCount();
  added.span += rings.ring[0]->point - network.vessels()[added.vessel].firstPoint;
  const auto [across, beside] = frameOf(patch);
  std::uint32_t loop = added.firstVertex;
  for (std::size_t i = 0; i < rings.count; ++i) {
    const PatchRing& ring = patch.rings[i];
    shared::PatchSeam seam{.ring = *rings.ring[i],
                           .centre = ring.centre,
                           .outward = ring.outward,
                           .radius = ring.radius,
                           .across = across,
                           .beside = beside,
                           .start = patch.positions[loop - added.firstVertex] - ring.centre,
                           .firstSeam = added.firstSeam,
                           .loop = loop,
                           .loopCount = ring.vertices,
                           .vertex = 0,
                           .index = 0,
                           .vessel = rings.vessel[i]};
    if (i == 0) seam.ring.turn = -seam.ring.turn;  // a fork's trunk runs from its first ring to its second
    table.seams.push_back(seam);
    loop += ring.vertices;
  }
  addVertices(patch, added.firstSeam, table.vertices);
  addShares(patch, table.shares);
  table.shares.resize(table.vertices.size());
  for (const uvec3& t : patch.triangles) table.triangles.push_back(t + added.firstVertex);
  table.patches.push_back(added);
}

}  // namespace

float forkRingParameter(const Network& network, const shared::ForkRing& ring, std::uint32_t vessel) {
  return float(ring.point - network.vessels()[vessel].firstPoint) + ring.t;
}

PatchTable takePatches(const Network& network, ForkPlan& plan) {
  PatchTable table;
  std::vector<bool> taken(plan.forks.size());
  for (const ForkPatch& patch : network.patches()) {
    if (table.seams.size() + patch.rings.size() > kMostSeams) break;
    for (std::size_t i = 0; i < plan.forks.size(); ++i) {
      const ForkRings rings = ringsOf(plan, plan.forks[i]);
      if (taken[i] || !meets(network, patch, rings)) continue;
      taken[i] = true;
      add(network, patch, rings, table);
      break;
    }
  }
  std::uint32_t vertex = std::uint32_t(table.vertices.size() + shared::kBlockVertices - 1) >> shared::kBlockShift << shared::kBlockShift;
  std::uint32_t index = 3 * std::uint32_t(table.triangles.size());
  for (shared::PatchSeam& seam : table.seams) {
    seam.vertex = vertex;
    seam.index = index;
    vertex += shared::kMaxAround;
    index += 3 * stripTriangles(seam, shared::kMaxAround);
  }
  std::size_t kept = 0;
  for (std::size_t i = 0; i < plan.forks.size(); ++i) {
    if (taken[i]) continue;
    plan.forks[kept] = plan.forks[i];
    plan.vesselOfFork[kept++] = plan.vesselOfFork[i];
  }
  plan.forks.resize(kept);
  plan.vesselOfFork.resize(kept);
  return table;
}

}  // namespace vasa
