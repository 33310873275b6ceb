#include "body/clip.h"

#include <algorithm>
#include <cassert>
#include <cmath>

// Interpolation as in glTF 2.0, appendix C. Cubic: with u in [0, 1] between keys k and k + 1, d seconds
// apart, p = (2u³-3u²+1) v_k + d (u³-2u²+u) b_k + (-2u³+3u²) v_{k+1} + d (u³-u²) a_{k+1}, a and b the in- and
// out-tangents.
namespace vasa {
namespace {

constexpr float kKeyRounding = 0.01f;  // frames, by which times of keys may be rounded

vec3 between(vec3 a, vec3 b, float u) { return a + u * (b - a); }
quat between(quat a, quat b, float u) {
  return glm::slerp(a, b, u);  // along the shorter arc
}
vec3 finished(vec3 v) { return v; }
quat finished(quat q) {
  const float length = glm::length(q);
  return length > 0 ? q / length : quat(1, 0, 0, 0);
}

template <class T>
T cubic(const Track<T>& track, std::size_t key, float u, float seconds) {
  const T &leave = track.values[3 * key + 2], &arrive = track.values[3 * key + 3];
  const T &from = track.values[3 * key + 1], &to = track.values[3 * key + 4];
  const float u2 = u * u, u3 = u2 * u;
  return from * (2 * u3 - 3 * u2 + 1) + leave * (seconds * (u3 - 2 * u2 + u)) + to * (-2 * u3 + 3 * u2) +
         arrive * (seconds * (u3 - u2));
}

template <class T>
T valueAt(const Track<T>& track, std::size_t key) {
  return track.values[track.interpolation == Interpolation::cubic ? 3 * key + 1 : key];
}

template <class T>
T sample(const Track<T>& track, float time, T rest) {
  if (track.times.empty()) return rest;
  assert(track.values.size() == track.times.size() * (track.interpolation == Interpolation::cubic ? 3 : 1));
  const auto after = std::upper_bound(track.times.begin(), track.times.end(), time);
  if (after == track.times.begin()) return finished(valueAt(track, 0));
  const auto key = std::size_t(after - track.times.begin()) - 1;
  if (after == track.times.end() || track.interpolation == Interpolation::step)
    return finished(valueAt(track, key));
  const float seconds = track.times[key + 1] - track.times[key];
  const float u = (time - track.times[key]) / seconds;
  if (track.interpolation == Interpolation::cubic) return finished(cubic(track, key, u, seconds));
  return finished(between(track.values[key], track.values[key + 1], u));
}

// What is scaled to nothing, as games hide things, has no way back to rest: a thousandth of that stays.
vec3 withExtent(vec3 scale, vec3 rest) {
  constexpr float kLeast = 1e-3f;
  for (int k = 0; k < 3; ++k)
    if (const float least = kLeast * std::abs(rest[k]); std::abs(scale[k]) < least)
      scale[k] = std::copysign(least, scale[k]);
  return scale;
}

}  // namespace

double likelyRate(double told) {
  double rate = std::round(told);
  for (const double whole : {24.0, 30.0, 60.0, 120.0})
    if (const double ntsc = whole * 1000 / 1001; std::abs(told - ntsc) < 0.3 * std::abs(told - rate))
      rate = ntsc;
  return std::abs(told - rate) <= 0.005 * told ? rate : told;
}

std::uint32_t Clip::frameCount() const {
  const float frames = std::min((end - start) * framesPerSecond, 1e9f);
  // The last key falls on the last frame although both times are rounded.
  return frames > 0 ? std::uint32_t(std::floor(frames + kKeyRounding)) + 1 : 1;
}

void samplePose(const Skeleton& skeleton, const Clip& clip, float time, Pose& pose) {
  static thread_local std::vector<JointTransform> local;  // kept, so that a frame allocates nothing
  local.clear();
  for (const auto& joint : skeleton.joints) local.push_back(joint.rest);
  for (const JointTracks& tracks : clip.tracks) {
    JointTransform& transform = local[tracks.joint.value];
    transform.translation = sample(tracks.translation, time, transform.translation);
    transform.rotation = sample(tracks.rotation, time, transform.rotation);
    transform.scale = withExtent(sample(tracks.scale, time, transform.scale), transform.scale);
  }
  poseFromLocal(skeleton, local, pose);
}

Pose samplePose(const Skeleton& skeleton, const Clip& clip, float time) {
  Pose pose;
  samplePose(skeleton, clip, time, pose);
  return pose;
}

bool endsOnFrame(const Clip& clip) {
  return (clip.end - clip.timeOfFrame(clip.frameCount() - 1)) * clip.framesPerSecond <= kKeyRounding;
}

std::vector<float> momentsOf(const Clip& clip) {
  std::vector<float> times;
  for (std::uint32_t f = 0; f < clip.frameCount(); ++f) times.push_back(clip.timeOfFrame(f));
  if (!endsOnFrame(clip)) times.push_back(clip.end);
  return times;
}

bool closes(const Skeleton& skeleton, const Clip& clip) {
  constexpr float kSamePlace = 1e-3f;  // [m] and of an axis
  const std::uint32_t last = clip.frameCount() - 1;
  const Pose a = samplePose(skeleton, clip, clip.timeOfFrame(0)),
             b = samplePose(skeleton, clip, endsOnFrame(clip) ? clip.timeOfFrame(last) : clip.end);
  for (std::size_t j = 0; j < a.world.size(); ++j)
    for (int k = 0; k < 4; ++k)
      if (glm::distance(a.world[j][k], b.world[j][k]) > kSamePlace) return false;
  return last > 0;
}

}  // namespace vasa
