#include "body/body.h"

#include "body/skinning.h"
#include "body/trunk.h"
#include "math/aabb.h"

namespace vasa {

float Body::height() const {
  const Pose rest = restPose(skeleton);
  const auto matrices = skinMatrices(*this, rest);
  Aabb box;
  std::vector<vec3> positions;
  for (const SkinnedMesh& mesh : meshes) {
    skinPositions(mesh, matrices, positions);
    for (const vec3 p : positions) box.add(p);
  }
  if (box.empty())
    for (const mat4& joint : rest.world) box.add(vec3(joint[3]));
  return box.empty() ? 0 : box.extent()[uprightAxis(rigOf(skeleton))];
}

void takeJoints(Body& body, JointsKept kept) {
  body.skeleton = std::move(kept.skeleton);
  for (SkinnedMesh& mesh : body.meshes)
    for (SkinInfluence& influence : mesh.influences)
      for (std::uint16_t& joint : influence.joints)  // those without weight may be any
        joint = kept.now[joint].valid() ? std::uint16_t(kept.now[joint].value) : std::uint16_t(0);
  for (Clip& clip : body.clips) {
    std::erase_if(clip.tracks,
                  [&](const JointTracks& track) { return !kept.now[track.joint.value].valid(); });
    for (JointTracks& track : clip.tracks) track.joint = kept.now[track.joint.value];
  }
}

}  // namespace vasa
