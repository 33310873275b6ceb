#pragma once
#include <bit>

#include "gpu/barrier.h"
#include "gpu/gpu_rig.h"
#include "reference/detail.h"
#include "render/fork_pass.h"
#include "render/patch_pass.h"
#include "support/manifold.h"
#include "surface/fork.h"

namespace vasa::test {

struct Drawn {
  std::vector<shared::TubeVertex> vertices;
  std::vector<std::uint32_t> indices;
  std::vector<shared::DrawCommand> draws;
};

/// Where each item's vertices begin in what a round wrote.
/// @param vertices  of each item, 0 where it is not drawn
inline std::vector<std::uint32_t> firstVertices(std::span<const std::uint32_t> vertices,
                                                std::uint32_t perGroup,
                                                std::span<const shared::DrawCommand> draws) {
  std::vector<std::uint32_t> first;
  std::uint32_t next = 0;
  for (std::uint32_t i = 0; i < vertices.size(); ++i) {
    if (i % perGroup == 0) next = std::uint32_t(draws[i / perGroup].vertexOffset);
    first.push_back(next);
    next += inBlocks(vertices[i]);
  }
  return first;
}

/// The corners of a triangle of a draw.
inline uvec3 cornersAt(const Drawn& drawn, const shared::DrawCommand& draw, std::uint32_t index) {
  const std::uint32_t* corner = &drawn.indices[draw.firstIndex + index];
  return uvec3(corner[0], corner[1], corner[2]) + std::uint32_t(draw.vertexOffset);
}

/// A network in device memory, and what the passes make of all its tubes, caps, forks and patches.
/// @param cull  only of triangles that a large picture of four samples a pixel may show
struct Forks {
  Forks(const GpuRig& used, const Network& network, std::vector<vec4> posed, std::vector<quat> knotFrames,
        const TubeDetail& detail, bool cull = false)
      : rig(used),
        points(std::move(posed)),
        frames(std::move(knotFrames)),
        tubes(rig.device(), network, detail, 1u << 20),
        forks(rig.device(), tubes.table(), detail, 1u << 20),
        patches(rig.device(), tubes.table().patches),
        detailPass(rig.device(), tubes),
        tubePass(rig.device(), 1, tubes),
        forkPass(rig.device(), forks.groupForks()),
        planPass(rig.device()),
        patchPass(rig.device()) {
    const gpu::Buffer pointBuffer = rig.upload(points), knotBuffer = rig.upload(frames);
    Camera camera;
    camera.position = {0, 0.5f, 9};  // everything is in view, so that nothing is left out
    camera.target = {0, 0.5f, 0};
    const VkExtent2D size{cull ? 6400u : 640u, cull ? 4800u : 480u};
    view = detailView(camera, {}, pictureGrid(rig.device(), size, cull ? 4 : 1), detail);
    forks.setSpanColours(rig.device(), kindColours(network));
    const FillRange all = everything(tubes);
    const Filling filling(rig.device(), tubes, forks, roomForAll(tubes, forks, all));
    const Template filled(rig.device(), filling.room());
    rig.run([&](VkCommandBuffer commands) {
      detailPass.record(commands, tubes, pointBuffer.address(), view);
      if (!patches.empty())
        patchPass.record(commands,
                         {tubes, patches, detailPass, pointBuffer.address(), knotBuffer.address(), false});
      filling.recordStart(commands, all);
      const TubePass::Input input{tubes,  detailPass, pointBuffer.address(), knotBuffer.address(), filling,
                                  filled, cull};
      tubePass.record(commands, input);
      gpu::stageBarrier(commands, VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT,
                        VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT);
      if (all.forkEnd > 0) forkPass.record(commands, input, forks);
      gpu::stageBarrier(commands, VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT,
                        VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT);
      planPass.record(commands, filling, filled);
    });
    tubesDrawn =
        forksDrawn = {rig.download<shared::TubeVertex>(filled.pool), rig.download<std::uint32_t>(filled.pool),
                      rig.download<shared::DrawCommand>(filled.draws)};
    tubesDrawn.draws.resize(filling.room().tubeWindow);
    forksDrawn.draws.erase(forksDrawn.draws.begin(), forksDrawn.draws.begin() + filling.room().tubeWindow);
    if (!patches.empty()) patchesDrawn = download(patches.draws());
    around = rig.download<std::uint32_t>(detailPass.aroundBuffer());
    along = rig.download<std::uint32_t>(detailPass.alongBuffer());
  }

  Drawn download(const PatchDraws& draws) const {
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
      const std::uint32_t m = around[tubes.table().vesselOfSweep[i]],
                          caps = std::uint32_t(std::popcount(tubes.table().sweeps[i].caps));
      counts.push_back((along[i] + 1 + capRings(m, view) * caps) * m);
    }
    return firstVertices(counts, tubes.groupSweeps(), tubesDrawn.draws);
  }
  std::vector<std::uint32_t> firstForkVertices() const {
    std::vector<std::uint32_t> counts;
    for (const shared::ForkRecord& fork : tubes.table().forks) counts.push_back(shapeOf(fork).vertices());
    return firstVertices(counts, forks.groupForks(), forksDrawn.draws);
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
  PlanPass planPass;
  PatchPass patchPass;
  shared::DetailView view{};
  Drawn tubesDrawn, forksDrawn, patchesDrawn;
  std::vector<std::uint32_t> around, along;
};

inline void take(const Drawn& drawn, std::vector<vec3>& positions, std::vector<uvec3>& triangles) {
  const std::uint32_t base = std::uint32_t(positions.size());
  for (const shared::TubeVertex& v : drawn.vertices) positions.emplace_back(v.x, v.y, v.z);
  for (const shared::DrawCommand& draw : drawn.draws)
    for (std::uint32_t i = 0; i < draw.indexCount; i += 3)
      triangles.push_back(cornersAt(drawn, draw, i) + base);
}

/// Edges that do not belong to exactly two triangles. A cap's pole is a ring of vertices in one place:
/// triangles without area there are left out.
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
