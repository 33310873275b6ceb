#include "render/static_tubes.h"

#include <algorithm>

#include "gpu/barrier.h"

namespace vasa {
namespace {

// Within any storage range.
constexpr std::uint32_t kPartBlocks = (64u << 20) / (sizeof(shared::TubeVertex) * shared::kBlockVertices);

std::uint32_t itemsOfPart(std::uint32_t groupItems, std::uint32_t groupBlocks) {
  return groupItems * std::max(1u, kPartBlocks / std::max(groupBlocks, 1u));
}

}  // namespace

StaticTubes::StaticTubes(gpu::Device& device, const TubeSet& tubes, const ForkSet& forks)
    : tubes_(tubes), forks_(forks) {
  const FillRange all = everything(tubes);
  const std::uint32_t sweeps = itemsOfPart(tubes.groupSweeps(), tubes.groupBlocks());
  for (std::uint32_t first = 0; first < all.tubeEnd; first += sweeps)
    add(device, {first, std::min(first + sweeps, all.tubeEnd), 0, 0});
  const std::uint32_t joined = itemsOfPart(forks.groupForks(), forks.groupBlocks());
  for (std::uint32_t first = 0; first < all.forkEnd; first += joined)
    add(device, {0, 0, first, std::min(first + joined, all.forkEnd)});
}

void StaticTubes::add(gpu::Device& device, const FillRange& range) {
  const shared::FillRoom room = roomForAll(tubes_, forks_, range);
  parts_.push_back({range, Filling(device, tubes_, forks_, room), Template(device, room)});
}

void StaticTubes::recordVertices(VkCommandBuffer commands, const TubePass& pass, const ForkPass& forkPass,
                                 const PlanPass& plan, const DetailPass& detail, VkDeviceAddress points,
                                 VkDeviceAddress knots) const {
  for (const Part& part : parts_) {
    part.filling.recordStart(commands, part.range);
    const TubePass::Input input{tubes_, detail, points, knots, part.filling, part.made, false};
    if (part.range.tubeEnd > 0)
      pass.record(commands, input);
    else
      forkPass.record(commands, input, forks_);
    gpu::stageBarrier(commands, gpu::kCompute, gpu::kCompute);
    plan.record(commands, part.filling, part.made);
  }
  gpu::stageBarrier(commands, gpu::kCompute, VK_PIPELINE_STAGE_2_ALL_GRAPHICS_BIT);
}

void StaticTubes::recordDraw(VkCommandBuffer commands, const SurfacePass& pass,
                             const shared::DrawPush& push) const {
  for (const Part& part : parts_) pass.recordVessels(commands, push, drawsOf(part.made));
}

}  // namespace vasa
