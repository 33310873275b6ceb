#include "body/props.h"

#include <algorithm>
#include <array>
#include <numeric>

#include "body/bone_field.h"
#include "body/mesh_role.h"
#include "body/rig.h"
#include "math/aabb.h"
#include "math/closest_point.h"
#include "mesh/components.h"

namespace vasa {
namespace {

// Of the skeleton's size, 40 cm of a grown-up's: heads, hats, bellies and hands end before that.
constexpr float kBeyondFlesh = 0.25f;

class Limits {
 public:
  explicit Limits(const Skeleton& skeleton) : skeleton_(skeleton), rig_(rigOf(skeleton)) {
    Aabb box;
    for (const vec3 centre : rig_.centres) box.add(centre);
    far_ = kBeyondFlesh * box.size();
  }
  // Of others' skeletons nobody knows how far flesh reaches.
  bool ofPerson() const { return humanoidKeys(rig_.parts.of) > kHumanoidKeys / 2; }

  // Box corners lie farther out than what is in the box: most pieces need no more.
  bool passedBy(const Aabb& box, std::span<const vec3> places) const {
    std::array<vec3, 8> corners;
    for (int k = 0; k < 8; ++k)
      corners[std::size_t(k)] = {k & 1 ? box.low.x : box.high.x, k & 2 ? box.low.y : box.high.y,
                                 k & 4 ? box.low.z : box.high.z};
    return anyFar(corners) && anyFar(places);
  }
  bool isOfLimb(std::uint32_t joint) const {
    while (rig_.parts.of[joint].empty() && rig_.parents[joint] != kNone) joint = rig_.parents[joint];
    const std::string_view part = rig_.parts.of[joint];
    return part.ends_with("Arm") || part.ends_with("Leg");
  }

 private:
  bool anyFar(std::span<const vec3> places) const {
    return std::ranges::any_of(places, [&](vec3 p) {
      return std::ranges::none_of(skeleton_.joints, [&](const Skeleton::Joint& joint) {
        const vec3 to(joint.restWorld[3]),
            from = joint.parent.valid() ? vec3(skeleton_.joints[joint.parent.value].restWorld[3]) : to;
        return glm::distance(p, glm::mix(from, to, closestOnSegment(p, from, to))) <= far_;
      });
    });
  }

  const Skeleton& skeleton_;
  Rig rig_;
  float far_ = 0;
};

// Of each vertex, whether it is a prop's.
std::vector<bool> propsOf(const Body& body, const SkinnedMesh& mesh, const Limits& limits) {
  const std::size_t count = mesh.mesh.positions.size();
  struct Piece {
    std::uint32_t carrier = kNone;
    bool rigid = true;
    std::vector<vec3> places;
    Aabb box;
  };
  std::vector<std::uint32_t> all(count);
  std::iota(all.begin(), all.end(), 0u);
  DisjointSets sets = joinedVertices(mesh.mesh, all);
  std::vector<Piece> pieces(count);  // at the first vertex of each
  for (const std::uint32_t v : all) {
    Piece& piece = pieces[sets.find(v)];
    const std::uint32_t carrier = soleCarrier(mesh.influences[v]);
    if (piece.box.empty()) piece.carrier = carrier;
    piece.rigid = piece.rigid && carrier != kNone && carrier == piece.carrier;
    piece.box.add(mesh.mesh.positions[v]);
    if (piece.rigid) piece.places.push_back(mesh.mesh.positions[v]);
  }
  std::vector<bool> is(count);
  for (const std::uint32_t v : all) {
    const Piece& piece = pieces[v];
    is[v] = sets.find(v) != v ? is[sets.find(v)]
                              : piece.rigid && !limits.isOfLimb(body.carrier(piece.carrier)) &&
                                    limits.passedBy(piece.box, piece.places);
  }
  return is;
}

void takeVertices(SkinnedMesh& mesh, const std::vector<bool>& out) {
  std::vector<std::uint32_t> now;
  std::uint32_t kept = 0;
  for (std::size_t v = 0; v < out.size(); ++v) {
    now.push_back(kept);
    if (out[v]) continue;
    mesh.mesh.positions[kept] = mesh.mesh.positions[v];
    mesh.normals[kept] = mesh.normals[v];
    mesh.influences[kept] = mesh.influences[v];
    ++kept;
  }
  mesh.mesh.positions.resize(kept), mesh.normals.resize(kept), mesh.influences.resize(kept);
  std::erase_if(mesh.mesh.triangles, [&](const uvec3& t) { return out[t.x]; });
  for (uvec3& t : mesh.mesh.triangles) t = {now[t.x], now[t.y], now[t.z]};
}

}  // namespace

std::vector<std::string> leaveOutProps(Body& body) {
  std::vector<std::string> names;
  const Limits limits(body.skeleton);
  if (!limits.ofPerson()) return names;
  for (SkinnedMesh& mesh : body.meshes) {
    const MeshRole role = roleNamed(mesh.name);
    if (role != MeshRole::skin && role != MeshRole::other) continue;
    const std::vector<bool> out = propsOf(body, mesh, limits);
    if (std::ranges::find(out, true) == out.end()) continue;
    names.push_back(mesh.name);
    takeVertices(mesh, out);
  }
  std::erase_if(body.meshes, [](const SkinnedMesh& mesh) { return mesh.mesh.empty(); });
  return names;
}

}  // namespace vasa
