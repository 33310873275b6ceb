#pragma once
#include <vector>

#include "gpu/buffer.h"
#include "surface/sweep_table.h"
#include "surface/sweep_template.h"

namespace vasa {

/// Sweeps or caps that are tessellated into one template buffer and drawn together.
struct TubeBatch {
  bool caps = false;
  std::uint32_t first = 0, count = 0;  ///< into SweepTable::sweeps or ::caps
};

/// Kind of an item that is never drawn; the others are VesselKind's values.
constexpr std::uint32_t kHiddenKind = 31;

/// What of a network stays the same from frame to frame, in device memory.
class TubeSet {
 public:
  /// @param batchSweeps  most sweeps (or caps) in a batch, at least 1
  TubeSet(gpu::Device& device, const Network& network, const SweepShape& shape, std::uint32_t batchSweeps);

  const SweepTable& table() const { return table_; }
  const SweepShape& shape() const { return shape_; }
  std::span<const TubeBatch> batches() const { return batches_; }
  VkDeviceSize templateBytes() const { return templateBytes_; }  ///< vertices of the largest batch
  std::uint64_t triangleCount() const;

  VkDeviceAddress sweeps() const { return sweeps_.address(); }
  VkDeviceAddress caps() const { return caps_.address(); }
  VkDeviceAddress tables() const { return tables_.address(); }
  VkDeviceAddress colours() const { return colours_.address(); }
  std::uint32_t verticesPerItem(const TubeBatch& batch) const;
  /// Place of the batch's first item in colours(): sweeps first, then caps.
  std::uint32_t firstColour(const TubeBatch& batch) const;
  /// Indexed triangles of a batch whose vertices are bound at its first.
  void drawBatch(VkCommandBuffer commands, const TubeBatch& batch) const;

  /// Waits for the device. Empty: the colours of the vessels' kinds.
  void setSweepColours(gpu::Device& device, std::span<const std::uint32_t> colours);

 private:
  void makeBatches(std::uint32_t batchSweeps);
  void makeIndices(gpu::Device& device, std::uint32_t batchSweeps);

  SweepTable table_;
  SweepShape shape_;
  std::vector<TubeBatch> batches_;
  std::vector<std::uint32_t> kindColours_;  // one a sweep, kind in the highest 8 bits
  VkDeviceSize templateBytes_ = 0;
  gpu::Buffer sweeps_, caps_, tables_, colours_, sweepIndices_, capIndices_;
};

}  // namespace vasa
