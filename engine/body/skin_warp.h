#pragma once
#include <span>

#include "body/skin_shell.h"

namespace vasa {

/// A smooth displacement of space that brings one skin onto another.
///
/// Each vertex of the first wants to go to the nearest place of the second that faces the same way; the
/// wishes are smoothed over the surface, done in part, and asked again. Space between follows: a point moves
/// by the mean of what the vertices that face away from it move, weighted by 1 / (distance² + a little)².
class SkinWarp {
 public:
  /// @param skin    of the first body, as near to the second's as it is known; vertices move with the warp
  /// @param target  the second's
  /// @param height  [m] of the second body, whichever way it lies
  SkinWarp(TriangleMesh skin, const SkinShell& target, float height);

  /// Moves points that moved with the skin so far. In parallel; a pure function of the input.
  void run(std::span<vec4> points) const;

 private:
  struct Round {
    std::vector<vec3> places, normals, moves;  // of samples of the skin
    float blur = 0;
  };
  std::vector<Round> rounds_;
};

}  // namespace vasa
