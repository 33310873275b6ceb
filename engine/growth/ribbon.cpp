#include "growth/ribbon.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace vasa {
namespace {

constexpr float kOverlap = 0.5f;  // in radii, beyond the ends
constexpr float kPoint = 0.3f;    // width of a leaf's end

std::uint32_t snorm16(float value) {
  return std::uint32_t(int(std::floor(std::clamp(value, -1.0f, 1.0f) * 32767.0f + 0.5f))) & 0xffffu;
}

std::uint32_t unorm8(float value) {
  return std::uint32_t(std::clamp(value, 0.0f, 1.0f) * 255.0f + 0.5f);
}

vec3 rgbOf(std::uint32_t packed) {
  return vec3(float(packed & 0xffu), float(packed >> 8 & 0xffu), float(packed >> 16 & 0xffu)) / 255.0f;
}

}  // namespace

void writeRibbon(const Capillary& capillary, const shared::GrowthView& view, std::uint32_t root, std::uint32_t far, std::uint32_t edges,
                 std::span<shared::CapillaryVertex> vertices) {
  assert(vertices.size() == 2 * (edges + 1));
  const vec3 bed = rgbOf(view.capillary), from = glm::mix(rgbOf(root), bed, capillary.phase);
  const vec3 to = capillary.joined ? glm::mix(rgbOf(far), bed, capillary.farPhase)
                                   : glm::mix(rgbOf(root), bed, capillary.phaseAt(1));
  for (std::uint32_t i = 0; i <= edges; ++i) {
    const float t = float(i) / float(edges);
    const vec4 point = capillary.curve.at(t);
    const vec3 along(capillary.curve.derivative(t));
    const float speed = glm::length(along), beyond = i == 0 ? -kOverlap : i == edges ? kOverlap : 0;
    const vec3 place = vec3(point) + (speed > 0 ? beyond * point.w / speed : 0) * along;
    const float radius = capillary.leaf && !capillary.joined && i == edges ? kPoint * point.w : point.w;
    const vec3 toEye = view.perspective * (view.eye - place) + (1 - view.perspective) * view.eye;
    vec3 side = glm::cross(along, toEye);
    const float length2 = glm::dot(side, side);
    side = length2 > 1e-20f ? side / std::sqrt(length2) : view.right;
    const float depth = std::max(glm::dot(vec3(view.depth), place) + view.depth.w, 1e-6f);
    const float pixel = depth / view.focal;
    const float half = std::max(radius, 0.5f * view.thinnest * pixel);
    const vec3 colour = glm::mix(from, to, t);
    const std::uint32_t packed = unorm8(colour.x) | unorm8(colour.y) << 8 | unorm8(colour.z) << 16 |
                                 unorm8(radius / half) << 24;
    for (int k = 0; k < 2; ++k) {
      const vec3 out = k == 0 ? side : -side;
      vertices[2 * i + std::uint32_t(k)] = {view.viewProjection * vec4(place + half * out, 1), packed,
                                            snorm16(glm::dot(out, view.right)) | snorm16(glm::dot(out, view.up)) << 16};
    }
  }
}

std::vector<std::uint32_t> ribbonIndices(std::uint32_t edges, std::uint32_t copies) {
  std::vector<std::uint32_t> indices;
  indices.reserve(std::size_t(6) * edges * copies);
  for (std::uint32_t copy = 0; copy < copies; ++copy)
    for (std::uint32_t edge = 0; edge < edges; ++edge) {
      const std::uint32_t v = 2 * (copy * (edges + 1) + edge);
      indices.insert(indices.end(), {v, v + 1, v + 2, v + 2, v + 1, v + 3});
    }
  return indices;
}

}  // namespace vasa
