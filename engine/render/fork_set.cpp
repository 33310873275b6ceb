#include "render/fork_set.h"

#include <algorithm>
#include <bit>

#include "gpu/transfer.h"
#include "surface/fork_template.h"

namespace vasa {

ForkSet::ForkSet(gpu::Device& device, const SweepTable& table, const TubeDetail& detail, std::uint32_t batchForks)
    : count_(std::uint32_t(table.forks.size())), spanOfFork_(table.spanOfFork) {
  constexpr std::uint32_t group = shared::kGroupForks;
  const std::uint32_t most = detail.mostAround();
  const std::uint32_t each = std::min((std::max(batchForks, 1u) - 1) / group, count_ / group) * group + group;
  for (std::uint32_t first = 0; first < count_; first += each) batches_.push_back({first, std::min(each, count_ - first)});
  std::uint32_t largest = 0;  // more columns in the window make fewer triangles
  for (const std::uint32_t window : {0u, 1u})
    largest = std::max(largest, forkTriangleCount({most, most, most}, window));
  room_ = {std::uint32_t(std::bit_width(ForkShape{most, most, most}.vertices() - 1)), 3 * largest * group};
  if (!detail.automatic())
    for (const shared::ForkRecord& fork : table.forks)
      triangles_ += forkTriangleCount({most, most, most}, forkWindow(fork, most));
  forks_ = gpu::makeBuffer(device, "forks", std::span<const shared::ForkRecord>(table.forks));
  colours_ = gpu::Buffer(device, {"fork colours", 4 * VkDeviceSize(count_)});
}

void ForkSet::setSpanColours(gpu::Device& device, std::span<const std::uint32_t> spanColours) {
  std::vector<std::uint32_t> colours;
  for (const std::uint32_t span : spanOfFork_) colours.push_back(spanColours[span]);
  if (!colours.empty()) gpu::uploadBytes(device, colours_, std::as_bytes(std::span(colours)));
}

}  // namespace vasa
