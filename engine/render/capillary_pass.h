#pragma once
#include <array>
#include <optional>

#include "gpu/compute_pipeline.h"
#include "gpu/graphics_pipeline.h"
#include "gpu/target.h"
#include "growth/plan.h"
#include "render/camera.h"
#include "render/look.h"
#include "render/tube_set.h"
#include "shared/draw.h"

namespace vasa {

/// What the shaders see of a camera.
/// @param seed  of the capillaries' shapes
shared::GrowthView growthView(const Camera& camera, VkExtent2D size, std::uint32_t seed);

/// Grows capillaries on the device and draws them, a batch after another through two fixed rings of vertices:
/// the memory does not depend on how many there are. The device must outlive this. CPU reference:
/// growth/capillary.h and tests/reference/ribbon.h.
class CapillaryPass {
 public:
  /// @param wish  levels are the most that record() may be asked for, budget the most curves; 0 levels: takes
  /// no memory
  CapillaryPass(gpu::Device& device, const gpu::TargetSpec& target, const TubeSet& tubes,
                const GrowthRules& rules, const CapillaryBeds& beds, const CapillaryWish& wish);

  /// Before the first frame; waits for the device. @param spanColours  one a span of the network, kind in the
  /// highest 8 bits
  void setSpanColours(gpu::Device& device, std::span<const std::uint32_t> spanColours);

  /// Plans a frame and writes the plan to host memory. The device must have finished the frame before.
  void prepare(std::span<const vec4> points, std::span<const quat> knots, const shared::GrowthView& view);

  struct Input {
    VkDeviceAddress points, knots;  ///< as tessellation reads them
    shared::DrawPush draw;          ///< the frame's constants
    LookStyle style = LookStyle::atlas;
    bool partial = false;  ///< isPartial() of surface_pass.h
  };
  /// Copies the plan to the device and makes compute shaders see it.
  void recordUpload(VkCommandBuffer commands) const;
  std::size_t batches() const { return plan_.batches.size(); }
  /// Writes batch `batch` into its ring. No barriers: whoever read the ring before must have finished.
  void recordGrowth(VkCommandBuffer commands, const Input& input, std::size_t batch) const;
  /// Draws it, between Target::begin() and its end.
  void recordDraw(VkCommandBuffer commands, const Input& input, std::size_t batch) const;

  const CapillaryPlan& plan() const { return plan_; }
  const gpu::Buffer& ring(std::size_t batch) const { return rings_[batch % 2]; }
  std::uint64_t bytes() const;      ///< all device and upload memory: depends on the network's spans and beds
  std::uint64_t ringBytes() const;  ///< of vertices

 private:
  const gpu::GraphicsPipeline& pipelineFor(LookStyle style, bool partial) const;

  gpu::Device* device_;
  gpu::TargetSpec target_;
  const TubeSet& tubes_;
  const CapillaryBeds& beds_;
  const GrowthRules& rules_;
  CapillaryWish wish_;
  CapillaryPlan plan_;
  gpu::ComputePipeline grow_;
  // One a LookStyle; for whole frames and partial ones; made when first drawn with.
  mutable std::array<std::array<std::optional<gpu::GraphicsPipeline>, 2>, 3> draw_;
  std::array<gpu::Buffer, 2> rings_;
  std::array<gpu::Buffer, 5> indices_;  // of threads, and of ribbons of 3, 5, 8 and 10 edges
  gpu::Buffer tables_, bedBuffer_, spans_, colours_, host_, frame_;
};

}  // namespace vasa
