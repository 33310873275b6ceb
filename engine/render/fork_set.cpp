#include "render/fork_set.h"

#include <algorithm>

#include "gpu/transfer.h"
#include "surface/fork_template.h"

namespace vasa {

ForkSet::ForkSet(gpu::Device& device, const SweepTable& table, const TubeDetail& detail, std::uint32_t batchForks)
    : count_(std::uint32_t(table.forks.size())), spanOfFork_(table.spanOfFork) {
  constexpr std::uint32_t group = shared::kGroupForks;
  const std::uint32_t most = detail.mostAround();
  const std::uint32_t each = std::min((std::max(batchForks, 1u) - 1) / group, count_ / group) * group + group;
  for (std::uint32_t first = 0; first < count_; first += each) batches_.push_back({first, std::min(each, count_ - first)});
  constexpr std::uint32_t branches = shared::kMostBranches;
  ForkShape largest{most, most, branches, {}};
  largest.branch.fill(most);
  room_ = {inBlocks(largest.vertices()) * group, 3 * forkTriangleCount(largest, branches) * group};
  if (!detail.automatic())
    for (const shared::ForkRecord& fork : table.forks) {
      std::uint32_t columns = 0;
      for (std::uint32_t i = 0; i < fork.branchCount; ++i)
        columns += windowColumns(table.branches[fork.firstBranch + i], fork.branchCount, most);
      triangles_ += forkTriangleCount(forkShape(table, fork, [&](std::uint32_t) { return most; }), columns);
    }
  branches_ = gpu::makeBuffer(device, "fork branches", std::span<const shared::ForkBranch>(table.branches));
  forks_ = gpu::makeBuffer(device, "forks", std::span<const shared::ForkRecord>(table.forks));
  colours_ = gpu::Buffer(device, {"fork colours", 4 * VkDeviceSize(count_)});
}

void ForkSet::setSpanColours(gpu::Device& device, std::span<const std::uint32_t> spanColours) {
  std::vector<std::uint32_t> colours;
  for (const std::uint32_t span : spanOfFork_) colours.push_back(spanColours[span]);
  if (!colours.empty()) gpu::uploadBytes(device, colours_, std::as_bytes(std::span(colours)));
}

}  // namespace vasa
