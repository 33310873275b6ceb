#pragma once
#include "body/clip.h"

namespace vasa {

inline constexpr float kKeyRounding = 0.01f;  ///< frames, by which times of keys may be rounded

/// Whether a clip's last key falls on its last frame, and not between that and a next one, which it does not
/// have.
inline bool endsOnFrame(const Clip& clip) {
  return (clip.end - clip.timeOfFrame(clip.frameCount() - 1)) * clip.framesPerSecond <= kKeyRounding;
}

}  // namespace vasa
