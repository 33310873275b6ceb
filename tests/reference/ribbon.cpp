#include "reference/ribbon.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "growth/ribbon.h"

namespace vasa {
namespace {

constexpr float kOverlap = 0.5f;  // in radii, beyond the ends
constexpr float kVeil = 0.025f;   // [m] of tissue that takes half of the light
constexpr float kGrazing = 0.3f;  // least cosine between sight and skin: deeper ways are taken for this
constexpr float kDarkest = 0.7f;  // light and opacity that the deepest curves keep
constexpr float kFaintest = 0.35f;

std::uint32_t snorm16(float value) {
  return std::uint32_t(int(std::floor(std::clamp(value, -1.0f, 1.0f) * 32767.0f + 0.5f))) & 0xffffu;
}

std::uint32_t unorm8(float value) { return std::uint32_t(std::clamp(value, 0.0f, 1.0f) * 255.0f + 0.5f); }

vec3 rgbOf(std::uint32_t packed) {
  return vec3(float(packed & 0xffu), float(packed >> 8 & 0xffu), float(packed >> 16 & 0xffu)) / 255.0f;
}

// The curve where its polyline has a corner.
struct Corner {
  vec3 place, side;  // to the right of the curve as it is seen; unit
  vec3 normal;       // that it is lit by where it is thin: the skin's
  float reach;       // [m] of the ribbon to either side
  float thin;        // 0: the ribbon is as wide as it looks, 1: far thinner than a pixel
  std::uint32_t colour;
};

Corner cornerOf(const Capillary& capillary, const shared::GrowthView& view, std::uint32_t root, float t) {
  const vec4 point = capillary.curve.at(t);
  const vec3 along(capillary.curve.derivative(t));
  const float speed = glm::length(along), beyond = t == 0 ? -kOverlap : t == 1 ? kOverlap : 0;
  const vec3 place = vec3(point) + (speed > 0 ? beyond * point.w / speed : 0) * along;
  const vec3 toEye = view.perspective * (view.eye - place) + (1 - view.perspective) * view.eye;
  const vec3 side = glm::cross(along, toEye);
  const float length2 = glm::dot(side, side);
  const float depth = std::max(glm::dot(vec3(view.depth), place) + view.depth.w, 1e-6f);
  const float soft = shared::kSoftEdge * (depth / view.focal), reach = point.w + soft;
  // capillary.frag fades it over twice kSoftEdge pixels from the edge inward. Where it is narrower than that
  // it never gets whole and would cover (r + soft)² / (2 soft): the rest of 2 r is up to its opacity.
  const float opacity = point.w < soft ? 4 * point.w * soft / (reach * reach) : 1.0f;
  const vec3 outward = -vec3(capillary.skin);
  const float facing = glm::dot(outward, toEye) / std::max(glm::length(toEye), 1e-9f);
  const float way =
      std::max(glm::dot(vec3(capillary.skin), place) + capillary.skin.w, 0.0f) / std::max(facing, kGrazing);
  const float light = std::exp2(-way / kVeil) * std::clamp(facing + 1, 0.0f, 1.0f);
  const vec3 own =
      glm::mix(rgbOf(root), rgbOf(view.capillary), glm::mix(capillary.phase, capillary.lastPhase, t)) *
      (kDarkest + (1 - kDarkest) * light);
  return {place,
          length2 > 1e-20f ? side / std::sqrt(length2) : view.right,
          outward,
          reach,
          1 - opacity,
          unorm8(own.x) | unorm8(own.y) << 8 | unorm8(own.z) << 16 |
              unorm8(opacity * (kFaintest + (1 - kFaintest) * light)) << 24};
}

shared::CapillaryVertex vertexAt(const shared::GrowthView& view, const Corner& corner, float sign) {
  const vec3 out = sign * corner.side;
  const vec3 lit = out * (1 - corner.thin) + corner.normal * corner.thin;
  return {view.viewProjection * vec4(corner.place + corner.reach * out, 1), corner.colour,
          snorm16(glm::dot(lit, view.right)) | snorm16(glm::dot(lit, view.up)) << 16};
}

}  // namespace

void writeRibbon(const Capillary& capillary, const shared::GrowthView& view, std::uint32_t root,
                 std::uint32_t edges, std::span<shared::CapillaryVertex> vertices) {
  assert(vertices.size() == ribbonVertices(edges));
  for (std::uint32_t i = 0; i <= edges; ++i) {
    const Corner corner = cornerOf(capillary, view, root, float(i) / float(edges));
    vertices[2 * i] = vertexAt(view, corner, 1);
    vertices[2 * i + 1] = vertexAt(view, corner, -1);
  }
}

void writeThread(const Capillary& capillary, const shared::GrowthView& view, std::uint32_t root,
                 std::span<shared::CapillaryVertex> vertices) {
  assert(vertices.size() == shared::kThreadVertices);
  const std::uint32_t edges = capillary.leaf ? 1 : shared::kThreadEdges;
  writeRibbon(capillary, view, root, edges, vertices.first(2 * (edges + 1)));
  for (std::uint32_t v = 2 * (edges + 1); v < shared::kThreadVertices; ++v) vertices[v] = vertices[v - 2];
}

}  // namespace vasa
