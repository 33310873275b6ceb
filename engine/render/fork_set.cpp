#include "render/fork_set.h"

#include "gpu/transfer.h"
#include "surface/fork_template.h"

namespace vasa {

ForkSet::ForkSet(gpu::Device& device, const SweepTable& table, const TubeDetail& detail,
                 std::uint32_t templateBytes)
    : count_(std::uint32_t(table.forks.size())), spanOfFork_(table.spanOfFork) {
  const std::uint32_t most = detail.mostAround();
  constexpr std::uint32_t branches = shared::kMostBranches;
  ForkShape largest{most, most, branches, {}};
  largest.branch.fill(most);
  constexpr VkDeviceSize blockBytes = sizeof(shared::TubeVertex) * shared::kBlockVertices;
  for (; count_ > 0; groupForks_ /= 2) {
    groupBlocks_ = blocksFor(inBlocks(largest.vertices()) * groupForks_,
                             3 * forkTriangleCount(largest, branches) * groupForks_);
    if (groupForks_ == shared::kLeastGroup || 2 * blockBytes * groupBlocks_ <= templateBytes) break;
  }
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
