#pragma once
#include "render/camera.h"

namespace vasa::viewer {

/// A camera that turns about a pivot, upright (+Y up), as Blender's and f3d's do. Plain values: two equal
/// orbits see the same picture.
class Orbit {
 public:
  /// Turns about the pivot. @param turn  [rad] to the right and up
  void orbit(vec2 turn);
  /// Moves the picture along with the pointer. @param pixels  to the right and down; @param height  [pixels]
  /// of the picture
  void pan(vec2 pixels, float height);
  /// Nearer (steps > 0) or farther, by a tenth a step; what lies under `place` stays there.
  /// @param place  in the picture, -1..1 to the right and up, the height's half for both; 0: its middle
  void dolly(float steps, vec2 place = vec2(0));
  /// Looks along an axis; the pivot stays.
  void look(View view);
  void lookFromBelow();
  void setOrthographic(bool on) { orthographic_ = on; }
  bool orthographic() const { return orthographic_; }
  /// Moves up to a box without turning.
  void frame(const Aabb& box, float aspect);
  /// Follows what moves: pivot and eye together.
  void shift(vec3 way) { pivot_ += way; }

  vec3 pivot() const { return pivot_; }
  float distance() const { return distance_; }
  float angle() const { return angle_; }
  /// Takes over place, direction and angle of a camera.
  void take(const Camera& camera);

  /// @param cut  0..1: how much of the way from the eye through the scene is cut off (reach on both sides of
  /// the pivot)
  /// @param reach  [m] radius of the scene about the pivot
  Camera camera(float cut, float reach) const;

  bool operator==(const Orbit&) const = default;

 private:
  vec3 backwards() const;
  Camera plain() const;

  vec3 pivot_{0, 1, 0};
  float distance_ = 3;         // [m]
  float yaw_ = 0, pitch_ = 0;  // [rad] of the eye about the pivot, from +Z towards +X, and up
  float angle_ = glm::radians(30.0f);
  bool orthographic_ = false;
};

}  // namespace vasa::viewer
