#pragma once
#include <chrono>
#include <future>
#include <optional>
#include <span>
#include <vector>

#include "gpu/timer.h"
#include "render/fork_pass.h"
#include "render/frame_upload.h"
#include "render/patch_pass.h"
#include "render/renderer.h"
#include "render/static_tubes.h"
#include "render/surface_pass.h"

namespace vasa {

/// A network's vessels on the device, without capillaries: tubes, forks and patches, the passes that turn
/// them into triangles, and the two templates that these go to by turns, round by round.
class DrawnVessels {
 public:
  /// The forks' pass is still being made: settle().
  DrawnVessels(gpu::Device& device, const Network& network, const RenderOptions& options);
  DrawnVessels(const DrawnVessels&) = delete;
  DrawnVessels& operator=(const DrawnVessels&) = delete;
  /// Before a frame: waits until all is made. A driver takes as long for the forks' shader as for all others,
  /// and is given it beside them. A frame that does not wait is without forks until then.
  void settle(bool waits = true);
  /// Whether it is made, or will be within so long.
  bool isSettled(std::chrono::milliseconds within) const;

  /// Another network, or the same with other quads. Pipelines stay where it asks for no others. Colours are
  /// those of its vessels' kinds.
  void take(const Network& network, const RenderOptions& options);
  /// Of the spans; Renderer::setSweepColours(). @return what they are now
  std::vector<std::uint32_t> setColours(std::span<const std::uint32_t> given);

  /// What of a frame all passes read.
  struct Frame {
    const FrameUpload& upload;
    gpu::GpuTimer& timer;
    bool cull = true;
  };
  /// Before the first round: which m and n; nothing is written yet. Barriers included.
  void recordStart(VkCommandBuffer commands, const Frame& frame, const shared::DetailView& view) const;
  /// A round: the next groups of tubes and forks into the template whose turn it is.
  void recordFill(VkCommandBuffer commands, const Frame& frame, std::uint32_t round) const;
  void recordPatches(VkCommandBuffer commands, const Frame& frame) const;
  /// After the last round: how far it came, for filling().
  void recordEnd(VkCommandBuffer commands) const { filling_.recordCopy(commands); }
  /// A template more than the first one, for frames of several rounds.
  void makeRoom();

  VesselDraws drawsOfRound(std::uint32_t round) const { return drawsOf(templateOf(round)); }
  VesselDraws drawsOfPatches() const { return drawsOf(patches_); }
  bool anyPatches() const { return patchPass_.has_value(); }

  const TubeSet& tubes() const { return tubes_; }
  const Filling& filling() const { return filling_; }
  const FillRange& range() const { return range_; }  ///< of a frame
  std::uint64_t triangleCount() const;
  VkDeviceSize bytes() const;  ///< of all that rounds and patches write

  /// For comparison: all of the tubes' and forks' triangles at once (static_tubes.h).
  void recordStatic(VkCommandBuffer commands, const Frame& frame, const shared::DetailView& view,
                    const StaticTubes& all) const;
  void recordStaticPatches(VkCommandBuffer commands) const;
  StaticTubes makeStatic() const { return {*device_, tubes_, forks_}; }

 private:
  const Template& templateOf(std::uint32_t round) const { return round % 2 == 0 ? first_ : *second_; }

  gpu::Device* device_;
  std::uint32_t samples_, templateBytes_;
  std::vector<std::uint32_t> ownColours_;  // of the spans, by their vessels' kinds
  TubeSet tubes_;
  ForkSet forks_;
  std::future<void> compiling_;  // the forks' shader, where it is to be ready before their pass is used
  std::future<ForkPass> comingForkPass_;
  PatchSet patches_;
  DetailPass detailPass_;
  TubePass tubePass_;
  ForkPass forkPass_;
  std::optional<PatchPass> patchPass_;  // where there are patches
  FillRange range_;
  Filling filling_;
  PlanPass planPass_;
  Template first_;
  std::optional<Template> second_;  // where the first may not do
};

}  // namespace vasa
