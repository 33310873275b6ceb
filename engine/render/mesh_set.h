#pragma once
#include <memory>
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
  /// The same meshes in poses of their own, on the same device: what is at rest is there once.
  static MeshSet sharing(gpu::Device& device, const MeshSet& other) { return {device, other.rest_}; }

  std::span<const Part> parts() const { return rest_->parts; }
  /// For every part that `look` shows the coarsest level whose error shows as `pixels` at most, the mesh
  /// itself for 0 pixels; for every other part an empty level.
  /// @param chosen  one a part on return
  void levelsFor(const Look& look, std::span<const mat4> jointMatrices, const Camera& camera,
                 std::uint32_t pictureHeight, float pixels, std::vector<Level>& chosen) const;
  const Heart& heart() const { return rest_->heart; }
  /// Joints that the meshes use: highest number + 1.
  std::uint32_t jointCount() const { return rest_->jointCount; }
  VkDeviceAddress rest() const { return rest_->vertices.address(); }
  const gpu::Buffer& posed() const { return posed_; }  ///< shared::TubeVertex
  const gpu::Buffer& indices() const { return rest_->indices; }
  VkDeviceAddress colours() const { return rest_->colours.address(); }  ///< one a part

 private:
  struct AtRest {
    std::vector<Part> parts;
    Heart heart;
    std::uint32_t jointCount = 0;
    std::size_t vertexCount = 0;
    gpu::Buffer vertices, indices, colours;
  };
  MeshSet(gpu::Device& device, std::shared_ptr<const AtRest> rest);
  static AtRest atRest(gpu::Device& device, std::span<const SkinnedMesh> meshes, const BodyLevels& levels);

  std::shared_ptr<const AtRest> rest_;
  gpu::Buffer posed_;
};

}  // namespace vasa
