#pragma once
#include "scene/frame.h"

namespace vasa::viewer {

/// What the vessels' shape follows.
struct Forces {
  bool volume = true, avoid = true, beat = false;
  bool operator==(const Forces&) const = default;
};

/// @param contacts  places where vessels touch are wanted even where they are not moved apart
inline FrameOptions frameOptions(const Forces& forces, bool contacts) {
  FrameOptions options{.keep = forces.volume ? Keep::volume : Keep::radii,
                       .avoid = forces.avoid || contacts,
                       .beat = forces.beat};
  if (!forces.avoid) options.avoidance.rounds = 0;  // only look
  return options;
}

}  // namespace vasa::viewer
