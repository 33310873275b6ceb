#include "render/fork_pass.h"

#include "spirv/forks_comp.h"

namespace vasa {

ForkPass::ForkPass(gpu::Device& device, std::uint32_t samples)
    : pipeline_(device, {spirv::forks_comp, sizeof(shared::ForksPush), gpu::Specialization().set(0, samples)}) {}

void ForkPass::record(VkCommandBuffer commands, const Input& input) const {
  const ForkSet& forks = input.forks;
  const TubeDraws& draws = input.draws;
  pipeline_.dispatch(commands,
                     shared::ForksPush{.points = input.points,
                                       .knots = input.knots,
                                       .forks = forks.forks(),
                                       .branches = forks.branches(),
                                       .tables = input.tubes.tables(),
                                       .view = input.detail.view(),
                                       .colours = forks.colours(),
                                       .around = input.detail.around(),
                                       .vertices = draws.vertices.address(),
                                       .blockColours = draws.colours.address(),
                                       .indices = draws.indices.address(),
                                       .draws = draws.draws.address(),
                                       .firstFork = input.batch.firstFork,
                                       .forkCount = input.batch.forks,
                                       .verticesPerGroup = forks.room().vertices,
                                       .indicesPerGroup = forks.room().indices,
                                       .keepAll = input.cull ? 0u : 1u,
                                       .unused = 0},
                     input.batch.groups());
}

}  // namespace vasa
