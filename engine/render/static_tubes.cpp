#include "render/static_tubes.h"

#include <algorithm>

#include "gpu/barrier.h"
#include "shared/sweep.h"

namespace vasa {
namespace {

constexpr VkDeviceSize kMostBytes = 64u << 20;  // half of what lavapipe's storage range grants

}  // namespace

StaticTubes::StaticTubes(gpu::Device& device, const TubeSet& tubes) : tubes_(tubes) {
  std::vector<VkDeviceSize> sizes;
  for (const TubeBatch& batch : tubes.batches()) {
    const VkDeviceSize bytes = VkDeviceSize(batch.count) * tubes.verticesPerItem(batch) * sizeof(shared::TubeVertex);
    if (sizes.empty() || sizes.back() + bytes > std::max(kMostBytes, bytes)) sizes.push_back(0);
    places_.push_back({sizes.size() - 1, sizes.back()});
    sizes.back() += bytes;
  }
  for (const VkDeviceSize bytes : sizes)
    buffers_.emplace_back(device, gpu::BufferSpec{.name = "static tubes",
                                                  .bytes = bytes,
                                                  .moreUsage = VK_BUFFER_USAGE_VERTEX_BUFFER_BIT});
}

void StaticTubes::recordVertices(VkCommandBuffer commands, const TessellatePass& pass, VkDeviceAddress points,
                                 VkDeviceAddress knots) const {
  for (std::size_t i = 0; i < places_.size(); ++i)
    pass.record(commands, {tubes_, tubes_.batches()[i], points, knots,
                           buffers_[places_[i].buffer].address() + places_[i].offset});
  gpu::stageBarrier(commands, VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, VK_PIPELINE_STAGE_2_VERTEX_INPUT_BIT);
}

void StaticTubes::recordDraw(VkCommandBuffer commands, const SurfacePass& pass, const shared::DrawPush& push) const {
  for (std::size_t i = 0; i < places_.size(); ++i)
    pass.recordTubes(commands, push, tubes_, tubes_.batches()[i], buffers_[places_[i].buffer], places_[i].offset);
}

}  // namespace vasa
