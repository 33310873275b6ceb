#pragma once
#include <span>

#include "math/types.h"

namespace vasa {

/// Before the correction: where everything was, at rest and in the pose.
struct PosedVessels {
  std::span<const vec4> points;     ///< as Network::points(), in the pose
  std::span<const quat> rotations;  ///< how each point's surroundings turned since rest (Deformer::rotations)
  std::span<const mat4> jointMatrices = {};  ///< a joint's world · inverseBind; may be empty without bones
};

}  // namespace vasa
