#include "surface/patch.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "surface/octahedral.h"
#include "surface/patch_smooth.h"

namespace vasa {
namespace {

constexpr float kSamePlace = 0.25f;  // radii: a ring that lies this far outside the patch's is taken for it
constexpr float kFarthest = 20;      // radii: from a ring to the patch's, behind it
constexpr std::size_t kMostSeams = 65536;

// Where a fork's rings are to be for a patch, and how far its own are from there altogether, in radii of the
// rings.
struct Meeting {
  std::array<float, ForkPatch::kMostRings> parameters{};
  float apart = 0;
};

// None where the patch is another fork's: a ring of it lies within the fork, or too far out.
std::optional<Meeting> meeting(const Network& network, const ForkPatch& patch, const ForkRings& rings) {
  if (patch.rings.size() != rings.count) return std::nullopt;
  for (std::size_t i = 0; i < rings.count; ++i)
    if (patch.rings[i].vessel.value != rings.vessel[i]) return std::nullopt;
  Meeting met;
  for (std::size_t i = 0; i < rings.count; ++i) {
    const auto points = network.pointsOf(network.vessels()[rings.vessel[i]]);
    const float wanted = patch.rings[i].parameter,
                there = forkRingParameter(network, *rings.ring[i], rings.vessel[i]);
    const vec4 own = evaluate(points, wanted);
    const float distance = glm::distance(vec3(own), vec3(evaluate(points, there)));
    const bool behind = rings.outward(i) * (wanted - there) > 0;
    if (distance > (behind ? kFarthest : kSamePlace) * own.w) return std::nullopt;
    met.parameters[i] = behind ? wanted : there;
    met.apart += distance / own.w;
  }
  return met;
}

// The patch's frame at rest; see turnOf() of patch_pose.cpp.
std::array<vec3, 2> frameOf(const ForkPatch& patch) {
  const vec3 along = patch.rings[1].centre - patch.rings[0].centre,
             side = patch.rings[2].centre - patch.rings[0].centre;
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
      float share =
          std::atan2(glm::dot(d, side), glm::dot(d, start - glm::dot(start, ring.outward) * ring.outward)) /
          (2 * kPi);
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
    const auto joint = [&](std::size_t k) {
      return k < patch.rings.size() ? std::uint32_t(firstSeam + k) : firstSeam;
    };
    const auto& w = patch.weights[i];
    const vec3 p = patch.positions[i];
    vertices.push_back({p.x, p.y, p.z, packOctahedral(normals[i]), joint(0) | joint(1) << 16,
                        joint(2) | joint(3) << 16, vec4(w[0], w[1], w[2], w[3]) / 255.0f});
  }
}

void add(const Network& network, const ForkPatch& patch, const ForkRings& rings, PatchTable& table) {
  table.vertices.resize((table.vertices.size() + shared::kBlockVertices - 1) >> shared::kBlockShift
                                                                                    << shared::kBlockShift);
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
                           .firstSeam = added.firstSeam,
                           .centre = ring.centre,
                           .radius = ring.radius,
                           .outward = ring.outward,
                           .loop = loop,
                           .across = across,
                           .loopCount = ring.vertices,
                           .beside = beside,
                           .vertex = 0,
                           .start = patch.positions[loop - added.firstVertex] - ring.centre,
                           .index = 0,
                           .vessel = rings.vessel[i],
                           .unused0 = 0,
                           .unused1 = 0,
                           .unused2 = 0};
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

PatchTable takePatches(const Network& network, ForkPlan& plan) {
  PatchTable table;
  std::vector<bool> taken(plan.forks.size());
  for (const ForkPatch& patch : network.patches()) {
    if (table.seams.size() + patch.rings.size() > kMostSeams) break;
    std::size_t nearest = plan.forks.size();
    Meeting best;
    for (std::size_t i = 0; i < plan.forks.size(); ++i) {
      if (taken[i] || plan.forks[i].vesselA != patch.rings[0].vessel.value) continue;
      const std::optional<Meeting> met = meeting(network, patch, ringsOf(plan, plan.forks[i]));
      if (met && (nearest == plan.forks.size() || met->apart < best.apart)) nearest = i, best = *met;
    }
    if (nearest == plan.forks.size()) continue;
    if (!moveRings(network, plan, nearest, std::span(best.parameters).first(patch.rings.size()))) continue;
    taken[nearest] = true;
    add(network, patch, ringsOf(plan, plan.forks[nearest]), table);
  }
  std::uint32_t vertex = std::uint32_t(table.vertices.size() + shared::kBlockVertices - 1) >>
                         shared::kBlockShift << shared::kBlockShift;
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
  addFans(table);
  return table;
}

}  // namespace vasa
