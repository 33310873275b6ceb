#include "body/clip_reach.h"

#include <algorithm>
#include <cmath>

namespace vasa {
namespace {

float lengthOfWay(vec3 v) { return glm::length(v); }
float largestScale(vec3 v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

// The greatest difference of a track's values from `from`, those between its keys, too.
float greatestOf(const Track<vec3>& track, vec3 rest, vec3 from, float (*measure)(vec3)) {
  if (track.times.empty()) return measure(rest - from);
  const bool cubic = track.interpolation == Interpolation::cubic;
  const std::size_t stride = cubic ? 3 : 1;  // of a cubic's key: tangent in, value, tangent out
  float values = 0, swing = 0;
  for (std::size_t k = 0; k < track.times.size(); ++k) {
    values = std::max(values, measure(track.values[stride * k + stride / 2] - from));
    if (!cubic || k == 0) continue;
    // Hermite's two polynomials that go with tangents are 4/27 of the step at most.
    const float step = track.times[k] - track.times[k - 1];
    swing = std::max(swing, 4 / 27.0f * step *
                                (measure(track.values[stride * k - 1]) + measure(track.values[stride * k])));
  }
  return values + swing;
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
