#include "gpu/timer.h"

#include "gpu/barrier.h"
#include "gpu/make.h"

namespace vasa::gpu {
namespace {

// A time stamp between two full barriers. lavapipe takes a stamp only when it gets round to the tiles that
// were binned with it: without the barriers the stamps around several draws all fall together.
void stamp(VkCommandBuffer commands, VkQueryPool queries, std::uint32_t index) {
  stageBarrier(commands, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT);
  vkCmdWriteTimestamp2(commands, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, queries, index);
  stageBarrier(commands, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT);
}

}  // namespace

GpuTimer::GpuTimer(Device& device, std::uint32_t mostScopes) : device_(device), mostScopes_(mostScopes) {
  names_.reserve(mostScopes);
  if (device.timestampBits() == 0 || mostScopes == 0) return;
  VkQueryPoolCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO;
  info.queryType = VK_QUERY_TYPE_TIMESTAMP;
  info.queryCount = 2 * mostScopes;
  queries_ = make(device, vkCreateQueryPool, "vkCreateQueryPool", info, "timer");
}

void GpuTimer::begin(VkCommandBuffer commands) {
  names_.clear();
  if (queries_) vkCmdResetQueryPool(commands, queries_.get(), 0, 2 * mostScopes_);
}

GpuTimer::Scope::Scope(GpuTimer& timer, VkCommandBuffer commands, const char* name)
    : timer_(timer), commands_(commands), index_(std::uint32_t(timer.names_.size())) {
  timer_.device_.beginLabel(commands, name);
  // Stretches beyond the pool are labelled, but not timed.
  if (index_ >= timer_.mostScopes_) return;
  timer_.names_.push_back(name);
  if (timer_.queries_) stamp(commands, timer_.queries_.get(), 2 * index_);
}

GpuTimer::Scope::~Scope() {
  if (index_ < timer_.mostScopes_ && timer_.queries_) stamp(commands_, timer_.queries_.get(), 2 * index_ + 1);
  timer_.device_.endLabel(commands_);
}

std::span<const GpuTimer::Time> GpuTimer::results() {
  if (!queries_ || names_.empty()) return {};
  stamps_.resize(2 * names_.size());
  const VkResult result =
      check(vkGetQueryPoolResults(device_.handle(), queries_.get(), 0, std::uint32_t(stamps_.size()),
                                  stamps_.size() * sizeof(std::uint64_t), stamps_.data(),
                                  sizeof(std::uint64_t), VK_QUERY_RESULT_64_BIT),
            "vkGetQueryPoolResults");
  if (result == VK_NOT_READY) return {};
  // Counters narrower than 64 bits wrap; the difference does not mind.
  const std::uint32_t bits = device_.timestampBits();
  const std::uint64_t mask = bits >= 64 ? ~std::uint64_t(0) : (std::uint64_t(1) << bits) - 1;
  const double tickMs = double(device_.limits().timestampPeriod) * 1e-6;
  times_.clear();
  for (std::size_t i = 0; i < names_.size(); ++i)
    times_.push_back({names_[i], double((stamps_[2 * i + 1] - stamps_[2 * i]) & mask) * tickMs});
  return times_;
}

}  // namespace vasa::gpu
