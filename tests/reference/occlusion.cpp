#include "reference/occlusion.h"

#include <algorithm>
#include <cmath>

// McGuire, Osman, Bukowski, Hennessy 2011 (the Alchemy obscurance): each point in front of the surface takes
// light by how steeply it rises over the tangent plane and how near it is.
namespace vasa {
namespace {

using glm::ivec2;
constexpr float kLeast = 3, kMost = 48;  // [pixels] radius of the spiral

class Picture {
 public:
  Picture(std::span<const float> depth, const shared::OcclusionPush& constants)
      : depth_(depth), push_(constants) {}

  float lightAt(ivec2 pixel) const {
    const float depth = depthAt(pixel);
    if (depth <= 0) return 1;
    const vec3 here = placeOf(pixel, depth);
    vec3 normal = glm::cross(slope(pixel, {0, -1}, here), slope(pixel, {-1, 0}, here));
    const float size2 = glm::dot(normal, normal);
    if (!(size2 > 0)) return 1;
    normal /= std::sqrt(size2);
    const float metre = std::abs(push_.step.y * (push_.perspective != 0 ? -here.z : 1.0f));
    const float radius = std::clamp(push_.reach / metre, kLeast, kMost), reach = radius * metre;
    const vec2 axis = axisOf(pixel);
    float taken = 0;
    for (const vec2 unit : shared::kOcclusionSpiral) {
      const vec2 tap = unit * radius,
                 turned(tap.x * axis.x - tap.y * axis.y, tap.x * axis.y + tap.y * axis.x);
      const ivec2 other = pixel + ivec2(glm::floor(turned + 0.5f));
      const float otherDepth = depthAt(other);
      if (otherDepth <= 0) continue;
      const vec3 way = placeOf(other, otherDepth) - here;
      const float size = glm::dot(way, way) / (reach * reach), near = std::max(1 - size, 0.0f);
      taken += near * std::max(glm::dot(way, normal) / reach - 0.06f, 0.0f) / (size + 0.04f);
    }
    return std::max(1 - push_.strength * taken * (2.4f / float(shared::kOcclusionTaps)), 0.0f);
  }

 private:
  float depthAt(ivec2 pixel) const {
    if (pixel.x < 0 || pixel.y < 0 || pixel.x >= int(push_.width) || pixel.y >= int(push_.height)) return 0;
    return depth_[std::size_t(pixel.y) * push_.width + std::size_t(pixel.x)];
  }
  vec3 placeOf(ivec2 pixel, float depth) const {
    const vec4& z = push_.fromDepth;
    const float distance = (z.x + z.y * depth) / (z.z + z.w * depth);
    const vec2 ray = push_.corner + (vec2(pixel) + 0.5f) * push_.step;
    return {ray * (push_.perspective != 0 ? distance : 1.0f), -distance};
  }
  // The smaller of the two differences across a pixel lies on its own surface.
  vec3 slope(ivec2 pixel, ivec2 way, vec3 here) const {
    const float ahead = depthAt(pixel + way), behind = depthAt(pixel - way);
    const vec3 forward = placeOf(pixel + way, ahead) - here, backward = here - placeOf(pixel - way, behind);
    if (ahead <= 0) return backward;
    if (behind <= 0) return forward;
    return std::abs(forward.z) < std::abs(backward.z) ? forward : backward;
  }
  static vec2 axisOf(ivec2 pixel) {
    const std::uint32_t turn =
        ((std::uint32_t(pixel.x) & 3u) * 5u + (std::uint32_t(pixel.y) & 3u) * 3u) & 15u;
    const float x = 1 - 0.125f * float(turn);
    return {x, std::sqrt(std::max(1 - x * x, 0.0f))};
  }

  std::span<const float> depth_;
  const shared::OcclusionPush& push_;
};

}  // namespace

std::vector<float> occlusionOf(std::span<const float> depth, const shared::OcclusionPush& constants) {
  const Picture picture(depth, constants);
  std::vector<float> light(depth.size());
  for (std::size_t i = 0; i < light.size(); ++i)
    light[i] = picture.lightAt({int(i % constants.width), int(i / constants.width)});
  return light;
}

std::vector<float> smoothed(std::span<const float> depth, std::span<const float> raw,
                            const shared::OcclusionPush& constants) {
  std::vector<float> light(depth.size(), 1.0f);
  const ivec2 last = ivec2(constants.width, constants.height) - 1;
  for (std::size_t i = 0; i < light.size(); ++i) {
    if (depth[i] <= 0) continue;
    const ivec2 pixel(i % constants.width, i / constants.width);
    float sum = 0, weights = 0;
    for (int y = -2; y < 2; ++y)
      for (int x = -2; x < 2; ++x) {
        const ivec2 other = glm::clamp(pixel + ivec2(x, y), ivec2(0), last);
        const std::size_t at = std::size_t(other.y) * constants.width + std::size_t(other.x);
        const float weight = std::max(1 - 100 * std::abs(depth[at] - depth[i]) / depth[i], 0.0f);
        sum += weight * raw[at];
        weights += weight;
      }
    light[i] = sum / weights;  // its own weight is 1
  }
  return light;
}

}  // namespace vasa
