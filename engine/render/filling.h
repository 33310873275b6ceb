#pragma once
#include "gpu/compute_pipeline.h"
#include "render/fork_set.h"
#include "render/tube_set.h"

namespace vasa {

/// Memory that a round of tubes and forks is written to, drawn from, and that a later round overwrites:
/// vertices and indices in blocks as groups take them, a colour a block, a draw a group.
struct Template {
  Template(gpu::Device& device, const shared::FillRoom& room);
  VkDeviceSize bytes() const { return pool.allocated() + colours.allocated() + draws.allocated(); }

  gpu::Buffer pool, colours, draws;  ///< shared::TubeVertex and uint, uint, shared::DrawCommand
};

/// What of a network's tubes and forks a frame draws.
struct FillRange {
  std::uint32_t firstTube = 0, tubeEnd = 0, firstFork = 0, forkEnd = 0;

  bool empty() const { return firstTube == tubeEnd && firstFork == forkEnd; }
};
FillRange everything(const TubeSet& tubes);

/// Room of a template of so many bytes, or of fewer where that holds all of the range whatever the picture
/// needs. The sets have to be made for at most that many bytes.
shared::FillRoom fillRoom(const TubeSet& tubes, const ForkSet& forks, const FillRange& range,
                          VkDeviceSize bytes);
/// Room for all of the range in one round.
shared::FillRoom roomForAll(const TubeSet& tubes, const ForkSet& forks, const FillRange& range);

/// How far a frame has come: says round by round which groups are written and drawn (shared/filling.h).
class Filling {
 public:
  /// @param tubes, forks  read, not kept
  Filling(gpu::Device& device, const TubeSet& tubes, const ForkSet& forks, const shared::FillRoom& room);

  const shared::FillRoom& room() const { return room_; }
  std::uint32_t groupSweeps() const { return groupSweeps_; }  ///< TubeSet::groupSweeps()
  std::uint32_t groupForks() const { return groupForks_; }
  const gpu::Buffer& state() const { return state_; }

  /// Before a frame's first round. Barriers included: compute passes and indirect dispatches see it.
  void recordStart(VkCommandBuffer commands, const FillRange& range) const;
  /// After the last round's plan: state for read(). No barriers.
  void recordCopy(VkCommandBuffer commands) const;
  /// Once the copy is done.
  shared::Filling read() const;

 private:
  shared::FillRoom room_;
  std::uint32_t groupSweeps_, groupForks_;
  gpu::Buffer state_, host_;
  friend class PlanPass;
};

/// Ends a round: what of it is drawn, and where the next one begins.
class PlanPass {
 public:
  explicit PlanPass(gpu::Device& device);
  /// After tubes and forks were written to a template. No barriers.
  void record(VkCommandBuffer commands, const Filling& filling, const Template& into) const;

 private:
  gpu::ComputePipeline pipeline_;
};

}  // namespace vasa
