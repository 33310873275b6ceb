#pragma once
#include <bit>

#include "gpu/gpu_rig.h"
#include "render/fork_pass.h"
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

/// A network in device memory, and what the passes make of all its tubes, caps and forks.
struct Forks {
  Forks(const GpuRig& used, const Network& network, std::vector<vec4> posed, std::vector<quat> knotFrames,
        const TubeDetail& detail)
      : rig(used),
        points(std::move(posed)),
        frames(std::move(knotFrames)),
        tubes(rig.device(), network, detail, 1u << 20),
        forks(rig.device(), tubes.table(), detail, 1u << 20),
        detailPass(rig.device(), tubes),
        tubePass(rig.device()),
        forkPass(rig.device()) {
    const gpu::Buffer pointBuffer = rig.upload(points), knotBuffer = rig.upload(frames);
    Camera camera;
    camera.position = {0, 0.5f, 9};  // everything is in view, so that nothing is left out
    camera.target = {0, 0.5f, 0};
    view = detailView(camera, {}, {640, 480}, 1, detail, detailSnap(rig.device(), {640, 480}));
    forks.setSpanColours(rig.device(), kindColours(network));
    const TubeDraws tubeDraws(rig.device(), tubes.room(), tubes.groupCount());
    const TubeDraws forkDraws(rig.device(), forks.room(), forks.groupCount());
    rig.run([&](VkCommandBuffer commands) {
      detailPass.record(commands, tubes, pointBuffer.address(), view);
      tubePass.record(commands, {tubes, tubes.batches()[0], detailPass, pointBuffer.address(), knotBuffer.address(),
                                 tubeDraws, false});
      forkPass.record(commands, {tubes, forks, forks.batches()[0], detailPass, pointBuffer.address(),
                                 knotBuffer.address(), forkDraws, false});
    });
    tubesDrawn = download(tubeDraws);
    forksDrawn = download(forkDraws);
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
    for (std::uint32_t i = 0; i < along.size(); ++i)
      counts.push_back((along[i] + 1 + shared::kCapRings * std::uint32_t(std::popcount(tubes.table().sweeps[i].caps))) *
                       around[tubes.table().vesselOfSweep[i]]);
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
  DetailPass detailPass;
  TubePass tubePass;
  ForkPass forkPass;
  shared::DetailView view{};
  Drawn tubesDrawn, forksDrawn;
  std::vector<std::uint32_t> around, along;
};

}  // namespace vasa::test
