#include "render/static_tubes.h"

#include "gpu/barrier.h"

namespace vasa {
namespace {

constexpr VkPipelineStageFlags2 kCompute = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;

}  // namespace

StaticTubes::StaticTubes(gpu::Device& device, const TubeSet& tubes, const ForkSet& forks)
    : tubes_(tubes), forks_(forks) {
  for (const TubeBatch& batch : tubes.batches()) draws_.emplace_back(device, tubes.room(), batch.groups());
  for (const ForkBatch& batch : forks.batches()) forkDraws_.emplace_back(device, forks.room(), batch.groups());
}

void StaticTubes::recordVertices(VkCommandBuffer commands, const TubePass& pass, const ForkPass& forkPass,
                                 const DetailPass& detail, VkDeviceAddress points, VkDeviceAddress knots) const {
  for (std::size_t i = 0; i < draws_.size(); ++i) {
    pass.record(commands, {tubes_, tubes_.batches()[i], detail, points, knots, draws_[i], false});
  }
  for (std::size_t i = 0; i < forkDraws_.size(); ++i)
    forkPass.record(commands, {tubes_, forks_, forks_.batches()[i], detail, points, knots, forkDraws_[i], false});
  gpu::stageBarrier(commands, kCompute, VK_PIPELINE_STAGE_2_ALL_GRAPHICS_BIT);
}

void StaticTubes::recordDraw(VkCommandBuffer commands, const SurfacePass& pass, const shared::DrawPush& push) const {
  for (std::size_t i = 0; i < draws_.size(); ++i)
    pass.recordVessels(commands, push, draws_[i], tubes_.batches()[i].groups());
  for (std::size_t i = 0; i < forkDraws_.size(); ++i)
    pass.recordVessels(commands, push, forkDraws_[i], forks_.batches()[i].groups());
}

}  // namespace vasa
