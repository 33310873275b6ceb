#pragma once
#include <string>
#include <vector>

#include "realism/protocol.h"
#include "scene/frame.h"
#include "scene/scene.h"

namespace vasa {

/// A published figure beside ours.
struct ProtocolResult {
  std::string refusal;  ///< why it could not be taken from this scene; empty: it was
  float ours = 0;       ///< mean of both sides of the body
  std::vector<float>
      onTheWay;  ///< at a quarter, half, three quarters and all of the way from the first pose to the second
  std::optional<bool> rightSign;  ///< of figures that say in which direction something changes
  std::optional<float>
      deviations;  ///< how far ours is from the mean, in standard deviations; a range counts as four of them
  bool within(float count) const { return deviations && std::abs(*deviations) <= count; }
};

/// How many of the figures agree.
struct RealismScore {
  std::uint32_t usable = 0, signed_ = 0, rightSign = 0, banded = 0, withinOne = 0, withinTwo = 0;
};

struct SweepCurve {
  std::string refusal;
  std::vector<float> degrees, values;
};

/// A comparison with living people: every figure of a protocol, taken from a scene.
struct RealismStudy {
  std::vector<ProtocolResult> results;  ///< one a row
  std::vector<SweepCurve> curves;       ///< one a sweep
  RealismScore tuned,
      blind;  ///< of the rows that were looked at while the model was tuned, and of the others
};

/// Poses the scene as each row says, with avoidance, and measures. What is on the left is taken on the right,
/// too, with everything mirrored. Rows that this scene can not give (a vessel or joint that is not there) are
/// refused, not failed. O(rows · solving a way from rest)
RealismStudy studyRealism(const Scene& scene, const Protocol& protocol, FrameOptions options);

}  // namespace vasa
