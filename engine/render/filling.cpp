#include "render/filling.h"

#include <algorithm>

#include "gpu/barrier.h"
#include "spirv/template_plan_comp.h"

namespace vasa {
namespace {

constexpr VkDeviceSize kBlockBytes = sizeof(shared::TubeVertex) * shared::kBlockVertices;

std::uint32_t tubeGroups(const TubeSet& tubes, const FillRange& range) {
  return gpu::groupsFor(range.tubeEnd - range.firstTube, tubes.groupSweeps());
}

std::uint32_t forkGroups(const ForkSet& forks, const FillRange& range) {
  return gpu::groupsFor(range.forkEnd - range.firstFork, forks.groupForks());
}

}  // namespace

Template::Template(gpu::Device& device, const shared::FillRoom& room)
    : pool(device, {.name = "template",
                    .bytes = kBlockBytes * room.blocks,
                    .moreUsage = VK_BUFFER_USAGE_VERTEX_BUFFER_BIT}),
      colours(device, {"colours of blocks", VkDeviceSize(4) * room.blocks}),
      draws(device, {"template's draws", sizeof(shared::DrawCommand) * (room.tubeWindow + room.forkWindow)}) {
}

FillRange everything(const TubeSet& tubes) {
  return {0, std::uint32_t(tubes.table().sweeps.size()), 0, std::uint32_t(tubes.table().forks.size())};
}

// With the reserve beside it, so that nobody ever waits for the first group.
shared::FillRoom roomForAll(const TubeSet& tubes, const ForkSet& forks, const FillRange& range) {
  const std::uint32_t sweeps = tubeGroups(tubes, range), joined = forkGroups(forks, range);
  const std::uint32_t reserve = std::max(tubes.groupBlocks(), forks.groupBlocks());
  return {sweeps * tubes.groupBlocks() + joined * forks.groupBlocks() + reserve, reserve, sweeps, joined};
}

shared::FillRoom fillRoom(const TubeSet& tubes, const ForkSet& forks, const FillRange& range,
                          VkDeviceSize bytes) {
  shared::FillRoom room = roomForAll(tubes, forks, range);
  room.tubeWindow = std::min(room.tubeWindow, shared::kWindow);
  room.forkWindow = std::min(room.forkWindow, shared::kWindow);
  const VkDeviceSize draws = sizeof(shared::DrawCommand) * (room.tubeWindow + room.forkWindow);
  const VkDeviceSize blocks = (std::max(bytes, draws) - draws) / (kBlockBytes + 4);
  room.blocks = std::min(room.blocks, std::max(std::uint32_t(blocks), room.reserve));
  return room;
}

Filling::Filling(gpu::Device& device, const TubeSet& tubes, const ForkSet& forks,
                 const shared::FillRoom& room)
    : room_(room),
      groupSweeps_(tubes.groupSweeps()),
      groupForks_(forks.groupForks()),
      state_(device, {"filling", sizeof(shared::Filling)}),
      host_(device, {"filling, host", sizeof(shared::Filling), gpu::MemoryRole::readBack}) {}

// As template_plan.comp begins any other round.
void Filling::recordStart(VkCommandBuffer commands, const FillRange& range) const {
  const auto groups = [](std::uint32_t count, std::uint32_t size, std::uint32_t window) {
    return std::min(gpu::groupsFor(count, size), window);
  };
  const shared::Filling start{
      .undoneTube = std::min(range.tubeEnd, range.firstTube + room_.tubeWindow * groupSweeps_),
      .undoneFork = std::min(range.forkEnd, range.firstFork + room_.forkWindow * groupForks_),
      .taken = 0,
      .spare = int(room_.blocks - room_.reserve),
      .firstTube = range.firstTube,
      .firstFork = range.firstFork,
      .tubeEnd = range.tubeEnd,
      .forkEnd = range.forkEnd,
      .indices = 0,
      .blocks = 0,
      .rounds = 0,
      .tubeGroups = groups(range.tubeEnd - range.firstTube, groupSweeps_, room_.tubeWindow),
      .tubeY = 1,
      .tubeZ = 1,
      .forkGroups = groups(range.forkEnd - range.firstFork, groupForks_, room_.forkWindow),
      .forkY = 1,
      .forkZ = 1,
  };
  vkCmdUpdateBuffer(commands, state_.handle(), 0, sizeof start, &start);
  gpu::stageBarrier(commands, VK_PIPELINE_STAGE_2_TRANSFER_BIT,
                    VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_2_DRAW_INDIRECT_BIT);
}

void Filling::recordCopy(VkCommandBuffer commands) const {
  const VkBufferCopy all{0, 0, sizeof(shared::Filling)};
  vkCmdCopyBuffer(commands, state_.handle(), host_.handle(), 1, &all);
}

shared::Filling Filling::read() const {
  shared::Filling state;
  host_.read(std::span(&state, 1));
  return state;
}

PlanPass::PlanPass(gpu::Device& device)
    : pipeline_(device, {spirv::template_plan_comp, sizeof(shared::PlanPush)}) {}

void PlanPass::record(VkCommandBuffer commands, const Filling& filling, const Template& into) const {
  pipeline_.dispatch(commands,
                     shared::PlanPush{.filling = filling.state_.address(),
                                      .draws = into.draws.address(),
                                      .groupSweeps = filling.groupSweeps_,
                                      .groupForks = filling.groupForks_,
                                      .room = filling.room_},
                     1);
}

}  // namespace vasa
