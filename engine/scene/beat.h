#pragma once
#include <span>
#include <vector>

#include "scene/scene.h"

namespace vasa {

/// The heart's beat, a function of time alone: the heart's mesh draws together towards its middle and opens
/// again, and takes along the vessels on it, less and less with their distance at rest. For the eye; no
/// mechanics. A body without a mesh named heart has none.
class HeartBeat {
 public:
  HeartBeat() = default;
  explicit HeartBeat(const Scene& scene);

  /// Size of the heart beside its size at rest, 1 between beats.
  static float scaleAt(float time);

  /// Draws posed control points together. O(points near the heart).
  /// @param jointMatrices  world · inverse bind
  void apply(float scale, std::span<const mat4> jointMatrices, std::span<vec4> points) const;

 private:
  struct Follower {
    std::uint32_t point;
    float share;  ///< 1 on the heart, towards 0 away from it
  };
  std::uint32_t joint_ = 0;
  vec3 centre_{0};
  std::vector<Follower> followers_;
};

/// Middle of a mesh's vertices: what a beating heart draws together to.
vec3 meshCentre(const SkinnedMesh& mesh);

}  // namespace vasa
