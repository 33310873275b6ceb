#include "render/fork_pass.h"

#include "spirv/forks_comp.h"

namespace vasa {

ForkPass::ForkPass(gpu::Device& device, const ForkSet& forks)
    : pipeline_(device, {spirv::forks_comp, sizeof(shared::ForksPush),
                         gpu::Specialization().set(1, forks.groupForks())}) {}

void ForkPass::record(VkCommandBuffer commands, const Input& input) const {
  const ForkSet& forks = input.forks;
  const shared::FillRoom& room = input.filling.room();
  pipeline_.dispatchIndirect(commands,
                             shared::ForksPush{.points = input.points,
                                               .knots = input.knots,
                                               .forks = forks.forks(),
                                               .branches = forks.branches(),
                                               .tables = input.tubes.tables(),
                                               .view = input.detail.view(),
                                               .colours = forks.colours(),
                                               .around = input.detail.around(),
                                               .vertices = input.into.pool.address(),
                                               .indices = input.into.pool.address(),
                                               .blockColours = input.into.colours.address(),
                                               .draws = input.into.draws.address(),
                                               .filling = input.filling.state().address(),
                                               .reserve = room.reserve,
                                               .firstDraw = room.tubeWindow,
                                               .keepAll = input.cull ? 0u : 1u,
                                               .unused = 0},
                             input.filling.state(), offsetof(shared::Filling, forkGroups));
}

}  // namespace vasa
