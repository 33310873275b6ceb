#include "viewer/playback.h"

#include <algorithm>
#include <cmath>

namespace vasa::viewer {

void Playback::advance(const Clip& chosen, double seconds) {
  if (!playing) return;
  const float length = chosen.end - chosen.start;
  time += float(seconds) * speed;
  if (length <= 0) {
    time = chosen.start;
    return;
  }
  float into = time - chosen.start;
  if (into >= 0 && into <= length) return;
  if (loop) {
    into = std::fmod(into, length);
    time = chosen.start + (into < 0 ? into + length : into);
  } else {
    time = into < 0 ? chosen.start : chosen.end;
    playing = false;
  }
}

void Playback::step(const Clip& chosen, int frames) {
  playing = false;
  const int last = int(chosen.frameCount()) - 1;
  const int next = std::clamp(int(frame(chosen)) + frames, 0, last);
  time = chosen.timeOfFrame(std::uint32_t(next));
}

std::uint32_t Playback::frame(const Clip& chosen) const {
  const float frames = std::round((time - chosen.start) * chosen.framesPerSecond);
  return std::uint32_t(std::clamp(frames, 0.0f, float(chosen.frameCount() - 1)));
}

}  // namespace vasa::viewer
