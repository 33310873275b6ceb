#include "body/skin_recognition.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "body/bone_field.h"
#include "body/mesh_role.h"
#include "math/aabb.h"
#include "mesh/components.h"
#include "mesh/winding_number.h"

namespace vasa {
namespace {

constexpr float kLongLink = 0.06f;    // of the skeleton's size: hands and faces have links too short to tell
constexpr float kBelowSkin = 0.012f;  // ... a finger's breadth: deeper in flesh than a bone's own surface
constexpr float kEnclosed = 0.5f;     // of the links
constexpr float kInside = 0.7f;       // of a mesh's vertices, for it to be something within
constexpr std::size_t kVerticesAsked = 100, kMostPlaces = 400;
constexpr std::size_t kMostNames = 4;

// Around the middle of each long link.
std::vector<vec3> placesInFlesh(const Skeleton& skeleton) {
  Aabb box;
  for (const auto& joint : skeleton.joints) box.add(vec3(joint.restWorld[3]));
  if (box.empty()) return {};
  const float size = box.size();
  std::vector<vec3> places;
  for (const auto& joint : skeleton.joints) {
    if (!joint.parent.valid()) continue;
    const vec3 from(skeleton.joints[joint.parent.value].restWorld[3]), to(joint.restWorld[3]);
    const float length = glm::distance(from, to);
    if (length < kLongLink * size) continue;
    const vec3 across = kBelowSkin * size * anyPerpendicular((to - from) / length),
               other = glm::cross((to - from) / length, across);
    for (const vec3 aside : {across, other, -across, -other}) places.push_back(0.5f * (from + to) + aside);
  }
  // Of thousands of links (hair, cloth) some do.
  if (const std::size_t count = places.size(); count > kMostPlaces) {
    for (std::size_t i = 0; i < kMostPlaces; ++i) places[i] = places[i * count / kMostPlaces];
    places.resize(kMostPlaces);
  }
  return places;
}

float enclosedShare(std::span<const vec3> places, const TriangleMesh& mesh) {
  if (places.empty() || mesh.empty()) return 0;
  const WindingNumber winding(mesh.positions, mesh.triangles);
  const auto inside = std::ranges::count_if(places, [&](vec3 p) { return std::abs(winding.at(p)) >= 0.5f; });
  return float(inside) / float(places.size());
}

bool liesInside(const SkinnedMesh& mesh, const WindingNumber& winding) {
  const std::size_t count = mesh.mesh.positions.size(), asked = std::min(count, kVerticesAsked);
  std::size_t inside = 0;
  for (std::size_t i = 0; i < asked; ++i)
    inside += std::abs(winding.at(mesh.mesh.positions[i * count / asked])) >= 0.5f;
  return float(inside) >= kInside * float(asked);
}

// Whether one's box is around the other's.
bool holds(const SkinnedMesh& around, const SkinnedMesh& mesh) {
  const Aabb outer = around.mesh.bounds(), inner = mesh.mesh.bounds();
  return glm::all(glm::lessThanEqual(outer.low, inner.low)) &&
         glm::all(glm::greaterThanEqual(outer.high, inner.high));
}

void append(SkinnedMesh& to, const SkinnedMesh& from) {
  appendMesh(to.mesh, from.mesh);
  to.normals.insert(to.normals.end(), from.normals.begin(), from.normals.end());
  to.influences.insert(to.influences.end(), from.influences.begin(), from.influences.end());
}

SkinnedMesh merged(const Body& body, std::span<const std::size_t> which) {
  SkinnedMesh all;
  for (const std::size_t m : which) append(all, body.meshes[m]);
  return all;
}

// Which meshes might be skin, by how little is known of them otherwise: 0 bends and has no other name, 1
// moves by rigid parts, 2 is named something else but bends.
int strangeness(const SkinnedMesh& mesh) {
  const MeshRole role = roleNamed(mesh.name);
  const bool unnamed = role == MeshRole::skin || role == MeshRole::other, rigid = movesByRigidParts(mesh);
  if (mesh.mesh.empty() || mesh.influences.empty()) return 3;
  return unnamed ? (rigid ? 1 : 0) : (rigid ? 3 : 2);
}

// A head, hair, a hat or a shoe may follow one joint, as bones and eyes do; but these lie in the skin.
void addRigidParts(const Body& body, std::vector<std::size_t>& skin) {
  const SkinnedMesh whole = merged(body, skin);
  std::optional<WindingNumber> winding;
  std::vector<std::size_t> parts;
  for (std::size_t m = 0; m < body.meshes.size(); ++m) {
    if (strangeness(body.meshes[m]) != 1 || std::ranges::find(skin, m) != skin.end()) continue;
    if (!winding) winding.emplace(whole.mesh.positions, whole.mesh.triangles);
    if (!liesInside(body.meshes[m], *winding)) parts.push_back(m);
  }
  // A part that lies in another one of them (eyes in a head) stays what it is.
  std::vector<std::size_t> outer;
  for (const std::size_t m : parts) {
    const bool within = std::ranges::any_of(parts, [&](std::size_t other) {
      if (other == m || !holds(body.meshes[other], body.meshes[m])) return false;
      const TriangleMesh& around = body.meshes[other].mesh;
      return liesInside(body.meshes[m], WindingNumber(around.positions, around.triangles));
    });
    if (!within) outer.push_back(m);
  }
  skin.insert(skin.end(), outer.begin(), outer.end());
}

}  // namespace

void recogniseSkin(Body& body) {
  std::vector<std::size_t> candidates;
  const auto take = [&](int rank) {
    for (std::size_t m = 0; m < body.meshes.size(); ++m)
      if (strangeness(body.meshes[m]) == rank) candidates.push_back(m);
  };
  take(0);
  const bool rigidParts =
      std::ranges::any_of(body.meshes, [](const SkinnedMesh& mesh) { return strangeness(mesh) == 1; });
  if (!rigidParts && candidates.size() == 1 && roleNamed(body.meshes[candidates[0]].name) == MeshRole::skin)
    return;
  const std::vector<vec3> places = placesInFlesh(body.skeleton);
  float enclosed = enclosedShare(places, merged(body, candidates).mesh);
  for (const int rank : {1, 2})
    if (enclosed < kEnclosed) take(rank), enclosed = enclosedShare(places, merged(body, candidates).mesh);
  if (enclosed < kEnclosed || candidates.empty()) return;

  std::vector<float> shares(body.meshes.size(), 0.0f);
  for (const std::size_t m : candidates) shares[m] = enclosedShare(places, body.meshes[m].mesh);
  const std::size_t first =
      *std::ranges::max_element(candidates, {}, [&](std::size_t m) { return shares[m]; });
  const WindingNumber winding(body.meshes[first].mesh.positions, body.meshes[first].mesh.triangles);
  std::erase_if(candidates, [&](std::size_t m) { return m != first && liesInside(body.meshes[m], winding); });
  std::ranges::stable_sort(candidates, std::greater{},
                           [&](std::size_t m) { return m == first ? 2.0f : shares[m]; });
  addRigidParts(body, candidates);
  if (candidates.size() == 1 && roleNamed(body.meshes[first].name) == MeshRole::skin &&
      !movesByRigidParts(body.meshes[first]))
    return;

  SkinnedMesh skin = merged(body, candidates);
  skin.colour = body.meshes[first].colour;
  skin.name = "skin:";
  for (std::size_t i = 0; i < std::min(candidates.size(), kMostNames); ++i)
    skin.name += (i > 0 ? ", " : " ") + body.meshes[candidates[i]].name;
  if (candidates.size() > kMostNames)
    skin.name += " and " + std::to_string(candidates.size() - kMostNames) + " more";
  body.meshes[first] = std::move(skin);
  std::vector<bool> merges(body.meshes.size());
  for (const std::size_t m : candidates) merges[m] = m != first;
  std::vector<SkinnedMesh> rest;
  for (std::size_t m = 0; m < body.meshes.size(); ++m)
    if (!merges[m]) rest.push_back(std::move(body.meshes[m]));
  body.meshes = std::move(rest);
}

}  // namespace vasa
