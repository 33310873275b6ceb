#pragma once
#include <array>

#include "gpu/graphics_pipeline.h"
#include "gpu/target.h"
#include "render/camera.h"
#include "render/fork_set.h"
#include "render/mesh_set.h"
#include "render/tube_pass.h"
#include "shared/draw.h"

namespace vasa {

/// Bit k: vessels of kind k (VesselKind, kHiddenKind) are not drawn.
std::uint32_t hiddenKinds(const Look& look);

/// The push constants that all draws of a frame share: the camera's, and which vessels are hidden.
shared::DrawPush drawConstants(const Camera& camera, const Look& look, VkExtent2D size);

/// Draws vertices that compute passes have written. Record between Target::begin() and its end; depth is
/// reversed (clear to 0).
class SurfacePass {
 public:
  SurfacePass(gpu::Device& device, const gpu::TargetSpec& target);

  /// Tubes or forks. @param groups  of the batch
  void recordVessels(VkCommandBuffer commands, shared::DrawPush push, const TubeDraws& draws, std::uint32_t groups,
                     LookStyle style = LookStyle::atlas) const;
  /// Bones, heart and others.
  /// @param levels  MeshSet::levelsFor()
  void recordOpaque(VkCommandBuffer commands, shared::DrawPush push, const MeshSet& meshes,
                    std::span<const MeshSet::Level> levels, const Look& look) const;
  /// Organs, then the skin: the depth of their nearest side first, then that side's colour over what lies behind.
  void recordTranslucent(VkCommandBuffer commands, shared::DrawPush push, const MeshSet& meshes,
                  std::span<const MeshSet::Level> levels, const Look& look) const;

 private:
  // One of each for every LookStyle.
  std::array<gpu::GraphicsPipeline, 3> tubes_, opaque_, closed_, skinColour_;
  gpu::GraphicsPipeline skinDepth_;
};

}  // namespace vasa
