#include "realism/bone_gap.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "body/mesh_role.h"
#include "body/skin_shell.h"
#include "body/skinning.h"
#include "math/closest_point.h"

namespace vasa {
namespace {

// How far [m] from a joint its own bone begins, at rest: a knee turns about an axis in the thigh's bone,
// above the line between the bones, from which levels are given.
float boneBegins(const Body& body, JointId joint) {
  const vec3 centre(body.skeleton.joints[joint.value].restWorld[3]);
  float nearest = std::numeric_limits<float>::infinity();
  for (const SkinnedMesh& mesh : body.meshes) {
    if (roleNamed(mesh.name) != MeshRole::bones) continue;
    const TriangleMesh rest = meshAtRest(body, mesh);
    for (std::size_t v = 0; v < rest.positions.size(); ++v)
      for (int i = 0; i < 4; ++i)
        if (body.carrier(mesh.influences[v].joints[std::size_t(i)]) == joint.value &&
            mesh.influences[v].weights[i] > 0.5f)
          nearest = std::min(nearest, glm::distance(rest.positions[v], centre));
  }
  return std::isfinite(nearest) ? nearest : 0;
}

}  // namespace

PosedBones::PosedBones(const Body& body, const Pose& pose) : body_(&body), pose_(&pose) {
  const std::vector<mat4> matrices = skinMatrices(body, pose);
  for (const SkinnedMesh& mesh : body.meshes) {
    if (roleNamed(mesh.name) != MeshRole::bones) continue;
    skinPositions(mesh, matrices, bones_.emplace_back(Bone{&mesh.mesh, {}}).positions);
  }
}

float PosedBones::distance(vec3 place) const {
  float least = std::numeric_limits<float>::infinity();
  for (const Bone& bone : bones_)
    for (const uvec3& t : bone.mesh->triangles)
      least = std::min(
          least,
          glm::distance(
              place,
              closestOnTriangle(place, bone.positions[t.x], bone.positions[t.y], bone.positions[t.z]).point));
  return least;
}

float boneGap(const PosedBones& bones, JointId joint, std::optional<float> level, const Network& network,
              const VesselPath& path, std::span<const vec4> points) {
  std::vector<vec4> places = path.places(network, points);
  if (level) {
    const Skeleton::Joint& limb = bones.body().skeleton.joints[joint.value];
    const mat4 toRest = limb.restWorld * glm::inverse(bones.pose().world[joint.value]);
    const float height = limb.restWorld[3].y - boneBegins(bones.body(), joint) + *level;
    places = {*std::ranges::min_element(
        places, {}, [&](const vec4& place) { return std::abs((toRest * vec4(vec3(place), 1)).y - height); })};
  }
  float gap = std::numeric_limits<float>::infinity();
  for (const vec4& place : places) gap = std::min(gap, bones.distance(vec3(place)) - place.w);
  return gap;
}

}  // namespace vasa
