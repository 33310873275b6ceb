#include "body/chain.h"

namespace vasa::test {

Body chainBody(const std::vector<vec3>& centres) {
  Body body;
  body.name = "chain.glb";
  for (std::uint32_t i = 0; i < centres.size(); ++i) {
    Skeleton::Joint joint;
    joint.name = "joint" + std::to_string(i);
    if (i) joint.parent = {i - 1};
    joint.rest.translation = centres[i] - (i ? centres[i - 1] : vec3(0));
    joint.restWorld = glm::translate(mat4(1), centres[i]);
    joint.inverseBind = glm::inverse(joint.restWorld);
    body.skeleton.joints.push_back(joint);
  }
  return body;
}

Pose turned(const Body& body, const std::vector<std::pair<std::uint32_t, quat>>& turns) {
  std::vector<JointTransform> local;
  for (const Skeleton::Joint& joint : body.skeleton.joints) local.push_back(joint.rest);
  for (const auto& [joint, turn] : turns) local[joint].rotation = local[joint].rotation * turn;
  return poseFromLocal(body.skeleton, local);
}

Clip turningClip(std::uint32_t joint, quat turn) {
  Clip clip{.name = "turn", .start = 0, .end = 0.2f, .framesPerSecond = 10, .tracks = {}};
  JointTracks tracks;
  tracks.joint = {joint};
  tracks.rotation = {Interpolation::linear, {0, 0.2f}, {quat(1, 0, 0, 0), turn}};
  clip.tracks.push_back(tracks);
  return clip;
}

std::vector<vec4> bundle(vec3 from, vec3 to, const std::vector<float>& distances, std::uint32_t around,
                         std::uint32_t along) {
  const vec3 axis = glm::normalize(to - from), u = anyPerpendicular(axis), v = glm::cross(axis, u);
  std::vector<vec4> points;
  for (const float distance : distances)
    for (std::uint32_t k = 0; k < around; ++k) {
      const float angle = 2 * kPi * float(k) / float(around);
      const vec3 across = distance * (std::cos(angle) * u + std::sin(angle) * v);
      for (std::uint32_t i = 0; i < along; ++i)
        points.emplace_back(glm::mix(from, to, float(i) / float(along - 1)) + across, 0.001f);
    }
  return points;
}

}  // namespace vasa::test
