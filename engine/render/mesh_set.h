#pragma once
#include <span>
#include <vector>

#include "body/body.h"
#include "gpu/buffer.h"
#include "render/look.h"
#include "render/mesh_levels.h"

namespace vasa {

/// The body's meshes and their levels in device memory, one behind the other: at rest, and as posed in this
/// frame.
class MeshSet {
 public:
  struct Level {
    float error = 0;  ///< [m] of the surface; 0 for the mesh itself
    std::uint32_t firstIndex = 0, indexCount = 0;
    std::uint32_t firstVertex = 0, vertexCount = 0;
    bool bothSides = true;  ///< backs of triangles may be seen
    float depth = 0;        ///< [m] how far before the eye its nearest place lies, about
  };
  struct Part {
    MeshRole role;
    float opacity = 1;          ///< of an organ
    std::vector<Level> levels;  ///< the mesh itself, then ever coarser ones
    bool closed = false;
    std::vector<JointBall> balls;  ///< where it is, if it has several levels
  };
  /// The part that beats, and its middle at rest; none without a heart.
  struct Heart {
    std::size_t part = ~std::size_t(0);
    vec3 centre{0};
  };
  /// @param levels  of each mesh (mesh_levels.h)
  MeshSet(gpu::Device& device, std::span<const SkinnedMesh> meshes, const BodyLevels& levels);

  std::span<const Part> parts() const { return parts_; }
  /// For every part that `look` shows the coarsest level whose error shows as `pixels` at most, the mesh
  /// itself for 0 pixels; for every other part an empty level.
  std::vector<Level> levelsFor(const Look& look, std::span<const mat4> jointMatrices, const Camera& camera,
                               std::uint32_t pictureHeight, float pixels) const;
  const Heart& heart() const { return heart_; }
  std::uint32_t jointCount() const {
    return jointCount_;
  }  ///< joints that the meshes use: highest number + 1
  VkDeviceAddress rest() const { return rest_.address(); }
  const gpu::Buffer& posed() const { return posed_; }  ///< shared::TubeVertex
  const gpu::Buffer& indices() const { return indices_; }
  VkDeviceAddress colours() const { return colours_.address(); }  ///< one a part

 private:
  std::vector<Part> parts_;
  Heart heart_;
  std::uint32_t jointCount_ = 0;
  gpu::Buffer rest_, posed_, indices_, colours_;
};

}  // namespace vasa
