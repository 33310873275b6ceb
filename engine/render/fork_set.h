#pragma once
#include "render/tube_set.h"
#include "shared/fork.h"

namespace vasa {

/// What of a network's forks stays the same from frame to frame, in device memory.
class ForkSet {
 public:
  /// @param templateBytes  as TubeSet's
  ForkSet(gpu::Device& device, const SweepTable& table, const TubeDetail& detail,
          std::uint32_t templateBytes);

  std::uint32_t groupForks() const { return groupForks_; }  ///< forks that are written together: a workgroup
  std::uint32_t groupBlocks() const {
    return groupBlocks_;
  }  ///< the most that a group needs; 0 without forks
  /// At fixed quads, seen or not; 0 if the picture decides.
  std::uint64_t triangleCount() const { return triangles_; }

  VkDeviceAddress forks() const { return forks_.address(); }
  VkDeviceAddress branches() const { return branches_.address(); }
  VkDeviceAddress colours() const { return colours_.address(); }  ///< one a fork, kind in the highest 8 bits

  /// Waits for the device. @param spanColours  one a span of the network, kind in the highest 8 bits
  void setSpanColours(gpu::Device& device, std::span<const std::uint32_t> spanColours);

 private:
  std::uint32_t count_ = 0;
  std::uint64_t triangles_ = 0;
  std::uint32_t groupForks_ = shared::kGroupForks, groupBlocks_ = 0;
  std::vector<std::uint32_t> spanOfFork_;
  gpu::Buffer forks_, branches_, colours_;
};

}  // namespace vasa
