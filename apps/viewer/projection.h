#pragma once
#include <cmath>
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

/// A way in the plane through a place that lies parallel to the picture [m].
/// @param pixels  the same way in the picture  @param height  [pixels] of the picture
inline vec3 wayInPlane(const Camera& camera, vec3 place, vec2 pixels, float height) {
  const mat3 axes = cameraAxes(camera);
  const float depth = glm::dot(place - camera.position, -axes[2]);
  const float high = camera.orthographicHeight > 0 ? camera.orthographicHeight
                                                   : 2 * depth * std::tan(camera.verticalAngle / 2);
  return high / height * (pixels.x * axes[0] - pixels.y * axes[1]);
}

}  // namespace vasa::viewer
