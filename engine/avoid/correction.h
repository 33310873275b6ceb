#pragma once
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "math/types.h"
#include "network/network.h"

namespace vasa {

/// How far vessels are from where the pose alone would have them: all that one step hands to the next.
struct Correction {
  static constexpr float kNoLimit = std::numeric_limits<float>::infinity();
  /// [m] of a motion, a depth or a lack: less is none, so that what hangs on it has not moved and is not
  /// looked at again. 10 µm, the least clearance, takes twice as many rounds; 1 to 5 take about as long.
  static constexpr float kNegligible = 2e-6f;
  std::vector<vec3> motions;  ///< [m] one a variable (avoid/motion_space.h); empty: none
  std::vector<float> widest;  ///< [m] one a point: what a lumen that gave way may be; kNoLimit elsewhere
};

/// What becomes of a correction from one step to the next, before contacts are looked at.
class CorrectionFlow {
 public:
  /// @param network  must outlive this
  explicit CorrectionFlow(const Network& network);

  /// What was moved goes back, to a third in a second, and lumina that gave way widen. O(points)
  void fade(float seconds, Correction& correction) const;

  /// Limbs that turned take their vessels' corrections along.
  /// @param from, to  how each point's surroundings are turned, before and now
  void carry(std::span<const quat> from, std::span<const quat> to, std::span<vec3> motions) const;

  /// What lies between two corrections of one pose.
  /// @param share  0: other, 1: correction
  static void mix(const Correction& other, float share, Correction& correction);

 private:
  const Network* network_;
  std::vector<std::uint32_t> pointOf_;  // that a variable goes with; kNone where none may move
};

}  // namespace vasa
