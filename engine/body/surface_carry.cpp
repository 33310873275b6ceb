#include "body/surface_carry.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "body/belonging.h"
#include "body/deform.h"
#include "body/inside.h"
#include "body/skin_warp.h"
#include "core/log.h"
#include "core/name_words.h"
#include "core/parallel.h"
#include "mesh/weld.h"

namespace vasa {
namespace {

constexpr float kWeld = 1e-6f;        // [m] corners that are one
constexpr float kCutMargin = 0.005f;  // of the surface's height
constexpr float kLevel = 0.97f;       // least cosine of a cut to the axis
constexpr float kMostOnOtherSide = 0.5f;
constexpr float kNearMiddle = 0.04f;  // of the body's height
// Another person's trunk comes to 0.8 and more, an arm in another person's leg to 0.77.
constexpr float kSureSurfaceShare = 0.9f;
constexpr float kClearlyLess =
    0.05f;  // of a fit's cost: a twentieth of the surface, which no noise makes up for

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

// Places of vessels whose names say on which side of the body they are. Some of the trunk's lie on the other,
// near the middle (the left hepatic artery): farther off none does.
class Sides {
 public:
  Sides(const Network& network, const SkinShell& skin) {
    const Aabb box = skin.mesh().bounds();
    middle_ = 0.5f * (box.low.x + box.high.x);
    margin_ = kNearMiddle * box.extent().y;
    std::vector<Place> all;
    for (const Vessel& vessel : network.vessels()) {
      const NamedSide side = sideNamed(vessel.name);
      if (side == NamedSide::none) continue;
      for (const vec4& p : network.pointsOf(vessel))
        all.push_back({vec3(p), side == NamedSide::left ? 1.0f : -1.0f});
    }
    const std::size_t asked = std::min(all.size(), kPlacesAsked);
    for (std::size_t i = 0; i < asked; ++i) places_.push_back(all[i * all.size() / asked]);
  }

  bool known() const { return !places_.empty(); }
  float shareOnOtherSide(const Similarity& by) const {
    const auto wrong = std::ranges::count_if(
        places_, [&](const Place& own) { return own.side * (by(own.at).x - middle_) < -margin_; });
    return known() ? float(wrong) / float(places_.size()) : 0;
  }
  void mirror() {
    for (Place& own : places_) own.at.x = -own.at.x;
  }

 private:
  struct Place {
    vec3 at;
    float side;  // +1 left, -1 right
  };
  std::vector<Place> places_;
  float middle_ = 0, margin_ = 0;
};

SurfaceFit fitBySides(const TriangleMesh& surface, const Sides& sides, const SkinShell& skin) {
  return fitSurface(surface, skin, [&](const Similarity& by) { return sides.shareOnOtherSide(by); });
}

bool isMirrored(TriangleMesh surface, Sides sides, const SkinShell& skin, const SurfaceFit& fit) {
  if (!sides.known() || fit.cost <= kClearlyLess) return false;
  for (vec3& p : surface.positions) p.x = -p.x;
  for (uvec3& t : surface.triangles) std::swap(t.y, t.z);
  sides.mirror();
  return fitBySides(surface, sides, skin).cost + kClearlyLess < fit.cost;
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
  const Sides sides(network, skin);
  out.fit = fitBySides(placed, sides, skin);
  if (out.fit.share < kLeastSurfaceShare)
    return badInput(fmt::format(
        "{} is not found in the skin of {}: {:.0f} % of it at the most lie near it ({:.0f} % are asked for). It must be "
        "the skin of a person or of a part of one, upright (--up), in its unit (--unit); vasa place puts the network "
        "there by landmarks",
        surfaceName, to.name, 100 * out.fit.share, 100 * kLeastSurfaceShare));

  const Similarity& by = out.fit.by;
  if (const float wrong = sides.shareOnOtherSide(by); wrong > kMostOnOtherSide)
    return badInput(fmt::format(
        "{}: of vessels that are called left or right {:.0f} % would lie on the other side of {}, where {} fits best: turn the "
        "sign of one axis of the vessels, or mend their names",
        name, 100 * wrong, to.name, surfaceName));
  if (isMirrored(placed, sides, skin, out.fit))
    return badInput(fmt::format(
        "{} and {} are mirror images: they fit {} by shape and by names (left, right) once they are mirrored. Export both "
        "again with the sign of one axis turned",
        surfaceName, name, to.name));
  if (out.fit.share < kSureSurfaceShare)
    logWarning(fmt::format(
        "{}: only {:.0f} % of it lie near the skin of {} where it fits best: look whether that is the "
        "place (vasa render --body --network), or place the vessels by landmarks (vasa place)",
        surfaceName, 100 * out.fit.share, to.name));
  CarriedNetwork& carried = out.network;
  carried.radiusFactor = by.scale;
  carried.bodyHeight = to.height();
  for (const vec4& p : network.points()) carried.points.push_back(vec4(by(vec3(p)), by.scale * p.w));
  std::vector<float> depths(carried.points.size());
  parallelFor(depths.size(), 32,
              [&](std::size_t i) { depths[i] = by.scale * around.look(vec3(network.points()[i])).depth; });
  for (vec3& p : placed.positions) p = by(p);
  SkinWarp(std::move(placed), skin, skin.mesh().bounds().extent().y).run(carried.points);
  carried.pushedIn = moveInside(network, depths, skin, carried.bodyHeight, carried.points);
  pinEnds(network, carried.points);
  return out;
}

}  // namespace vasa
