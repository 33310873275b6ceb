#pragma once
#include <span>
#include <vector>

#include "gpu/buffer.h"
#include "shared/tubes.h"
#include "surface/sweep_table.h"
#include "surface/sweep_template.h"

namespace vasa {

/// How finely tubes are cut (surface/detail.h): everywhere alike, or by their size on the picture.
struct TubeDetail {
  SweepShape shape;
  float pixelError = 0;  ///< [pixels] > 0: m and n are the least that keep it, and `shape` is not used
  bool forks = true;     ///< false: all vessels are tubes of their own, which end inside one another
  const SweepTable* table = nullptr;  ///< makeSweepTable() of the network where there is one already; copied

  bool automatic() const { return pixelError > 0; }
  std::uint32_t mostAround() const { return automatic() ? shared::kMaxAround : shape.around; }
  std::uint32_t mostAlong() const { return automatic() ? shared::kMaxAlong : shape.along; }
};

/// Kind of an item that is never drawn; the others are VesselKind's values.
constexpr std::uint32_t kHiddenKind = 31;

/// Room for what a group of sweeps or forks writes at most; vertices in whole blocks (shared::kBlockVertices).
struct GroupRoom {
  std::uint32_t vertices = 0, indices = 0;
};
/// Vertices that an item's blocks hold.
constexpr std::uint32_t inBlocks(std::uint32_t vertices) {
  return (vertices + shared::kBlockVertices - 1) >> shared::kBlockShift << shared::kBlockShift;
}

/// Groups of kGroupSweeps sweeps, the last one maybe of fewer, that are tessellated and drawn together.
struct TubeBatch {
  std::uint32_t firstSweep = 0, sweeps = 0;
  std::uint32_t groups() const { return (sweeps + shared::kGroupSweeps - 1) / shared::kGroupSweeps; }
};

/// Colours of a network's spans by their vessels' kinds, kind in the highest 8 bits.
std::vector<std::uint32_t> kindColours(const Network& network);
/// The same with other colours (packColour; alpha 0 hides a span). @param given  empty: none
std::vector<std::uint32_t> recoloured(std::vector<std::uint32_t> kindColours, std::span<const std::uint32_t> given);

/// What of a network stays the same from frame to frame, in device memory.
class TubeSet {
 public:
  /// @param batchSweeps  most sweeps in a batch, rounded up to whole groups
  TubeSet(gpu::Device& device, const Network& network, const TubeDetail& detail, std::uint32_t batchSweeps);

  const SweepTable& table() const { return table_; }
  const TubeDetail& detail() const { return detail_; }
  std::span<const TubeBatch> batches() const { return batches_; }
  const GroupRoom& room() const { return room_; }
  std::uint32_t groupsPerBatch() const { return batches_.empty() ? 0 : batches_.front().groups(); }
  std::uint32_t groupCount() const { return TubeBatch{0, std::uint32_t(table_.sweeps.size())}.groups(); }
  std::uint32_t vesselCount() const { return vesselCount_; }
  /// Of tubes and caps at fixed quads, seen or not; 0 if the picture decides.
  std::uint64_t triangleCount() const;

  VkDeviceAddress sweeps() const { return sweeps_.address(); }
  VkDeviceAddress tables() const { return tables_.address(); }
  VkDeviceAddress colours() const { return colours_.address(); }  ///< one a sweep, kind in the highest 8 bits

  /// Waits for the device. @param spanColours  one a span of the network, kind in the highest 8 bits
  void setSpanColours(gpu::Device& device, std::span<const std::uint32_t> spanColours);

 private:
  void makeBatches(std::uint32_t batchSweeps);

  SweepTable table_;
  TubeDetail detail_;
  std::vector<TubeBatch> batches_;
  GroupRoom room_;
  std::uint32_t vesselCount_ = 0;
  gpu::Buffer sweeps_, tables_, colours_;
};

}  // namespace vasa
