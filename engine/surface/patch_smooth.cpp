#include "surface/patch_smooth.h"

#include <algorithm>

#include "surface/octahedral.h"
#include "surface/reference.h"

// The specification of shaders/patch_strain.comp and shaders/patch_smooth.comp: same operations in the same
// order. All vertices move at once (Jacobi), so that their order does not matter.
namespace vasa {
namespace {

constexpr float kLeastStrain = 1.0f, kFullStrain = 2.0f;  // of the rings' radii
constexpr float kSpared = 0.6f;      // of its size at rest: a larger triangle moves no corner
constexpr float kMiddleStep = 0.6f;  // of the way to the neighbours' middle
// Times the share that is pressed: vertices are free to move as far as they like.
constexpr float kFreedSoon = 4;
constexpr float kSameSide = 0.8f;     // cosine: a normal that is so near to the surface's stays
constexpr float kLeastArea = 1e-12f;  // [m2]

float ramp(float x) { return glm::smoothstep(0.0f, 1.0f, x); }

vec3 carried(const shared::JointRows& joint, vec3 p) {
  const auto row = [p](const vec4& r) { return r.x * p.x + r.y * p.y + r.z * p.z + r.w; };
  return {row(joint.row0), row(joint.row1), row(joint.row2)};
}

float sizeOf(vec3 d) { return std::sqrt(dotOf(d, d)); }

// How far two rings' maps differ about their centres, in radii.
float disagreement(const shared::PatchSeam& a, const shared::JointRows& byA, const shared::PatchSeam& b,
                   const shared::JointRows& byB) {
  const float apart = sizeOf(carried(byA, a.centre) - carried(byB, a.centre)) +
                      sizeOf(carried(byA, b.centre) - carried(byB, b.centre));
  return apart / (a.radius + b.radius);
}

std::span<const shared::FanTriangle> fanOf(const PatchTable& table, std::uint32_t vertex) {
  return std::span(table.fans)
      .subspan(table.firstFan[vertex], table.firstFan[vertex + 1] - table.firstFan[vertex]);
}

// How much a vertex is pressed, and the middle of its neighbours.
struct Pressed {
  float share;
  vec3 middle;
};

Pressed pressedAt(std::span<const shared::FanTriangle> fan, std::span<const SurfacePoint> points,
                  const SurfacePoint& own) {
  vec3 sum(0);
  float least = 3e38f;
  for (const shared::FanTriangle& triangle : fan) {
    const vec3 a = points[triangle.corners & 0xffffu].position, b = points[triangle.corners >> 16].position;
    least =
        std::min(least, dotOf(glm::cross(a - own.position, b - own.position), own.normal) * triangle.perArea);
    sum += a + b;
  }
  return {1.0f - ramp(least / kSpared), sum / float(2 * fan.size())};
}

// Which vertices may move, and how much: those that are pressed before any step, and their neighbours.
std::vector<float> freed(const PatchTable& table, const PatchTable::Patch& patch,
                         std::span<const SurfacePoint> points) {
  std::vector<float> pressed(patch.vertexCount), most(patch.vertexCount);
  for (std::uint32_t v = 0; v < patch.vertexCount; ++v)
    if (const auto fan = fanOf(table, patch.firstVertex + v); !fan.empty())
      pressed[v] = pressedAt(fan, points, points[v]).share;
  for (std::uint32_t v = 0; v < patch.vertexCount; ++v) {
    float share = pressed[v];
    const auto fan = fanOf(table, patch.firstVertex + v);
    for (const shared::FanTriangle& triangle : fan)
      share = std::max(share, std::max(pressed[triangle.corners & 0xffffu], pressed[triangle.corners >> 16]));
    if (!fan.empty()) most[v] = std::min(kFreedSoon * share, 1.0f);
  }
  return most;
}

vec3 turned(std::span<const shared::FanTriangle> fan, float share, std::span<const SurfacePoint> points,
            const SurfacePoint& own) {
  vec3 sum(0);
  for (const shared::FanTriangle& triangle : fan)
    sum += glm::cross(points[triangle.corners & 0xffffu].position - own.position,
                      points[triangle.corners >> 16].position - own.position);
  const vec3 surface = unitOr(sum, own.normal);
  const float away = share * ramp(1.0f - dotOf(surface, own.normal) / kSameSide);
  return unitOr(own.normal + away * (surface - own.normal), own.normal);
}

}  // namespace

void addFans(PatchTable& table) {
  table.firstFan.assign(table.vertices.size() + 1, 0);
  const auto positionOf = [&](std::uint32_t vertex) {
    const shared::SkinVertex& v = table.vertices[vertex];
    return vec3(v.x, v.y, v.z);
  };
  std::vector<std::uint32_t> count, next;
  for (const PatchTable::Patch& patch : table.patches) {
    const std::span triangles = std::span(table.triangles).subspan(patch.firstTriangle, patch.triangleCount);
    count.assign(patch.vertexCount, 0);
    next.assign(patch.vertexCount, 0);
    for (const uvec3& t : triangles)
      for (int k = 0; k < 3; ++k) ++count[t[k] - patch.firstVertex];
    std::uint32_t onLoops = 0;
    for (std::uint32_t s = 0; s < patch.seamCount; ++s) onLoops += table.seams[patch.firstSeam + s].loopCount;
    const bool tooLarge = patch.vertexCount > shared::kMostSmoothed;
    for (std::uint32_t v = 0; v < patch.vertexCount; ++v)
      if (tooLarge || v < onLoops || count[v] > shared::kMostFan) count[v] = 0;
    std::uint32_t first = std::uint32_t(table.fans.size());
    for (std::uint32_t v = 0; v < patch.vertexCount; ++v) {
      next[v] = table.firstFan[patch.firstVertex + v] = first;
      first += count[v];
    }
    table.fans.resize(first);
    // Vertices between this patch and the next one fill a block.
    std::fill(table.firstFan.begin() + patch.firstVertex + patch.vertexCount, table.firstFan.end(), first);
    for (const uvec3& t : triangles)
      for (int k = 0; k < 3; ++k) {
        const std::uint32_t own = t[k], a = t[(k + 1) % 3], b = t[(k + 2) % 3], v = own - patch.firstVertex;
        if (count[v] == 0) continue;
        const vec3 at = positionOf(own);
        const float area = sizeOf(glm::cross(positionOf(a) - at, positionOf(b) - at));
        table.fans[next[v]++] = {(a - patch.firstVertex) | (b - patch.firstVertex) << 16,
                                 1.0f / std::max(area, kLeastArea)};
      }
  }
}

float patchSmoothing(const PatchTable& table, const PatchTable::Patch& patch,
                     std::span<const shared::JointRows> seams) {
  float most = 0;
  for (std::uint32_t i = patch.firstSeam; i < patch.firstSeam + patch.seamCount; ++i)
    for (std::uint32_t j = i + 1; j < patch.firstSeam + patch.seamCount; ++j)
      most = std::max(most, disagreement(table.seams[i], seams[i], table.seams[j], seams[j]));
  return ramp((most - kLeastStrain) / (kFullStrain - kLeastStrain));
}

void smoothPatch(const PatchTable& table, const PatchTable::Patch& patch, float share,
                 std::span<SurfacePoint> vertices) {
  std::vector<SurfacePoint> from(vertices.begin(), vertices.end()), to = from;
  // As it is stored between.
  for (SurfacePoint& point : from) point.normal = unpackOctahedral(packOctahedral(point.normal));
  const std::vector<float> free = freed(table, patch, from);
  to = from;
  for (std::uint32_t step = 0; step < shared::kPatchSteps; ++step) {
    for (std::uint32_t v = 0; v < patch.vertexCount; ++v) {
      if (free[v] == 0) continue;
      const Pressed pressed = pressedAt(fanOf(table, patch.firstVertex + v), from, from[v]);
      const float part = share * kMiddleStep * pressed.share * free[v];
      to[v].position = from[v].position + part * (pressed.middle - from[v].position);
    }
    from.swap(to);
  }
  for (std::uint32_t v = 0; v < patch.vertexCount; ++v)
    if (free[v] > 0)
      vertices[v] = {from[v].position,
                     turned(fanOf(table, patch.firstVertex + v), share * free[v], from, from[v])};
}

std::vector<SurfacePoint> posePatch(const PatchTable& table, const PatchTable::Patch& patch,
                                    std::span<const shared::JointRows> seams) {
  std::vector<SurfacePoint> points;
  for (std::uint32_t i = patch.firstVertex; i < patch.firstVertex + patch.vertexCount; ++i)
    points.push_back(poseVertex(table.vertices[i], seams));
  if (const float share = patchSmoothing(table, patch, seams); share > 0)
    smoothPatch(table, patch, share, points);
  return points;
}

}  // namespace vasa
