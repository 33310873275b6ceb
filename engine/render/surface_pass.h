#pragma once
#include <array>

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
/// reversed (clear to 0). `partial` is the frame's isPartial().
class SurfacePass {
 public:
  SurfacePass(gpu::Device& device, const gpu::TargetSpec& target);

  void recordVessels(VkCommandBuffer commands, shared::DrawPush push, const VesselDraws& draws, const Look& look = {},
                     bool partial = false) const;
  /// Bones, heart and others.
  /// @param levels  MeshSet::levelsFor()
  void recordOpaque(VkCommandBuffer commands, shared::DrawPush push, const MeshSet& meshes,
                    std::span<const MeshSet::Level> levels, const Look& look, bool partial = false) const;
  /// Organs, then the skin: the depth of their nearest side first, then that side's colour over what lies behind.
  void recordTranslucent(VkCommandBuffer commands, shared::DrawPush push, const MeshSet& meshes,
                         std::span<const MeshSet::Level> levels, const Look& look, bool partial = false) const;

 private:
  struct Pipelines {
    std::array<gpu::GraphicsPipeline, 3> tubes, opaque, closed, skinColour;  // one of each for every LookStyle
    gpu::GraphicsPipeline skinDepth;
  };
  Pipelines make(gpu::Device& device, const gpu::TargetSpec& target, bool partial) const;

  Pipelines whole_, partial_;
};

}  // namespace vasa
