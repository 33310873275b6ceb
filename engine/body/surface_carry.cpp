#include "body/surface_carry.h"

#include <fmt/format.h>

#include "body/deform.h"
#include "body/inside.h"
#include "body/skin_warp.h"
#include "core/parallel.h"
#include "mesh/weld.h"

namespace vasa {
namespace {

constexpr float kWeld = 1e-6f;         // [m] corners that are one
constexpr std::size_t kSamples = 400;  // of the points, asked whether they lie in the surface
constexpr float kMostOutside = 0.15f;  // of them, as between a body and its vessels

// Whole and outward.
TriangleMesh cleaned(const TriangleMesh& surface) {
  TriangleMesh mesh = weld(surface, kWeld);
  if (mesh.volume() < 0)
    for (uvec3& t : mesh.triangles) std::swap(t.y, t.z);
  return mesh;
}

float shareOutside(const SkinShell& shell, std::span<const vec4> points) {
  const std::size_t samples = std::min(points.size(), kSamples);
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
  out.fit = fitSurface(around.mesh(), skin);
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
  TriangleMesh placed = around.mesh();
  for (vec3& p : placed.positions) p = by(p);
  SkinWarp(std::move(placed), skin).run(carried.points);
  carried.pushedIn = moveInside(network, depths, skin, carried.bodyHeight, carried.points);
  pinEnds(network, carried.points);
  return out;
}

}  // namespace vasa
