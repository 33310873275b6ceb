#pragma once
#include "render/tube_set.h"
#include "shared/fork.h"

namespace vasa {

/// Groups of kGroupForks forks, the last one maybe of fewer, that are written and drawn together.
struct ForkBatch {
  std::uint32_t firstFork = 0, forks = 0;
  std::uint32_t groups() const { return (forks + shared::kGroupForks - 1) / shared::kGroupForks; }
};

/// What of a network's forks stays the same from frame to frame, in device memory.
class ForkSet {
 public:
  /// @param batchForks  most forks in a batch, rounded up to whole groups
  ForkSet(gpu::Device& device, const SweepTable& table, const TubeDetail& detail, std::uint32_t batchForks);

  std::span<const ForkBatch> batches() const { return batches_; }
  const GroupRoom& room() const { return room_; }
  std::uint32_t groupsPerBatch() const { return batches_.empty() ? 0 : batches_.front().groups(); }
  std::uint32_t groupCount() const { return ForkBatch{0, count_}.groups(); }
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
  std::vector<ForkBatch> batches_;
  GroupRoom room_;
  std::vector<std::uint32_t> spanOfFork_;
  gpu::Buffer forks_, branches_, colours_;
};

}  // namespace vasa
