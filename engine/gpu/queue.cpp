#include "gpu/queue.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <chrono>
#include <thread>

#include "gpu/barrier.h"
#include "gpu/make.h"

namespace vasa::gpu {
namespace {

// Drivers call a GPU lost after 2 to 10 s; the largest pictures take a busy machine minutes in software.
constexpr std::chrono::nanoseconds kLongestWait = std::chrono::minutes(10);
// After a wait has failed: what was submitted is mostly over then.
constexpr std::chrono::seconds kLongestDrain{10};
constexpr std::size_t kMostSignals = 4;  // of a submit: a window has one, and the timeline

}  // namespace

struct Commands::Slot {
  Unique<VkCommandPool> pool;
  VkCommandBuffer buffer = VK_NULL_HANDLE;
  Ticket ticket;
  bool recording = false;
};

// The buffer stays in the recording state; begin() resets its pool.
Commands::~Commands() {
  if (slot_) slot_->recording = false;
}

Commands::operator VkCommandBuffer() const { return slot_->buffer; }

// GPU-assisted validation (layer 1.3.239) waits for the queue inside vkQueueSubmit2, before the layer itself
// has noted the timeline's new value: waiting for that value then takes 10 s, ends in a message and may hang.
// With it on, a submit signals nothing and waits for the queue.
Queue::Queue(Device& device, VkQueue queue)
    : device_(device), immediate_(device.gpuAssisted()), queue_(queue) {
  VkSemaphoreTypeCreateInfo type{};
  type.sType = VK_STRUCTURE_TYPE_SEMAPHORE_TYPE_CREATE_INFO;
  type.semaphoreType = VK_SEMAPHORE_TYPE_TIMELINE;
  VkSemaphoreCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO;
  info.pNext = &type;
  timeline_ = make(device, vkCreateSemaphore, "vkCreateSemaphore", info, "timeline");
}

// Not vkQueueWaitIdle(): with synchronization validation (layer 1.3.239) that can go round for ever inside
// the layer.
Queue::~Queue() { settle(); }

Commands::Slot* Queue::freeSlot() {
  for (auto& slot : slots_)
    if (!slot->recording && done(slot->ticket)) return slot.get();
  auto slot = std::make_unique<Commands::Slot>();
  VkCommandPoolCreateInfo poolInfo{};
  poolInfo.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO;
  poolInfo.flags = VK_COMMAND_POOL_CREATE_TRANSIENT_BIT;
  poolInfo.queueFamilyIndex = device_.adapter().queueFamily;
  slot->pool = make(device_, vkCreateCommandPool, "vkCreateCommandPool", poolInfo, "commands");
  VkCommandBufferAllocateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO;
  info.commandPool = slot->pool.get();
  info.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
  info.commandBufferCount = 1;
  check(vkAllocateCommandBuffers(device_.handle(), &info, &slot->buffer), "vkAllocateCommandBuffers");
  slots_.push_back(std::move(slot));
  return slots_.back().get();
}

Commands Queue::begin(const char* name) {
  Commands::Slot* slot = freeSlot();
  check(vkResetCommandPool(device_.handle(), slot->pool.get(), 0), "vkResetCommandPool");
  device_.setName(slot->pool.get(), name);
  device_.setName(slot->buffer, name);
  VkCommandBufferBeginInfo info{};
  info.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO;
  info.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
  check(vkBeginCommandBuffer(slot->buffer, &info), "vkBeginCommandBuffer");
  slot->recording = true;
  stageBarrier(slot->buffer, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT);
  return Commands(slot);
}

Ticket Queue::submit(Commands commands, std::span<const VkSemaphoreSubmitInfo> waits,
                     std::span<const VkSemaphoreSubmitInfo> signals) {
  makeVisibleToHost(commands);
  check(vkEndCommandBuffer(commands), "vkEndCommandBuffer");

  VkSemaphoreSubmitInfo tick{};
  tick.sType = VK_STRUCTURE_TYPE_SEMAPHORE_SUBMIT_INFO;
  tick.semaphore = timeline_.get();
  tick.value = submitted_ + 1;
  tick.stageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
  std::array<VkSemaphoreSubmitInfo, kMostSignals> allSignals;
  assert(signals.size() < allSignals.size());
  const auto own = std::ranges::copy(signals, allSignals.begin()).out;
  if (!immediate_) *own = tick;
  VkCommandBufferSubmitInfo buffer{};
  buffer.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_SUBMIT_INFO;
  buffer.commandBuffer = commands;
  VkSubmitInfo2 info{};
  info.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO_2;
  info.waitSemaphoreInfoCount = std::uint32_t(waits.size());
  info.pWaitSemaphoreInfos = waits.data();
  info.commandBufferInfoCount = 1;
  info.pCommandBufferInfos = &buffer;
  info.signalSemaphoreInfoCount = std::uint32_t(signals.size()) + (immediate_ ? 0 : 1);
  info.pSignalSemaphoreInfos = allSignals.data();
  check(vkQueueSubmit2(queue_, 1, &info, VK_NULL_HANDLE), "vkQueueSubmit2");
  if (immediate_) check(vkQueueWaitIdle(queue_), "vkQueueWaitIdle");
  commands.slot_->ticket = {++submitted_};
  return commands.slot_->ticket;
}

std::uint64_t Queue::reached() const {
  if (immediate_) return submitted_;
  std::uint64_t value = 0;
  check(vkGetSemaphoreCounterValue(device_.handle(), timeline_.get(), &value), "vkGetSemaphoreCounterValue");
  return value;
}

bool Queue::done(Ticket ticket) const { return ticket.value == 0 || reached() >= ticket.value; }

VkResult Queue::waitFor(std::uint64_t value) const {
  const VkSemaphore semaphore = timeline_.get();
  VkSemaphoreWaitInfo info{};
  info.sType = VK_STRUCTURE_TYPE_SEMAPHORE_WAIT_INFO;
  info.semaphoreCount = 1;
  info.pSemaphores = &semaphore;
  info.pValues = &value;
  return vkWaitSemaphores(device_.handle(), &info, std::uint64_t(kLongestWait.count()));
}

void Queue::wait(Ticket ticket) {
  if (immediate_ || ticket.value <= finished_) return;
  const VkResult result = waitFor(ticket.value);
  if (result == VK_SUCCESS) {
    finished_ = ticket.value;
    return;
  }
  const bool over = drain();
  check(result, "vkWaitSemaphores");
  if (!over)
    throw Error(
        {Fault::deviceLost,
         "the Vulkan device does not finish its work; use a smaller picture, or choose another --device"});
}

void Queue::settle() noexcept {
  if (immediate_ || finished_ >= submitted_) return;
  if (waitFor(submitted_) == VK_SUCCESS)
    finished_ = submitted_;
  else
    drain();
}

// Until the device does nothing, by the ways that are left. A lost device does nothing (Vulkan specification,
// "Lost Device"). Past the limit nobody waits again.
bool Queue::drain() noexcept {
  const auto end = std::chrono::steady_clock::now() + kLongestDrain;
  bool over = false;
  while (!over && std::chrono::steady_clock::now() < end) {
    std::uint64_t value = 0;
    if (vkGetSemaphoreCounterValue(device_.handle(), timeline_.get(), &value) == VK_SUCCESS) {
      over = value >= submitted_;
    } else {
      const VkResult idle = vkQueueWaitIdle(queue_);
      over = idle == VK_SUCCESS || idle == VK_ERROR_DEVICE_LOST;
    }
    if (!over) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  finished_ = submitted_;
  return over;
}

}  // namespace vasa::gpu
