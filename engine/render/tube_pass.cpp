#include "render/tube_pass.h"

#include "spirv/tubes_comp.h"

namespace vasa {

TubeDraws::TubeDraws(gpu::Device& device, const GroupRoom& room, std::uint32_t groups) {
  const VkDeviceSize count = VkDeviceSize(room.vertices) * groups;
  vertices = gpu::Buffer(device, {.name = "tube vertices", .bytes = count * sizeof(shared::TubeVertex), .moreUsage = VK_BUFFER_USAGE_VERTEX_BUFFER_BIT});
  colours = gpu::Buffer(device, {"colours of blocks", 4 * (count >> shared::kBlockShift)});
  indices = gpu::Buffer(device, {"tube indices", VkDeviceSize(4) * room.indices * groups});
  draws = gpu::Buffer(device, {"tube draws", sizeof(shared::DrawCommand) * groups});
}

VkDeviceSize TubeDraws::bytes() const {
  return vertices.bytes() + colours.bytes() + indices.bytes() + draws.bytes();
}

TubePass::TubePass(gpu::Device& device, std::uint32_t samples)
    : pipeline_(device, {spirv::tubes_comp, sizeof(shared::TubesPush), gpu::Specialization().set(0, samples)}) {}

void TubePass::record(VkCommandBuffer commands, const Input& input) const {
  const TubeSet& tubes = input.tubes;
  const TubeDraws& draws = input.draws;
  pipeline_.dispatch(commands,
                     shared::TubesPush{.points = input.points,
                                       .knots = input.knots,
                                       .sweeps = tubes.sweeps(),
                                       .tables = tubes.tables(),
                                       .view = input.detail.view(),
                                       .along = input.detail.along(),
                                       .around = input.detail.around(),
                                       .colours = tubes.colours(),
                                       .vertices = draws.vertices.address(),
                                       .blockColours = draws.colours.address(),
                                       .indices = draws.indices.address(),
                                       .draws = draws.draws.address(),
                                       .firstSweep = input.batch.firstSweep,
                                       .sweepCount = input.batch.sweeps,
                                       .verticesPerGroup = tubes.room().vertices,
                                       .indicesPerGroup = tubes.room().indices,
                                       .keepAll = input.cull ? 0u : 1u,
                                       .unused = 0},
                     input.batch.groups());
}

}  // namespace vasa
