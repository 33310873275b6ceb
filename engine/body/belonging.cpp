#include "body/belonging.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "body/skin_field.h"
#include "body/skin_shell.h"
#include "math/closest_point.h"

namespace vasa {
namespace {

constexpr float kOutsideHeights = 0.01f;
constexpr float kFarHeights = 0.15f;

bool farFromLinks(const SpineSet& spines, vec3 p, float margin) {
  for (const SpineJoint& joint : spines.joints) {
    const vec3 from = joint.parent.valid() ? spines.joints[joint.parent.value].centre : joint.centre;
    const vec3 nearest = glm::mix(from, joint.centre, closestOnSegment(p, from, joint.centre));
    if (glm::distance(nearest, p) <= margin) return false;
  }
  return true;
}

}  // namespace

Result<float> checkBelongs(const Body& body, const SpineSet& spines, std::span<const vec4> points,
                           std::string_view name) {
  const float height = body.height();
  const SkinnedMesh* skin = skinOf(body);
  if (!skin && spines.joints.size() == 1) return 0.0f;  // one joint turns nothing: no place is wrong
  const std::size_t samples = std::min(points.size(), kPlacesAsked);
  std::optional<SkinShell> shell;
  if (skin) shell.emplace(skin->mesh);
  const auto outsideSkin = [&](vec3 p) {
    return !shell->contains(p) && std::abs(shell->look(p).depth) > kOutsideHeights * height;
  };
  std::size_t outside = 0;
  for (std::size_t i = 0; i < samples; ++i) {
    const vec3 p(points[i * points.size() / samples]);
    outside += skin ? outsideSkin(p) : farFromLinks(spines, p, kFarHeights * height);
  }
  const float share = float(outside) / float(samples);
  if (share <= kMostOutside) return share;
  return badInput(fmt::format(
      "{}: these vessels do not belong to the body {}: {:.0f} % of them lie {} at rest. Choose the body that they "
      "were made for; vasa fit carries them from that one to this, vasa place moves what stands elsewhere, and vasa "
      "render FILE.vasa draws them without a body (vasa help bodies)",
      name, body.name, 100 * share, skin ? "outside its skin" : "far from all of its joints"));
}

Result<void> checkNear(const Body& body, std::span<const vec4> points, std::string_view name) {
  Aabb box;
  for (const Skeleton::Joint& joint : body.skeleton.joints) box.add(vec3(joint.restWorld[3]));
  const float most = kFarHeights * body.height();
  std::size_t outside = 0;
  float farthest = 0;
  for (const vec4& point : points) {
    const float off = box.distance(vec3(point));
    outside += off > most;
    farthest = std::max(farthest, off);
  }
  if (float(outside) <= kMostOutside * float(points.size())) return {};
  return badInput(fmt::format(
      "{}: {:.0f} % of these vessels' points lie up to {:.2g} m outside the body {}: in another unit (vasa convert --unit "
      "makes a network that knows its own), or in another place (vasa place moves it)",
      name, 100 * float(outside) / float(points.size()), farthest, body.name));
}

}  // namespace vasa
