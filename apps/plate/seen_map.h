#pragma once
#include <functional>
#include <span>
#include <vector>

#include "render/camera.h"

namespace vasa::plate {

/// What a picture shows where, drawn coarsely on the CPU: of each of its cells the nearest thing. The same on
/// every machine.
class SeenMap {
 public:
  static constexpr std::uint32_t kNothing = 0xffffffff;

  SeenMap(const Camera& camera, std::uint32_t width, std::uint32_t height);

  /// Triangles with the number of what each belongs to; those of kNothing are left out. What the camera's
  /// near plane or cutting plane takes away is not drawn, by whole triangles.
  void draw(std::span<const vec3> positions, std::span<const uvec3> triangles,
            const std::function<std::uint32_t(std::uint32_t triangle)>& number);

  std::uint32_t width() const { return width_; }
  std::uint32_t height() const { return height_; }
  std::uint32_t at(std::uint32_t x, std::uint32_t y) const { return what_[std::size_t(y) * width_ + x]; }
  std::span<const std::uint32_t> cells() const { return what_; }

  /// Where a place is in the picture, in cells (the middle of cell k lies at k + 0.5); false behind the eye.
  bool project(vec3 place, vec2& cell) const;
  /// Whether something drawn lies between the eye and a place.
  bool hides(vec3 place) const;
  /// Cells that a metre at a place takes.
  float cellsAMetre(vec3 place) const;

 private:
  void fill(vec3 a, vec3 b, vec3 c, std::uint32_t number);

  mat4 matrix_;
  Camera camera_;
  std::uint32_t width_, height_;
  std::vector<std::uint32_t> what_;
  std::vector<float> depth_;  // 1 at the near plane, towards 0 far away
};

}  // namespace vasa::plate
