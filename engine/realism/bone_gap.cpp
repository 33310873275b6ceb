#include "realism/bone_gap.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "body/mesh_role.h"
#include "body/skinning.h"
#include "math/closest_point.h"

namespace vasa {

float boneGap(const Body& body, const Pose& pose, JointId joint, std::optional<float> level,
              const Network& network, const VesselPath& path, std::span<const vec4> points) {
  std::vector<vec4> places;
  for (const VesselPath::Station& station : path.stations)
    places.push_back(evaluate(Network::pointsOf(network.vessel(station.vessel), points), station.parameter));
  if (level) {
    const Skeleton::Joint& limb = body.skeleton.joints[joint.value];
    const mat4 toRest = limb.restWorld * glm::inverse(pose.world[joint.value]);
    const float height = limb.restWorld[3].y + *level;
    places = {*std::ranges::min_element(
        places, {}, [&](const vec4& place) { return std::abs((toRest * vec4(vec3(place), 1)).y - height); })};
  }
  const std::vector<mat4> matrices = skinMatrices(body.skeleton, pose);
  float gap = std::numeric_limits<float>::infinity();
  std::vector<vec3> positions;
  for (const SkinnedMesh& mesh : body.meshes) {
    if (roleNamed(mesh.name) != MeshRole::bones) continue;
    skinPositions(mesh, matrices, positions);
    for (const vec4& place : places)
      for (const uvec3& t : mesh.mesh.triangles)
        gap = std::min(
            gap, glm::distance(
                     vec3(place),
                     closestOnTriangle(vec3(place), positions[t.x], positions[t.y], positions[t.z]).point) -
                     place.w);
  }
  return gap;
}

}  // namespace vasa
