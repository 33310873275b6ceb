#include "render/tube_pass.h"

#include "spirv/tubes_comp.h"

namespace vasa {

TubePass::TubePass(gpu::Device& device, std::uint32_t samples, const TubeSet& tubes)
    : pipeline_(device, {spirv::tubes_comp, sizeof(shared::TubesPush),
                         gpu::Specialization().set(0, samples).set(1, tubes.groupSweeps())}) {}

void TubePass::record(VkCommandBuffer commands, const Input& input) const {
  const TubeSet& tubes = input.tubes;
  pipeline_.dispatchIndirect(commands,
                             shared::TubesPush{.points = input.points,
                                               .knots = input.knots,
                                               .sweeps = tubes.sweeps(),
                                               .tables = tubes.tables(),
                                               .view = input.detail.view(),
                                               .along = input.detail.along(),
                                               .around = input.detail.around(),
                                               .colours = tubes.colours(),
                                               .vertices = input.into.pool.address(),
                                               .indices = input.into.pool.address(),
                                               .blockColours = input.into.colours.address(),
                                               .draws = input.into.draws.address(),
                                               .filling = input.filling.state().address(),
                                               .reserve = input.filling.room().reserve,
                                               .keepAll = input.cull ? 0u : 1u},
                             input.filling.state(), offsetof(shared::Filling, tubeGroups));
}

}  // namespace vasa
