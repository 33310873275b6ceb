#pragma once
#include <optional>

#include "render/camera.h"
#include "viewer/layout.h"

namespace vasa::viewer {

/// Where a place is in the window [pixels], also beside the picture; nothing behind the eye.
inline std::optional<vec2> seenAt(vec3 place, const Camera& camera, const Rect& picture) {
  const vec4 clip = viewProjection(camera, picture.width / picture.height) * vec4(place, 1);
  if (clip.w <= 1e-6f) return std::nullopt;
  // Rows run down, in the window as in what the projection gives.
  return vec2(picture.left, picture.top) +
         (vec2(clip) / clip.w * 0.5f + 0.5f) * vec2(picture.width, picture.height);
}

}  // namespace vasa::viewer
