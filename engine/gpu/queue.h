#pragma once
#include <vulkan/vulkan.h>

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "gpu/unique.h"

namespace vasa::gpu {

class Device;

/// A point in the queue's work: what was submitted with it and everything before. Ticket{} is always done.
struct Ticket {
  std::uint64_t value = 0;
  auto operator<=>(const Ticket&) const = default;
};

/// A command buffer that is being recorded. Converts to the handle, so a pass records into it; dropped
/// without submit(), its commands never run.
class Commands {
 public:
  Commands(Commands&& other) noexcept : slot_(std::exchange(other.slot_, nullptr)) {}
  Commands& operator=(Commands&&) = delete;
  ~Commands();
  operator VkCommandBuffer() const;

 private:
  friend class Queue;
  struct Slot;
  explicit Commands(Slot* slot) : slot_(slot) {}
  Slot* slot_;
};

/// The device's one queue: command buffers from a growing ring, a timeline of tickets.
///
/// Submits run one after the other: begin() records a barrier against everything submitted before, so
/// barriers are needed inside a command buffer only (gpu/barrier.h). What the host wrote and flushed before
/// submit() is seen by the device, and what the device wrote is seen by the host after wait(): submit() ends
/// each command buffer with a barrier for that.
class Queue {
 public:
  Queue(Device& device, VkQueue queue);
  ~Queue();  ///< waits until everything submitted is done
  Queue(const Queue&) = delete;
  Queue& operator=(const Queue&) = delete;

  VkQueue handle() const { return queue_; }

  /// A command buffer in the recording state, of a finished earlier submit where there is one.
  Commands begin(const char* name);
  /// Hands the commands to the device. The semaphores are those of a window system.
  Ticket submit(Commands commands, std::span<const VkSemaphoreSubmitInfo> waits = {},
                std::span<const VkSemaphoreSubmitInfo> signals = {});

  Ticket last() const { return {submitted_}; }  ///< of the latest submit
  bool done(Ticket ticket) const;
  /// Blocks until the ticket's work is finished. Throws Error, Fault::deviceLost if the device is lost or
  /// takes longer than 10 minutes; by then nothing that was submitted runs any more, save on a device that
  /// hangs.
  void wait(Ticket ticket);
  /// Likewise for everything submitted, whatever fails: what owns device memory calls it before it frees
  /// that.
  void settle() noexcept;

 private:
  VkResult waitFor(std::uint64_t value) const;
  bool drain() noexcept;
  std::uint64_t reached() const;
  Commands::Slot* freeSlot();

  Device& device_;
  bool immediate_;  // each submit waits until it is done
  VkQueue queue_;
  Unique<VkSemaphore> timeline_;
  std::uint64_t submitted_ = 0;
  std::uint64_t finished_ = 0;  // known to be done
  std::vector<std::unique_ptr<Commands::Slot>> slots_;
};

/// The last member of what owns device memory: when that goes, on an error's way out too, the queue's work
/// ends first.
class Settled {
 public:
  Settled() = default;
  explicit Settled(Queue& queue) : queue_(&queue) {}
  Settled(Settled&& other) noexcept : queue_(std::exchange(other.queue_, nullptr)) {}
  Settled& operator=(Settled&& other) noexcept {
    std::swap(queue_, other.queue_);  // as Unique does
    return *this;
  }
  ~Settled() {
    if (queue_) queue_->settle();
  }

 private:
  Queue* queue_ = nullptr;
};

}  // namespace vasa::gpu
