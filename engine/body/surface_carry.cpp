#include "body/surface_carry.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "body/belonging.h"
#include "body/deform.h"
#include "body/inside.h"
#include "body/skin_warp.h"
#include "core/parallel.h"
#include "mesh/weld.h"

namespace vasa {
namespace {

constexpr float kWeld = 1e-6f;        // [m] corners that are one
constexpr float kCutMargin = 0.005f;  // of the surface's height
constexpr float kLevel = 0.97f;       // least cosine of a cut to the axis

// Whole and outward. The volume is taken about the middle, so that an open end does not tell its sign.
TriangleMesh cleaned(const TriangleMesh& surface) {
  TriangleMesh mesh = weld(surface, kWeld), centred = mesh;
  const Aabb box = mesh.bounds();
  for (vec3& p : centred.positions) p -= 0.5f * (box.low + box.high);
  if (centred.volume() < 0)
    for (uvec3& t : mesh.triangles) std::swap(t.y, t.z);
  return mesh;
}

// Without the faces that close a part where the scan ends, level and at its very top or bottom: no skin is
// like them.
TriangleMesh withoutCuts(const TriangleMesh& mesh) {
  const Aabb box = mesh.bounds();
  const float margin = kCutMargin * (box.high.y - box.low.y);
  TriangleMesh open{mesh.positions, {}};
  for (const uvec3& t : mesh.triangles) {
    const vec3 a = mesh.positions[t.x], b = mesh.positions[t.y], c = mesh.positions[t.z];
    const bool top = std::min({a.y, b.y, c.y}) > box.high.y - margin,
               bottom = std::max({a.y, b.y, c.y}) < box.low.y + margin;
    const vec3 normal = glm::cross(b - a, c - a);
    if ((top || bottom) && std::abs(normal.y) > kLevel * glm::length(normal)) continue;
    open.triangles.push_back(t);
  }
  return weld(open, 0);
}

float shareOutside(const SkinShell& shell, std::span<const vec4> points) {
  const std::size_t samples = std::min(points.size(), kPlacesAsked);
  std::size_t outside = 0;
  for (std::size_t i = 0; i < samples; ++i)
    outside += !shell.contains(vec3(points[i * points.size() / samples]));
  return samples ? float(outside) / float(samples) : 0;
}

}  // namespace

Result<SurfaceCarried> carryBySurface(const Network& network, const TriangleMesh& surface, const Body& to,
                                      const std::string& name, const std::string& surfaceName) {
  TriangleMesh target = skinAtRest(to);
  if (target.empty())
    return badInput(to.name + " has no skin that " + surfaceName +
                    " could be found in; vasa place puts the network there by landmarks");
  const SkinShell around(cleaned(surface));
  if (const float outside = shareOutside(around, network.points()); outside > kMostOutside)
    return badInput(
        fmt::format("{}: {:.0f} % of these vessels lie outside {}; both must be in the same space, "
                    "in the same unit and with the same axis up (--unit, --up)",
                    name, 100 * outside, surfaceName));
  const SkinShell skin(std::move(target));
  SurfaceCarried out;
  TriangleMesh placed = withoutCuts(around.mesh());
  out.fit = fitSurface(placed, skin);
  if (out.fit.share < kLeastSurfaceShare)
    return badInput(fmt::format(
        "{} is not found in the skin of {}: {:.0f} % of it at the most lie near it ({:.0f} % are asked for). It must be "
        "the skin of a person or of a part of one, upright (--up), in its unit (--unit); vasa place puts the network "
        "there by landmarks",
        surfaceName, to.name, 100 * out.fit.share, 100 * kLeastSurfaceShare));

  const Similarity& by = out.fit.by;
  CarriedNetwork& carried = out.network;
  carried.radiusFactor = by.scale;
  carried.bodyHeight = to.height();
  for (const vec4& p : network.points()) carried.points.push_back(vec4(by(vec3(p)), by.scale * p.w));
  std::vector<float> depths(carried.points.size());
  parallelFor(depths.size(), 32,
              [&](std::size_t i) { depths[i] = by.scale * around.look(vec3(network.points()[i])).depth; });
  for (vec3& p : placed.positions) p = by(p);
  SkinWarp(std::move(placed), skin).run(carried.points);
  carried.pushedIn = moveInside(network, depths, skin, carried.bodyHeight, carried.points);
  pinEnds(network, carried.points);
  return out;
}

}  // namespace vasa
