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

/// Vertices that an item's blocks (shared::kBlockVertices) hold.
constexpr std::uint32_t inBlocks(std::uint32_t vertices) {
  return (vertices + shared::kBlockVertices - 1) >> shared::kBlockShift << shared::kBlockShift;
}
/// Blocks for so many vertices, already in whole blocks, and indices.
constexpr std::uint32_t blocksFor(std::uint32_t vertices, std::uint32_t indices) {
  constexpr std::uint32_t indicesOfBlock = sizeof(shared::TubeVertex) / 4 * shared::kBlockVertices;
  return (vertices >> shared::kBlockShift) + (indices + indicesOfBlock - 1) / indicesOfBlock;
}

/// Colours of a network's spans by their vessels' kinds, kind in the highest 8 bits.
std::vector<std::uint32_t> kindColours(const Network& network);
/// The same with other colours (packColour; alpha 0 hides a span). @param given  empty: none
std::vector<std::uint32_t> recoloured(std::vector<std::uint32_t> kindColours,
                                      std::span<const std::uint32_t> given);

/// What of a network stays the same from frame to frame, in device memory.
class TubeSet {
 public:
  /// @param templateBytes  a group is so small that half of that always holds it; at least some 0.6 MB do for
  /// any quads
  TubeSet(gpu::Device& device, const Network& network, const TubeDetail& detail, std::uint32_t templateBytes);

  const SweepTable& table() const { return table_; }
  const TubeDetail& detail() const { return detail_; }
  std::uint32_t groupSweeps() const {
    return groupSweeps_;
  }  ///< sweeps that are written together: a workgroup
  std::uint32_t groupBlocks() const { return groupBlocks_; }  ///< the most that a group needs
  std::uint32_t vesselCount() const { return vesselCount_; }
  /// Of tubes and caps at fixed quads, seen or not; 0 if the picture decides.
  std::uint64_t triangleCount() const;

  VkDeviceAddress sweeps() const { return sweeps_.address(); }
  VkDeviceAddress tables() const { return tables_.address(); }
  VkDeviceAddress colours() const { return colours_.address(); }  ///< one a sweep, kind in the highest 8 bits

  /// Waits for the device. @param spanColours  one a span of the network, kind in the highest 8 bits
  void setSpanColours(gpu::Device& device, std::span<const std::uint32_t> spanColours);

 private:
  std::uint32_t blocksOfGroups(std::uint32_t sweeps) const;

  SweepTable table_;
  TubeDetail detail_;
  std::uint32_t groupSweeps_ = shared::kGroupSweeps, groupBlocks_ = 0;
  std::uint32_t vesselCount_ = 0;
  gpu::Buffer sweeps_, tables_, colours_;
};

}  // namespace vasa
