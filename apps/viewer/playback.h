#pragma once
#include "body/clip.h"

namespace vasa::viewer {

/// Where in a clip we are, and how time goes on. A value; knows nothing of clocks.
struct Playback {
  int clip = -1;    ///< index into Body::clips; -1: the rest pose
  float time = 0;   ///< [s] within the clip, from Clip::start
  float speed = 1;  ///< < 0: backwards
  bool playing = false;
  bool loop = true;

  /// Lets so much time pass. At the clip's end it starts anew or stops there.
  void advance(const Clip& chosen, double seconds);
  /// To the next or previous frame, and stops.
  void step(const Clip& chosen, int frames);
  /// The frame shown, from 0.
  std::uint32_t frame(const Clip& chosen) const;
};

}  // namespace vasa::viewer
