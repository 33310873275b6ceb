#include "body/limb_flesh.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

#include "body/skinning.h"
#include "core/ids.h"

namespace vasa {
namespace {

// The skin at a place is a joint's where it has this share of its weights at least: at a hip two joints have
// half of it each.
constexpr float kMoves = 0.25f;
// [m] Between places: a finger has two around, a calf ten.
constexpr float kArmSpacing = 0.02f, kLegSpacing = 0.03f;
constexpr int kMostCuts = 16;  // of a triangle: longer ones are none of a limb

float weightOn(const SkinInfluence& influence, auto&& counts) {
  float sum = 0;
  for (int k = 0; k < 4; ++k)
    if (counts(influence.joints[std::size_t(k)])) sum += influence.weights[k];
  return sum;
}

TriangleMesh skinWithout(const Body& body, const SkinnedMesh& skin, const std::vector<char>& leftOut) {
  TriangleMesh mesh = meshAtRest(body, skin);
  const auto isOut = [&](std::uint32_t v) {
    return weightOn(skin.influences[v], [&](std::size_t j) { return leftOut[j] != 0; }) > 0.5f;
  };
  std::erase_if(mesh.triangles, [&](const uvec3& t) { return isOut(t.x) && isOut(t.y) && isOut(t.z); });
  return mesh;
}

// Where a triangle is the first to reach a cell of the grid.
void addPlaces(const SkinnedMesh& skin, const uvec3& t, float spacing,
               std::set<std::tuple<int, int, int>>& taken, std::vector<LimbPlaces::Place>& places) {
  const auto& p = skin.mesh.positions;
  const float longest =
      std::max({glm::distance(p[t.x], p[t.y]), glm::distance(p[t.y], p[t.z]), glm::distance(p[t.z], p[t.x])});
  const int cuts = std::clamp(int(std::ceil(longest / spacing)), 1, kMostCuts);
  for (int i = 0; i <= cuts; ++i)
    for (int j = 0; i + j <= cuts; ++j) {
      const vec3 shares = vec3(float(i), float(j), float(cuts - i - j)) / float(cuts);
      const vec3 cell = glm::floor((shares.x * p[t.x] + shares.y * p[t.y] + shares.z * p[t.z]) / spacing);
      if (taken.emplace(int(cell.x), int(cell.y), int(cell.z)).second) places.push_back({t, shares});
    }
}

// @param upper, lower, root  its parts, without their side; its places follow the root and what hangs on it
// @param from     where they begin, by the upper part's length
// @param spacing  [m]
std::vector<LimbPlaces> limbsOf(const Body& body, const SkinnedMesh& skin, const Rig& rig,
                                const std::string& upper, const std::string& lower, const std::string& root,
                                float from, float spacing) {
  std::vector<LimbPlaces> limbs;
  const TriangleMesh mesh = meshAtRest(body, skin);
  for (const std::string side : {"left", "right"}) {
    const std::uint32_t top = rig.partNamed(side + upper), middle = rig.partNamed(side + lower);
    if (top == kNone || middle == kNone || !hangsOn(rig.parents, middle, top)) continue;
    const std::uint32_t first = rig.partNamed(side + root);
    const float least = from * glm::distance(rig.centres[top], rig.centres[middle]);
    const auto isPlace = [&](std::uint32_t v) {
      return glm::distance(mesh.positions[v], rig.centres[top]) >= least &&
             weightOn(skin.influences[v],
                      [&](std::size_t j) { return hangsOn(rig.parents, std::uint32_t(j), first); }) > 0.5f;
    };
    LimbPlaces limb{.top = {top}, .other = {}, .places = {}, .atRest = {}};
    std::set<std::tuple<int, int, int>> taken;
    for (const uvec3& t : skin.mesh.triangles)
      if (isPlace(t.x) && isPlace(t.y) && isPlace(t.z)) addPlaces(skin, t, spacing, taken, limb.places);
    limbs.push_back(std::move(limb));
  }
  if (limbs.size() == 2) limbs[0].other = limbs[1].top, limbs[1].other = limbs[0].top;
  return limbs;
}

}  // namespace

Flesh::Flesh(const Body& body, const SkinnedMesh& skin, const std::vector<char>& leftOut)
    : influences_(skin.influences), shell_(skinWithout(body, skin, leftOut)) {
  std::vector<Aabb> boxes(body.skeleton.joints.size());
  for (const uvec3& t : shell_.mesh().triangles)
    for (int k = 0; k < 3; ++k)
      for (int i = 0; i < 4; ++i)
        if (influences_[t[k]].weights[i] >= kMoves)
          boxes[influences_[t[k]].joints[std::size_t(i)]].add(shell_.mesh().positions[t[k]]);
  for (std::uint32_t j = 0; j < boxes.size(); ++j)
    if (!boxes[j].empty() && !leftOut[j]) hosts_.push_back({j, boxes[j], body.skeleton.joints[j].restWorld});
}

std::vector<mat4> Flesh::toRest(const Pose& pose) const {
  std::vector<mat4> all;
  for (const Host& host : hosts_) all.push_back(host.restWorld * glm::inverse(pose.world[host.joint]));
  return all;
}

float Flesh::weightOf(std::uint32_t joint, std::uint32_t triangle) const {
  const uvec3& t = shell_.mesh().triangles[triangle];
  float sum = 0;
  for (int k = 0; k < 3; ++k) sum += weightOn(influences_[t[k]], [&](std::size_t j) { return j == joint; });
  return sum / 3;
}

void Flesh::lookFrom(std::size_t host, const mat4& toRest, vec3 place, Depth& found) const {
  const vec3 atRest(toRest * vec4(place, 1));
  if (!std::isfinite(glm::dot(atRest, atRest))) return;  // a joint that a clip scales to nothing
  if (const float aside = hosts_[host].box.distance(atRest); aside > 0) {
    found.depth = std::max(found.depth, -aside);
    return;
  }
  const SkinShell::Place at = shell_.look(atRest);
  if (weightOf(hosts_[host].joint, at.triangle) < kMoves)
    found.depth = std::max(found.depth, std::min(at.depth, 0.0f));
  else if (at.depth > found.depth)
    found = {at.depth, directionOf(at.normal * mat3(toRest))};  // the inverse's transpose
}

Flesh::Depth Flesh::look(std::span<const mat4> toRest, vec3 place) const {
  Depth found;
  for (std::size_t h = 0; h < hosts_.size(); ++h) lookFrom(h, toRest[h], place, found);
  return found;
}

std::vector<float> Flesh::depths(std::span<const mat4> toRest, std::span<const vec3> places) const {
  Aabb box;
  for (const vec3& place : places) box.add(place);
  const vec3 centre = box.centre();
  const float radius = glm::length(box.extent()) / 2;
  Depth far;  // of joints that no place is near to: at least as far away
  std::vector<std::size_t> near;
  for (std::size_t h = 0; h < hosts_.size(); ++h) {
    const float aside = hosts_[h].box.distance(vec3(toRest[h] * vec4(centre, 1))) - radius;
    if (aside > 0)
      far.depth = std::max(far.depth, -aside);
    else
      near.push_back(h);
  }
  std::vector<float> out;
  for (const vec3& place : places) {
    Depth found = far;
    for (const std::size_t h : near) lookFrom(h, toRest[h], place, found);
    out.push_back(found.depth);
  }
  return out;
}

std::vector<vec3> LimbPlaces::posed(const SkinnedMesh& skin, std::span<const mat4> skinMatrices) const {
  const auto vertex = [&](std::uint32_t v) { return skinnedPosition(skin, skinMatrices, v); };
  std::vector<vec3> out;
  for (const Place& place : places)
    out.push_back(place.shares.x * vertex(place.corners.x) + place.shares.y * vertex(place.corners.y) +
                  place.shares.z * vertex(place.corners.z));
  return out;
}

std::vector<LimbPlaces> armPlaces(const Body& body, const SkinnedMesh& skin, const Rig& rig) {
  return limbsOf(body, skin, rig, "UpperArm", "LowerArm", "LowerArm", 0, kArmSpacing);
}

std::vector<LimbPlaces> legPlaces(const Body& body, const SkinnedMesh& skin, const Rig& rig) {
  return limbsOf(body, skin, rig, "UpperLeg", "LowerLeg", "UpperLeg", 0.5f, kLegSpacing);
}

std::vector<char> hangingOn(const Rig& rig, std::span<const LimbPlaces> limbs) {
  std::vector<char> hanging(rig.parents.size(), 0);
  for (std::uint32_t j = 0; j < hanging.size(); ++j)
    for (const LimbPlaces& limb : limbs)
      if (hangsOn(rig.parents, j, limb.top.value)) hanging[j] = 1;
  return hanging;
}

}  // namespace vasa
