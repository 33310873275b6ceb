#pragma once
#include <vulkan/vulkan.h>

#include <cstdint>
#include <span>
#include <vector>

#include "gpu/unique.h"

namespace vasa::gpu {

class Device;

/// Times named stretches of one command buffer on the device. One timer for each frame in flight.
/// A stretch begins when all earlier commands have finished and ends when its own have, so stretches in a row
/// add up. Both ends are full barriers: outside rendering only, and a timed frame overlaps less than an
/// untimed one.
class GpuTimer {
 public:
  struct Time {
    const char* name;
    double ms;
  };
  /// Ends the stretch when it goes.
  class Scope {
   public:
    Scope(GpuTimer& timer, VkCommandBuffer commands, const char* name);
    ~Scope();
    Scope(const Scope&) = delete;
    Scope& operator=(const Scope&) = delete;

   private:
    GpuTimer& timer_;
    VkCommandBuffer commands_;
    std::uint32_t index_;
  };

  /// @param mostScopes  further stretches are only labelled; 0: times nothing and adds no barriers
  explicit GpuTimer(Device& device, std::uint32_t mostScopes = 32);

  /// First in the command buffer, outside rendering: forgets the stretches of the frame before.
  void begin(VkCommandBuffer commands);
  /// Also a label in debuggers and validation messages. `name` must outlive results(). Scopes may nest.
  [[nodiscard]] Scope scope(VkCommandBuffer commands, const char* name) { return {*this, commands, name}; }

  /// After the ticket is done: a time for each scope, in the order they began; empty where the device has no
  /// timestamps, or lost them. Until the next call.
  std::span<const Time> results();

 private:
  Device& device_;
  std::uint32_t mostScopes_;
  Unique<VkQueryPool> queries_;  // empty where the device has no timestamps
  std::vector<const char*> names_;
  std::vector<std::uint64_t> stamps_;
  std::vector<Time> times_;
};

}  // namespace vasa::gpu
