#include "plate/seen_map.h"

#include <algorithm>
#include <cmath>

namespace vasa::plate {

SeenMap::SeenMap(const Camera& camera, std::uint32_t width, std::uint32_t height)
    : matrix_(viewProjection(camera, float(width) / float(height))),
      camera_(camera),
      width_(width),
      height_(height),
      what_(std::size_t(width) * height, kNothing),
      depth_(what_.size(), 0.0f) {}

bool SeenMap::project(vec3 place, vec2& cell) const {
  const vec4 clip = matrix_ * vec4(place, 1);
  if (clip.w <= 1e-6f) return false;
  cell = (vec2(clip) / clip.w * 0.5f + 0.5f) * vec2(width_, height_);
  return true;
}

bool SeenMap::hides(vec3 place) const {
  const vec4 clip = matrix_ * vec4(place, 1);
  if (clip.w <= 1e-6f) return false;
  const vec2 cell = glm::floor((vec2(clip) / clip.w * 0.5f + 0.5f) * vec2(width_, height_));
  if (cell.x < 0 || cell.y < 0 || cell.x >= float(width_) || cell.y >= float(height_)) return false;
  return depth_[std::size_t(cell.y) * width_ + std::size_t(cell.x)] > clip.z / clip.w;
}

float SeenMap::cellsAMetre(vec3 place) const {
  if (camera_.orthographicHeight > 0) return float(height_) / camera_.orthographicHeight;
  const float away = glm::dot(camera_.position - place, cameraAxes(camera_)[2]);
  return float(height_) / (2 * std::max(away, 1e-6f) * std::tan(camera_.verticalAngle / 2));
}

void SeenMap::draw(std::span<const vec3> positions, std::span<const uvec3> triangles,
                   const std::function<std::uint32_t(std::uint32_t)>& number) {
  std::vector<vec3> cells(positions.size());  // x and y in cells, depth; depth above 1: not to be drawn
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const vec4 clip = matrix_ * vec4(positions[i], 1);
    const bool cut = camera_.cut && glm::dot(vec3(*camera_.cut), positions[i]) + camera_.cut->w < 0;
    if (clip.w <= 1e-6f || cut)
      cells[i] = vec3(0, 0, 2);
    else
      cells[i] = vec3((vec2(clip) / clip.w * 0.5f + 0.5f) * vec2(width_, height_), clip.z / clip.w);
  }
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    const uvec3& corners = triangles[t];
    const vec3 &a = cells[corners.x], &b = cells[corners.y], &c = cells[corners.z];
    if (std::max({a.z, b.z, c.z}) > 1) continue;
    if (const std::uint32_t what = number(t); what != kNothing) fill(a, b, c, what);
  }
}

void SeenMap::fill(vec3 a, vec3 b, vec3 c, std::uint32_t number) {
  const float area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
  if (area == 0) return;
  const auto first = [](float least) { return std::max(0, int(std::ceil(least - 0.5f))); };
  const auto last = [](float most, std::uint32_t size) {
    return std::min(int(size) - 1, int(std::floor(most - 0.5f)));
  };
  for (int y = first(std::min({a.y, b.y, c.y})); y <= last(std::max({a.y, b.y, c.y}), height_); ++y)
    for (int x = first(std::min({a.x, b.x, c.x})); x <= last(std::max({a.x, b.x, c.x}), width_); ++x) {
      const float px = float(x) + 0.5f, py = float(y) + 0.5f;
      const float u = ((b.x - px) * (c.y - py) - (b.y - py) * (c.x - px)) / area;
      const float v = ((c.x - px) * (a.y - py) - (c.y - py) * (a.x - px)) / area;
      const float w = 1 - u - v;
      if (u < 0 || v < 0 || w < 0) continue;
      const float depth = u * a.z + v * b.z + w * c.z;
      const std::size_t cell = std::size_t(y) * width_ + std::size_t(x);
      if (depth > depth_[cell]) depth_[cell] = depth, what_[cell] = number;
    }
}

}  // namespace vasa::plate
