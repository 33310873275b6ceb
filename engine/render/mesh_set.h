#pragma once
#include <vector>

#include "body/body.h"
#include "gpu/buffer.h"
#include "render/look.h"

namespace vasa {

/// The body's meshes in device memory, one behind the other: at rest, and as posed in this frame.
class MeshSet {
 public:
  struct Part {
    MeshRole role;
    std::uint32_t firstIndex, indexCount;
  };
  /// Vertices [first, last) of the heart, and their middle at rest; none without a heart.
  struct Heart {
    std::uint32_t first = 0, last = 0;
    vec3 centre{0};
  };
  MeshSet(gpu::Device& device, std::span<const SkinnedMesh> meshes);

  std::span<const Part> parts() const { return parts_; }
  const Heart& heart() const { return heart_; }
  std::uint32_t vertexCount() const { return vertexCount_; }
  std::uint32_t jointCount() const { return jointCount_; }  ///< joints that the meshes use: highest number + 1
  VkDeviceAddress rest() const { return rest_.address(); }
  const gpu::Buffer& posed() const { return posed_; }  ///< shared::TubeVertex
  const gpu::Buffer& indices() const { return indices_; }
  VkDeviceAddress colours() const { return colours_.address(); }  ///< one a part

 private:
  std::vector<Part> parts_;
  Heart heart_;
  std::uint32_t vertexCount_ = 0, jointCount_ = 0;
  gpu::Buffer rest_, posed_, indices_, colours_;
};

}  // namespace vasa
