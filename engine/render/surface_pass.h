#pragma once
#include <array>
#include <optional>

#include "gpu/graphics_pipeline.h"
#include "gpu/target.h"
#include "render/camera.h"
#include "render/filling.h"
#include "render/mesh_set.h"
#include "render/patch_pass.h"
#include "shared/draw.h"

namespace vasa {

/// Bit k: vessels of kind k (VesselKind, kHiddenKind) are not drawn.
std::uint32_t hiddenKinds(const Look& look);

/// The push constants that all draws of a frame share: the camera's, and which vessels are hidden.
shared::DrawPush drawConstants(const Camera& camera, const Look& look, VkExtent2D size);

/// Whether something of a frame's surfaces is left out by their opacity or by the camera's cutting plane.
bool isPartial(const Camera& camera, const Look& look);

/// Indexed triangles whose vertices, colours and draws compute passes have written.
struct VesselDraws {
  const gpu::Buffer &vertices, &indices, &colours, &draws;
  std::uint32_t count = 0;  ///< of draws
};
VesselDraws drawsOf(const Template& filled);
VesselDraws drawsOf(const PatchSet& patches);

/// Draws vertices that compute passes have written. Record between Target::begin() and its end; depth is
/// reversed (clear to 0). `partial` is the frame's isPartial(). Pipelines of a style are made when it is
/// first drawn in, those for partial frames likewise: most runs need a sixth of them. The device must outlive
/// this.
class SurfacePass {
 public:
  SurfacePass(gpu::Device& device, const gpu::TargetSpec& target);

  void recordVessels(VkCommandBuffer commands, shared::DrawPush push, const VesselDraws& draws,
                     const Look& look = {}, bool partial = false) const;
  /// Bones, heart and others.
  /// @param levels  MeshSet::levelsFor()
  void recordOpaque(VkCommandBuffer commands, shared::DrawPush push, const MeshSet& meshes,
                    std::span<const MeshSet::Level> levels, const Look& look, bool partial = false) const;
  /// Organs, the farthest first, or the skin, which comes behind them: of each the depth of its nearest side,
  /// then that side's colour over what lies behind.
  void recordTranslucent(VkCommandBuffer commands, shared::DrawPush push, const MeshSet& meshes,
                         std::span<const MeshSet::Level> levels, MeshRole role, const Look& look,
                         bool partial = false) const;

 private:
  struct Pipelines {
    gpu::GraphicsPipeline tubes, opaque, closed, skinColour, skinDepth;
  };
  const Pipelines& pipelines(const Look& look, bool partial) const;
  Pipelines make(LookStyle style, bool partial) const;

  gpu::Device* device_;
  gpu::TargetSpec target_;
  mutable std::array<std::array<std::optional<Pipelines>, 2>, 3>
      made_;  // for every LookStyle, whole and partial
};

}  // namespace vasa
