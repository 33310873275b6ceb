#include "gpu/queue.h"

#include "gpu/barrier.h"
#include "gpu/device.h"
#include "gpu/error.h"

namespace vasa::gpu {

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

Commands::operator VkCommandBuffer() const {
  return slot_->buffer;
}

// GPU-assisted validation (layer 1.3.239) waits for the queue inside vkQueueSubmit2, before the layer itself
// has noted the timeline's new value: waiting for that value then takes 10 s, ends in a message and may hang.
// With it on, a submit signals nothing and waits for the queue.
Queue::Queue(Device& device, VkQueue queue) : device_(device), immediate_(device.gpuAssisted()), queue_(queue) {
  VkSemaphoreTypeCreateInfo type{};
  type.sType = VK_STRUCTURE_TYPE_SEMAPHORE_TYPE_CREATE_INFO;
  type.semaphoreType = VK_SEMAPHORE_TYPE_TIMELINE;
  VkSemaphoreCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO;
  info.pNext = &type;
  VkSemaphore semaphore = VK_NULL_HANDLE;
  check(vkCreateSemaphore(device.handle(), &info, nullptr, &semaphore), "vkCreateSemaphore");
  timeline_ = {device.handle(), semaphore};
  device.setName(semaphore, "timeline");
}

// Not vkQueueWaitIdle(): with synchronization validation (layer 1.3.239) that can go round for ever inside
// the layer.
Queue::~Queue() {
  try {
    wait(last());
  } catch (const Error&) {  // a lost device may be destroyed all the same
  }
}

Commands::Slot* Queue::freeSlot() {
  for (auto& slot : slots_)
    if (!slot->recording && done(slot->ticket)) return slot.get();
  auto slot = std::make_unique<Commands::Slot>();
  VkCommandPoolCreateInfo poolInfo{};
  poolInfo.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO;
  poolInfo.flags = VK_COMMAND_POOL_CREATE_TRANSIENT_BIT;
  poolInfo.queueFamilyIndex = device_.adapter().queueFamily;
  VkCommandPool pool = VK_NULL_HANDLE;
  check(vkCreateCommandPool(device_.handle(), &poolInfo, nullptr, &pool), "vkCreateCommandPool");
  slot->pool = {device_.handle(), pool};
  VkCommandBufferAllocateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO;
  info.commandPool = pool;
  info.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
  info.commandBufferCount = 1;
  check(vkAllocateCommandBuffers(device_.handle(), &info, &slot->buffer), "vkAllocateCommandBuffers");
  slots_.push_back(std::move(slot));
  return slots_.back().get();
}

Commands Queue::begin(const char* name) {
  dropRetired();
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
  std::vector<VkSemaphoreSubmitInfo> allSignals(signals.begin(), signals.end());
  if (!immediate_) allSignals.push_back(tick);
  VkCommandBufferSubmitInfo buffer{};
  buffer.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_SUBMIT_INFO;
  buffer.commandBuffer = commands;
  VkSubmitInfo2 info{};
  info.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO_2;
  info.waitSemaphoreInfoCount = std::uint32_t(waits.size());
  info.pWaitSemaphoreInfos = waits.data();
  info.commandBufferInfoCount = 1;
  info.pCommandBufferInfos = &buffer;
  info.signalSemaphoreInfoCount = std::uint32_t(allSignals.size());
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

bool Queue::done(Ticket ticket) const {
  return ticket.value == 0 || reached() >= ticket.value;
}

void Queue::wait(Ticket ticket) {
  if (immediate_) return dropRetired();
  const VkSemaphore semaphore = timeline_.get();
  VkSemaphoreWaitInfo info{};
  info.sType = VK_STRUCTURE_TYPE_SEMAPHORE_WAIT_INFO;
  info.semaphoreCount = 1;
  info.pSemaphores = &semaphore;
  info.pValues = &ticket.value;
  check(vkWaitSemaphores(device_.handle(), &info, UINT64_MAX), "vkWaitSemaphores");
  dropRetired();
}

void Queue::dropRetired() {
  if (retired_.empty()) return;
  const std::uint64_t now = reached();
  while (!retired_.empty() && retired_.front().ticket.value <= now) retired_.pop_front();
}

}  // namespace vasa::gpu
