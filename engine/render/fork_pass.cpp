#include "render/fork_pass.h"

#include <span>
#include <string>

#include "core/unawaited.h"
#include "gpu/device.h"
#include "gpu/error.h"
#include "gpu/transfer.h"
#include "spirv/forks_comp.h"

namespace vasa {
namespace {

gpu::ComputePipeline makePipeline(gpu::Device& device, std::uint32_t groupForks) {
  return {device, {spirv::forks_comp, sizeof(shared::ForksPush), gpu::Specialization().set(1, groupForks)}};
}

void runEmpty(std::uint32_t adapter, std::uint32_t groupForks) {
  gpu::Device device({.choice = std::to_string(adapter)});
  const gpu::ComputePipeline pipeline = makePipeline(device, groupForks);
  const shared::Filling none{};
  const gpu::Buffer nothing = gpu::makeBuffer(device, "no forks", std::span<const shared::Filling>(&none, 1));
  gpu::Commands commands = device.queue().begin("compile forks");
  pipeline.dispatch(commands, shared::ForksPush{.filling = nothing.address()}, 1);
  device.queue().wait(device.queue().submit(std::move(commands)));
}

}  // namespace

ForkPass::ForkPass(gpu::Device& device, std::uint32_t groupForks)
    : pipeline_(makePipeline(device, groupForks)) {}

std::future<void> ForkPass::compile(const gpu::Adapter& adapter, std::uint32_t groupForks) {
  return startUnawaited([driver = adapter.driverId, index = adapter.index, groupForks] {
    if (driver == VK_DRIVER_ID_MESA_LLVMPIPE) (void)gpu::attempt([&] { runEmpty(index, groupForks); });
  });
}

void ForkPass::record(VkCommandBuffer commands, const TubePass::Input& input, const ForkSet& forks) const {
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
