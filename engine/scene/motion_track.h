#pragma once
#include <vector>

#include "avoid/solver.h"
#include "body/clip.h"

namespace vasa {

/// The corrections of a clip's frames, as far as they were solved.
struct MotionTrack {
  const Clip* clip = nullptr;
  std::vector<Correction> frames;
};

}  // namespace vasa
