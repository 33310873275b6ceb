#pragma once
#include <string>
#include <vector>

#include "core/ids.h"
#include "math/types.h"

namespace vasa {

/// A recorded motion with a skeleton of its own: what a motion file gives. Its rest pose is the one with all
/// rotations zero; lengths are in the file's unit, axes as in the house (+Y up).
struct Motion {
  struct Joint {
    std::string name;
    JointId parent;      ///< invalid at a root; parents come before their children
    vec3 offset{0};      ///< from the parent at rest
    vec3 endOffset{0};   ///< of a tip's end; zero elsewhere
    bool moves = false;  ///< has a translation of its own in every frame
  };
  std::string name;
  std::vector<Joint> joints;
  float framesPerSecond = 30;
  std::uint32_t frameCount = 0;
  bool turnsDoubted = false;       ///< its feet slide, and would stand in another order of its turns
  std::vector<quat> rotations;     ///< local, frame after frame, one a joint
  std::vector<vec3> translations;  ///< local, likewise; the offset where the joint does not move

  const quat& rotation(std::uint32_t frame, std::size_t joint) const {
    return rotations[frame * joints.size() + joint];
  }
  const vec3& translation(std::uint32_t frame, std::size_t joint) const {
    return translations[frame * joints.size() + joint];
  }
};

}  // namespace vasa
