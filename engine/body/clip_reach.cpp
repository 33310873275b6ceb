#include "body/clip_reach.h"

#include <algorithm>
#include <cmath>

namespace vasa {
namespace {

constexpr float kFarthestReach = 1000;  // [m]

float lengthOfWay(vec3 v) { return glm::length(v); }
float largestScale(vec3 v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

// The greatest difference of a track's values from `from`, those between its keys, too.
float greatestOf(const Track<vec3>& track, vec3 rest, vec3 from, float (*measure)(vec3)) {
  if (track.times.empty()) return measure(rest - from);
  const bool cubic = track.interpolation == Interpolation::cubic;
  float values = 0, tangents = 0, step = 0;
  for (std::size_t i = 0; i < track.values.size(); ++i)
    if (cubic && i % 3 != 1)
      tangents = std::max(tangents, measure(track.values[i]));
    else
      values = std::max(values, measure(track.values[i] - from));
  if (cubic)
    for (std::size_t i = 1; i < track.times.size(); ++i)
      step = std::max(step, track.times[i] - track.times[i - 1]);
  return values + tangents * step;
}

}  // namespace

bool staysNear(const Skeleton& skeleton, const Clip& clip) {
  static const Track<vec3> none;
  std::vector<const JointTracks*> tracksOf(skeleton.joints.size());
  for (const JointTracks& tracks : clip.tracks) tracksOf[tracks.joint.value] = &tracks;
  std::vector<float> reach(tracksOf.size()), size(tracksOf.size());
  const mat3 root(skeleton.rootTransform);
  for (std::size_t j = 0; j < tracksOf.size(); ++j) {
    const auto& joint = skeleton.joints[j];
    const bool hangs = joint.parent.valid();
    const float above = hangs ? size[joint.parent.value]
                              : std::max({glm::length(root[0]), glm::length(root[1]), glm::length(root[2])});
    const Track<vec3>&moves = tracksOf[j] ? tracksOf[j]->translation : none,
          &scales = tracksOf[j] ? tracksOf[j]->scale : none;
    size[j] = above * greatestOf(scales, joint.rest.scale, vec3(0), largestScale);
    reach[j] = (hangs ? reach[joint.parent.value] : 0) +
               above * greatestOf(moves, joint.rest.translation, hangs ? vec3(0) : joint.rest.translation,
                                  lengthOfWay);
    if (!(reach[j] <= kFarthestReach)) return false;
  }
  return true;
}

}  // namespace vasa
