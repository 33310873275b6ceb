#pragma once
#include <vector>

#include "body/clip.h"

namespace vasa {

inline constexpr float kKeyRounding = 0.01f;  ///< frames, by which times of keys may be rounded

/// Whether a clip's last key falls on its last frame, and not between that and a next one, which it does not
/// have.
inline bool endsOnFrame(const Clip& clip) {
  return (clip.end - clip.timeOfFrame(clip.frameCount() - 1)) * clip.framesPerSecond <= kKeyRounding;
}

/// The times of a clip's frames, and its end where that falls between them.
inline std::vector<float> momentsOf(const Clip& clip) {
  std::vector<float> times;
  for (std::uint32_t f = 0; f < clip.frameCount(); ++f) times.push_back(clip.timeOfFrame(f));
  if (!endsOnFrame(clip)) times.push_back(clip.end);
  return times;
}

}  // namespace vasa
