#include "growth/ribbon.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace vasa {
namespace {

constexpr float kOverlap = 0.5f;  // in radii, beyond the ends
constexpr float kPoint = 0.3f;    // width of a leaf's end
// Opacity of a leaf's thread: two triangles cover two thirds of what six do, and hide less of one another.
constexpr float kLeafThread = 1.25f;

std::uint32_t snorm16(float value) {
  return std::uint32_t(int(std::floor(std::clamp(value, -1.0f, 1.0f) * 32767.0f + 0.5f))) & 0xffffu;
}

std::uint32_t unorm8(float value) { return std::uint32_t(std::clamp(value, 0.0f, 1.0f) * 255.0f + 0.5f); }

vec3 rgbOf(std::uint32_t packed) {
  return vec3(float(packed & 0xffu), float(packed >> 8 & 0xffu), float(packed >> 16 & 0xffu)) / 255.0f;
}

// A curve's colours at its two ends.
struct Tints {
  vec3 from, to;
};

Tints tintsOf(const Capillary& capillary, const shared::GrowthView& view, std::uint32_t root,
              std::uint32_t far) {
  const vec3 bed = rgbOf(view.capillary);
  return {glm::mix(rgbOf(root), bed, capillary.phase),
          capillary.joined ? glm::mix(rgbOf(far), bed, capillary.farPhase)
                           : glm::mix(rgbOf(root), bed, capillary.phaseAt(1))};
}

// The curve where its polyline's i-th corner is.
struct Corner {
  vec3 place, side;  // to the right of the curve as it is seen; unit
  float half;        // [m] of the width
  std::uint32_t colour;
};

Corner cornerOf(const Capillary& capillary, const shared::GrowthView& view, const Tints& tints,
                std::uint32_t i, std::uint32_t edges, float opacity) {
  const float t = float(i) / float(edges);
  const vec4 point = capillary.curve.at(t);
  const vec3 along(capillary.curve.derivative(t));
  const float speed = glm::length(along), beyond = i == 0 ? -kOverlap : i == edges ? kOverlap : 0;
  const vec3 place = vec3(point) + (speed > 0 ? beyond * point.w / speed : 0) * along;
  const float radius = capillary.leaf && !capillary.joined && i == edges ? kPoint * point.w : point.w;
  const vec3 toEye = view.perspective * (view.eye - place) + (1 - view.perspective) * view.eye;
  const vec3 side = glm::cross(along, toEye);
  const float length2 = glm::dot(side, side);
  const float depth = std::max(glm::dot(vec3(view.depth), place) + view.depth.w, 1e-6f);
  const float pixel = depth / view.focal;
  const float half = std::max(radius, 0.5f * view.thinnest * pixel);
  const vec3 colour = glm::mix(tints.from, tints.to, t);
  return {place, length2 > 1e-20f ? side / std::sqrt(length2) : view.right, half,
          unorm8(colour.x) | unorm8(colour.y) << 8 | unorm8(colour.z) << 16 |
              unorm8(opacity * (radius / half)) << 24};
}

shared::CapillaryVertex vertexAt(const shared::GrowthView& view, const Corner& corner, float sign) {
  const vec3 out = sign * corner.side;
  return {view.viewProjection * vec4(corner.place + corner.half * out, 1), corner.colour,
          snorm16(glm::dot(out, view.right)) | snorm16(glm::dot(out, view.up)) << 16};
}

}  // namespace

void writeRibbon(const Capillary& capillary, const shared::GrowthView& view, std::uint32_t root,
                 std::uint32_t far, std::uint32_t edges, std::span<shared::CapillaryVertex> vertices) {
  assert(vertices.size() == ribbonVertices(edges));
  const Tints tints = tintsOf(capillary, view, root, far);
  for (std::uint32_t i = 0; i <= edges; ++i) {
    const Corner corner = cornerOf(capillary, view, tints, i, edges, 1);
    vertices[2 * i] = vertexAt(view, corner, 1);
    vertices[2 * i + 1] = vertexAt(view, corner, -1);
  }
}

void writeThread(const Capillary& capillary, const shared::GrowthView& view, std::uint32_t root,
                 std::uint32_t far, std::span<shared::CapillaryVertex> vertices) {
  assert(vertices.size() == shared::kThreadVertices);
  const Tints tints = tintsOf(capillary, view, root, far);
  const float ends = capillary.leaf ? -1.0f : 1.0f;  // on which side the two outermost vertices are
  for (std::uint32_t i = 0; i <= shared::kThreadEdges; ++i) {
    const Corner corner =
        cornerOf(capillary, view, tints, i, shared::kThreadEdges, capillary.leaf ? kLeafThread : 1);
    vertices[i + 1] = vertexAt(view, corner, i % 2 == 0 ? -1.0f : 1.0f);
    if (i == 0) vertices[0] = vertexAt(view, corner, ends);
    if (i == shared::kThreadEdges) vertices[i + 2] = vertexAt(view, corner, -ends);
  }
}

std::vector<std::uint32_t> ribbonIndices(std::uint32_t edges, std::uint32_t copies) {
  std::vector<std::uint32_t> indices;
  indices.reserve(std::size_t(3) * ribbonTriangles(edges) * copies);
  for (std::uint32_t copy = 0; copy < copies; ++copy)
    for (std::uint32_t k = 0; k < ribbonTriangles(edges); ++k) {
      const std::uint32_t v = copy * ribbonVertices(edges) + k, odd = k % 2;
      indices.insert(indices.end(), {v + odd, v + 1 - odd, v + 2});  // all wind alike
    }
  return indices;
}

}  // namespace vasa
