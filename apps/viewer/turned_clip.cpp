#include "viewer/turned_clip.h"

#include <vector>

#include <glm/gtx/matrix_decompose.hpp>

namespace vasa::viewer {
namespace {

JointTransform partsOf(const mat4& matrix) {
  JointTransform parts;
  vec3 skew;
  vec4 perspective;
  glm::decompose(matrix, parts.scale, parts.rotation, parts.translation, skew, perspective);
  return parts;
}

}  // namespace

Clip turnedClip(const Skeleton& skeleton, const Clip* clip, std::span<const JointTurn> turns) {
  Clip made;
  made.name = clip ? clip->name : "pose";
  if (clip) {
    made.start = clip->start;
    made.end = clip->end;
    made.framesPerSecond = clip->framesPerSecond;
  }
  for (std::uint32_t j = 0; j < skeleton.joints.size(); ++j) made.tracks.push_back({.joint = JointId{j}});
  for (const float time : clip ? momentsOf(*clip) : std::vector{made.start}) {
    const Pose pose = turned(skeleton, clip ? samplePose(skeleton, *clip, time) : restPose(skeleton), turns);
    for (std::uint32_t j = 0; j < skeleton.joints.size(); ++j) {
      const JointId parent = skeleton.joints[j].parent;
      const mat4& before = parent.valid() ? pose.world[parent.value] : skeleton.rootTransform;
      const JointTransform parts = partsOf(glm::inverse(before) * pose.world[j]);
      JointTracks& tracks = made.tracks[j];
      const auto add = [&](auto& track, const auto& value) {
        track.times.push_back(time);
        track.values.push_back(value);
      };
      add(tracks.translation, parts.translation);
      add(tracks.rotation, parts.rotation);
      add(tracks.scale, parts.scale);
    }
  }
  return made;
}

}  // namespace vasa::viewer
