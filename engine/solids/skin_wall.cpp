#include "solids/skin_wall.h"

#include <algorithm>
#include <array>

#include "body/skin_field.h"
#include "body/skin_shell.h"
#include "core/parallel.h"

namespace vasa {
namespace {

constexpr float kNearHeights = 0.012f;  // of the body's height: what lay deeper is not looked at
// [m] what is farther out has its skin in a fold, where a plane is no wall
constexpr float kFoldedSkin = 0.025f;
constexpr std::array<float, 3> kPlaces{0, 0.5f, 1};

}  // namespace

SkinWall::SkinWall(const Body& body, std::span<const Bezier> restTubes) {
  const SkinnedMesh* skin = skinOf(body);
  if (!skin) return;
  skin_.mesh.positions = skin->mesh.positions;
  skin_.influences = skin->influences;
  const SkinShell shell(skinAtRest(body));
  const float near = kNearHeights * body.height();
  std::vector<std::vector<Place>> found(restTubes.size());
  parallelFor(restTubes.size(), 16, [&](std::size_t tube) {
    for (const float s : kPlaces) {
      const vec4 ball = restTubes[tube].at(s);
      const SkinShell::Place at = shell.look(vec3(ball));
      if (at.triangle >= skin->mesh.triangles.size() || at.depth > near + ball.w) continue;
      found[tube].push_back(
          {std::uint32_t(tube), s, std::min(at.depth - ball.w, 0.0f), skin->mesh.triangles[at.triangle]});
    }
  });
  for (const auto& own : found) places_.insert(places_.end(), own.begin(), own.end());
}

void SkinWall::pose(std::span<const mat4> jointMatrices) {
  const auto posed = [&](std::uint32_t vertex) {
    const SkinInfluence& influence = skin_.influences[vertex];
    vec3 sum(0);
    for (std::size_t k = 0; k < 4; ++k)
      if (const float weight = influence.weights[int(k)]; weight > 0)
        sum += weight * vec3(jointMatrices[influence.joints[k]] * vec4(skin_.mesh.positions[vertex], 1));
    return sum;
  };
  parallelFor(places_.size(), 256, [&](std::size_t k) {
    Place& place = places_[k];
    const vec3 a = posed(place.triangle.x), b = posed(place.triangle.y), c = posed(place.triangle.z);
    const vec3 outwards = glm::cross(b - a, c - a);
    const float size = glm::length(outwards);
    place.point = (a + b + c) / 3.0f;
    place.inwards = size > 0 ? -outwards / size : vec3(0);
  });
}

void SkinWall::addContacts(std::span<const Bezier> tubes, std::uint32_t part,
                           std::vector<BoneContact>& contacts) const {
  for (const Place& place : places_) {
    const vec4 ball = tubes[place.tube].at(place.s);
    const float f = glm::dot(place.inwards, vec3(ball) - place.point) - ball.w;
    if (place.inwards == vec3(0) || f < place.allowed - kFoldedSkin) continue;
    const BoneContact contact{.tube = place.tube,
                              .part = part,
                              .s = place.s,
                              .f = f,
                              .allowed = place.allowed,
                              .point = place.point,
                              .normal = place.inwards,
                              .nearestPoint = place.point,
                              .nearestNormal = place.inwards};
    if (contact.enters()) contacts.push_back(contact);
  }
}

}  // namespace vasa
