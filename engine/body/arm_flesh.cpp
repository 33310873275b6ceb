#include "body/arm_flesh.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

#include "body/rig.h"
#include "body/skinning.h"
#include "core/ids.h"

namespace vasa {
namespace {

// The skin at a place is a joint's where it has this share of its weights at least: at a hip two joints have
// half of it each.
constexpr float kMoves = 0.25f;
constexpr float kSpacing = 0.02f;  // [m] between places on an arm: a finger has two around
constexpr int kMostCuts = 16;      // of a triangle: longer ones are none of an arm

float weightOn(const SkinInfluence& influence, auto&& counts) {
  float sum = 0;
  for (int k = 0; k < 4; ++k)
    if (counts(influence.joints[std::size_t(k)])) sum += influence.weights[k];
  return sum;
}

TriangleMesh withoutArms(const Body& body, const SkinnedMesh& skin, const std::vector<char>& armJoints) {
  TriangleMesh mesh = meshAtRest(body, skin);
  const auto onArm = [&](std::uint32_t v) {
    return weightOn(skin.influences[v], [&](std::size_t j) { return armJoints[j] != 0; }) > 0.5f;
  };
  std::erase_if(mesh.triangles, [&](const uvec3& t) { return onArm(t.x) && onArm(t.y) && onArm(t.z); });
  return mesh;
}

// Where a triangle is the first to reach a cell of the grid.
void addPlaces(const SkinnedMesh& skin, const uvec3& t, std::set<std::tuple<int, int, int>>& taken,
               std::vector<ArmPlaces::Place>& places) {
  const auto& p = skin.mesh.positions;
  const float longest =
      std::max({glm::distance(p[t.x], p[t.y]), glm::distance(p[t.y], p[t.z]), glm::distance(p[t.z], p[t.x])});
  const int cuts = std::clamp(int(std::ceil(longest / kSpacing)), 1, kMostCuts);
  for (int i = 0; i <= cuts; ++i)
    for (int j = 0; i + j <= cuts; ++j) {
      const vec3 shares = vec3(float(i), float(j), float(cuts - i - j)) / float(cuts);
      const vec3 cell = glm::floor((shares.x * p[t.x] + shares.y * p[t.y] + shares.z * p[t.z]) / kSpacing);
      if (taken.emplace(int(cell.x), int(cell.y), int(cell.z)).second) places.push_back({t, shares});
    }
}

std::uint32_t upperArm(const Rig& rig, const char* side) {
  return rig.partNamed(std::string(side) + "UpperArm");
}

}  // namespace

ArmlessFlesh::ArmlessFlesh(const Body& body, const SkinnedMesh& skin, const std::vector<char>& armJoints)
    : influences_(skin.influences), shell_(withoutArms(body, skin, armJoints)) {
  std::vector<Aabb> boxes(body.skeleton.joints.size());
  for (const uvec3& t : shell_.mesh().triangles)
    for (int k = 0; k < 3; ++k)
      for (int i = 0; i < 4; ++i)
        if (influences_[t[k]].weights[i] >= kMoves)
          boxes[influences_[t[k]].joints[std::size_t(i)]].add(shell_.mesh().positions[t[k]]);
  for (std::uint32_t j = 0; j < boxes.size(); ++j)
    if (!boxes[j].empty() && !armJoints[j])
      hosts_.push_back({j, boxes[j], body.skeleton.joints[j].restWorld});
}

std::vector<mat4> ArmlessFlesh::toRest(const Pose& pose) const {
  std::vector<mat4> all;
  for (const Host& host : hosts_) all.push_back(host.restWorld * glm::inverse(pose.world[host.joint]));
  return all;
}

float ArmlessFlesh::weightOf(std::uint32_t joint, std::uint32_t triangle) const {
  const uvec3& t = shell_.mesh().triangles[triangle];
  float sum = 0;
  for (int k = 0; k < 3; ++k) sum += weightOn(influences_[t[k]], [&](std::size_t j) { return j == joint; });
  return sum / 3;
}

void ArmlessFlesh::lookFrom(std::size_t host, const mat4& toRest, vec3 place, Depth& found) const {
  const vec3 atRest(toRest * vec4(place, 1));
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

ArmlessFlesh::Depth ArmlessFlesh::look(std::span<const mat4> toRest, vec3 place) const {
  Depth found;
  for (std::size_t h = 0; h < hosts_.size(); ++h) lookFrom(h, toRest[h], place, found);
  return found;
}

std::vector<float> ArmlessFlesh::depths(std::span<const mat4> toRest, std::span<const vec3> places) const {
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

std::vector<vec3> ArmPlaces::posed(const SkinnedMesh& skin, std::span<const mat4> skinMatrices) const {
  const auto vertex = [&](std::uint32_t v) { return skinnedPosition(skin, skinMatrices, v); };
  std::vector<vec3> out;
  for (const Place& place : places)
    out.push_back(place.shares.x * vertex(place.corners.x) + place.shares.y * vertex(place.corners.y) +
                  place.shares.z * vertex(place.corners.z));
  return out;
}

std::vector<char> armJointsOf(const Body& body) {
  std::vector<char> arm(body.skeleton.joints.size(), 0);
  const Rig rig = rigOf(body.skeleton);
  for (const char* side : {"left", "right"})
    if (const std::uint32_t top = upperArm(rig, side); top != kNone)
      for (std::uint32_t j = 0; j < arm.size(); ++j)
        if (hangsOn(rig.parents, j, top)) arm[j] = 1;
  return arm;
}

std::vector<ArmPlaces> armsOf(const Body& body, const SkinnedMesh& skin) {
  std::vector<ArmPlaces> arms;
  const Rig rig = rigOf(body.skeleton);
  for (const char* side : {"left", "right"}) {
    const std::uint32_t top = upperArm(rig, side), lower = rig.partNamed(std::string(side) + "LowerArm");
    if (top == kNone || lower == kNone || !hangsOn(rig.parents, lower, top)) continue;
    const auto onLowerArm = [&](std::uint32_t v) {
      return weightOn(skin.influences[v],
                      [&](std::size_t j) { return hangsOn(rig.parents, std::uint32_t(j), lower); }) > 0.5f;
    };
    ArmPlaces arm{.shoulder = {top}, .other = {}, .places = {}, .atRest = {}};
    std::set<std::tuple<int, int, int>> taken;
    for (const uvec3& t : skin.mesh.triangles)
      if (onLowerArm(t.x) && onLowerArm(t.y) && onLowerArm(t.z)) addPlaces(skin, t, taken, arm.places);
    arms.push_back(std::move(arm));
  }
  if (arms.size() == 2) arms[0].other = arms[1].shoulder, arms[1].other = arms[0].shoulder;
  return arms;
}

}  // namespace vasa
