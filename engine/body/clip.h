#pragma once
#include <string>
#include <vector>

#include "body/skeleton.h"

namespace vasa {

enum class Interpolation : std::uint8_t { step, linear, cubic };

/// Key frames of one property of one joint. For cubic keys, values holds in-tangent, value, out-tangent for
/// each key, as in glTF.
template <class T>
struct Track {
  Interpolation interpolation = Interpolation::linear;
  std::vector<float> times;  ///< [s] increasing
  std::vector<T> values;
};

struct JointTracks {
  JointId joint;
  Track<vec3> translation;  ///< empty: stays at rest
  Track<quat> rotation;
  Track<vec3> scale;
};

/// Frames a second that a file means by those that follow from its times: the nearest whole number, or 24,
/// 30, 60 or 120 thousand a thousand and one (film and NTSC) where these are nearer; as told where it lies
/// farther than half a hundredth from any.
double likelyRate(double told);

/// A motion: what each of its joints does over time; other joints stay at rest.
struct Clip {
  std::string name;
  float start = 0;             ///< [s] first key
  float end = 0;               ///< [s] last key
  float framesPerSecond = 30;  ///< frames are sampled at start + frame / framesPerSecond
  std::vector<JointTracks> tracks;

  /// Frames from start to end, both included; at least 1.
  std::uint32_t frameCount() const;
  float timeOfFrame(std::uint32_t frame) const { return start + float(frame) / framesPerSecond; }
};

/// The skeleton's pose at a time; before the first key and after the last the nearest key holds. Scales of
/// less than a thousandth of rest's are that.
Pose samplePose(const Skeleton& skeleton, const Clip& clip, float time);
void samplePose(const Skeleton& skeleton, const Clip& clip, float time, Pose& pose);

/// Whether a clip's last key falls on its last frame, and not between that and a next one, which it does not
/// have.
bool endsOnFrame(const Clip& clip);
/// The times of a clip's frames, and its end where that falls between them.
std::vector<float> momentsOf(const Clip& clip);

/// Whether the last pose is the first one, to a millimetre, so that the clip can go round.
bool closes(const Skeleton& skeleton, const Clip& clip);

}  // namespace vasa
