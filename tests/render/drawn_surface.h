#pragma once
#include <bit>

#include "gpu/gpu_rig.h"
#include "render/fork_pass.h"
#include "render/patch_pass.h"
#include "support/manifold.h"
#include "surface/detail.h"
#include "surface/fork.h"

namespace vasa::test {

struct Drawn {
  std::vector<shared::TubeVertex> vertices;
  std::vector<std::uint32_t> indices;
  std::vector<shared::DrawCommand> draws;
};

/// Where each item's vertices begin in what a batch wrote.
/// @param vertices  of each item, 0 where it is not drawn
inline std::vector<std::uint32_t> firstVertices(std::span<const std::uint32_t> vertices, std::uint32_t perGroup,
                                                const GroupRoom& room) {
  std::vector<std::uint32_t> first;
  std::uint32_t next = 0;
  for (std::uint32_t i = 0; i < vertices.size(); ++i) {
    if (i % perGroup == 0) next = i / perGroup * room.vertices;
    first.push_back(next);
    next += inBlocks(vertices[i]);
  }
  return first;
}

/// A network in device memory, and what the passes make of all its tubes, caps, forks and patches.
struct Forks {
  Forks(const GpuRig& used, const Network& network, std::vector<vec4> posed, std::vector<quat> knotFrames,
        const TubeDetail& detail)
      : rig(used),
        points(std::move(posed)),
        frames(std::move(knotFrames)),
        tubes(rig.device(), network, detail, 1u << 20),
        forks(rig.device(), tubes.table(), detail, 1u << 20),
        patches(rig.device(), tubes.table().patches),
        detailPass(rig.device(), tubes),
        tubePass(rig.device(), 1),
        forkPass(rig.device(), 1),
        patchPass(rig.device(), 1) {
    const gpu::Buffer pointBuffer = rig.upload(points), knotBuffer = rig.upload(frames);
    Camera camera;
    camera.position = {0, 0.5f, 9};  // everything is in view, so that nothing is left out
    camera.target = {0, 0.5f, 0};
    view = detailView(camera, {}, {640, 480}, detail, detailSnap(rig.device(), {640, 480}));
    forks.setSpanColours(rig.device(), kindColours(network));
    const TubeDraws tubeDraws(rig.device(), tubes.room(), tubes.groupCount());
    const TubeDraws forkDraws(rig.device(), forks.room(), forks.groupCount());
    rig.run([&](VkCommandBuffer commands) {
      detailPass.record(commands, tubes, pointBuffer.address(), view);
      if (!patches.empty())
        patchPass.record(commands, {tubes, patches, detailPass, pointBuffer.address(), knotBuffer.address(), false});
      tubePass.record(commands, {tubes, tubes.batches()[0], detailPass, pointBuffer.address(), knotBuffer.address(),
                                 tubeDraws, false});
      if (!forks.batches().empty())
        forkPass.record(commands, {tubes, forks, forks.batches()[0], detailPass, pointBuffer.address(),
                                   knotBuffer.address(), forkDraws, false});
    });
    tubesDrawn = download(tubeDraws);
    if (!forks.batches().empty()) forksDrawn = download(forkDraws);
    if (!patches.empty()) patchesDrawn = download(patches.draws());
    around = rig.download<std::uint32_t>(detailPass.aroundBuffer());
    along = rig.download<std::uint32_t>(detailPass.alongBuffer());
  }

  Drawn download(const TubeDraws& draws) const {
    return {rig.download<shared::TubeVertex>(draws.vertices), rig.download<std::uint32_t>(draws.indices),
            rig.download<shared::DrawCommand>(draws.draws)};
  }
  PosedNetwork posed() const { return {tubes.table(), points, frames}; }
  ForkShape shapeOf(const shared::ForkRecord& fork) const {
    return forkShape(tubes.table(), fork, [this](std::uint32_t vessel) { return around[vessel]; });
  }

  std::vector<std::uint32_t> firstTubeVertices() const {
    std::vector<std::uint32_t> counts;
    for (std::uint32_t i = 0; i < along.size(); ++i) {
      const std::uint32_t m = around[tubes.table().vesselOfSweep[i]], caps = std::uint32_t(std::popcount(tubes.table().sweeps[i].caps));
      counts.push_back((along[i] + 1 + capRings(m, view) * caps) * m);
    }
    return firstVertices(counts, shared::kGroupSweeps, tubes.room());
  }
  std::vector<std::uint32_t> firstForkVertices() const {
    std::vector<std::uint32_t> counts;
    for (const shared::ForkRecord& fork : tubes.table().forks) counts.push_back(shapeOf(fork).vertices());
    return firstVertices(counts, shared::kGroupForks, forks.room());
  }

  const GpuRig& rig;
  std::vector<vec4> points;
  std::vector<quat> frames;
  TubeSet tubes;
  ForkSet forks;
  PatchSet patches;
  DetailPass detailPass;
  TubePass tubePass;
  ForkPass forkPass;
  PatchPass patchPass;
  shared::DetailView view{};
  Drawn tubesDrawn, forksDrawn, patchesDrawn;
  std::vector<std::uint32_t> around, along;
};

inline void take(const Drawn& drawn, std::vector<vec3>& positions, std::vector<uvec3>& triangles) {
  const std::uint32_t base = std::uint32_t(positions.size());
  for (const shared::TubeVertex& v : drawn.vertices) positions.emplace_back(v.x, v.y, v.z);
  for (const shared::DrawCommand& draw : drawn.draws)
    for (std::uint32_t i = 0; i < draw.indexCount; i += 3) {
      const std::uint32_t* index = &drawn.indices[draw.firstIndex + i];
      triangles.push_back(uvec3(index[0], index[1], index[2]) + base);
    }
}

/// Edges that do not belong to exactly two triangles. A cap's pole is a ring of vertices in one place: triangles without
/// area there are left out.
inline std::size_t openEdgesDrawn(const Forks& passes) {
  std::vector<vec3> positions;
  std::vector<uvec3> triangles;
  take(passes.tubesDrawn, positions, triangles);
  take(passes.forksDrawn, positions, triangles);
  take(passes.patchesDrawn, positions, triangles);
  std::vector<uvec3> welded = weldedByBits(positions, triangles);
  std::erase_if(welded, [](const uvec3& t) { return t.x == t.y || t.y == t.z || t.z == t.x; });
  return openEdges(welded);
}

}  // namespace vasa::test
