#pragma once
#include <optional>
#include <string_view>

#include "math/aabb.h"

namespace vasa {

/// Where the picture is taken from.
struct Camera {
  vec3 position{0, 1, 4};        ///< [m]
  vec3 target{0, 1, 0};          ///< [m] in the middle of the picture, apart from position
  vec3 up{0, 1, 0};              ///< not parallel to the line of sight
  float verticalAngle = 0.5f;    ///< [rad] field of view from bottom to top, in (0, π); perspective only
  float orthographicHeight = 0;  ///< [m] from bottom to top of the picture; 0: perspective
  float nearDistance = 0.02f;    ///< [m] > 0: what is closer is cut off
  float farDistance = 100;       ///< [m] orthographic only; a perspective view has no end
  /// A cutting plane of the world (unit normal, offset): what lies where dot(normal, p) + offset < 0 is not
  /// drawn.
  std::optional<vec4> cut;
};

/// The camera's axes in the world, unit: right, up, and backwards to the viewer. Where `up` is parallel to
/// the line of sight, some perpendicular stands in.
mat3 cameraAxes(const Camera& camera);

/// World to clip space. Depth is reversed: 1 at nearDistance, towards 0 far away; y points down in the
/// picture, as Vulkan has it.
mat4 viewProjection(const Camera& camera, float aspect);

/// Directions of view, by the body's own sides; the body stands along +Y and faces +Z, its left is +X.
enum class View { front, back, left, right, top };
std::optional<View> viewNamed(std::string_view name);

/// A perspective camera that holds the whole box with a margin of 4 % of the picture's size.
/// @param box     not empty; a point is taken as 1 cm wide
/// @param aspect  width / height of the picture, > 0
Camera cameraFrom(View view, const Aabb& box, float aspect);

/// The same view without perspective: what is at the target keeps its size.
/// @param reach  [m] from the target to the farthest of what is seen. The eye moves back as far: it sees all
/// from outside
Camera orthographic(Camera camera, float reach);

/// The same direction of view moved up to a box.
Camera focusOn(const Camera& camera, const Aabb& box, float aspect);

}  // namespace vasa
