#pragma once
#include "surface/fork.h"

namespace vasa {

/// A ring's tube run straight on: the ring, a circle as wide and parallel to it at kStumpWide of the way to
/// the tip, and the tip. Mirrored by shaders/lib/fork_stump.glsl.
struct Stump {
  Section ring;
  vec3 inward{0};   ///< unit, at right angles to the ring
  vec3 towards{0};  ///< the tip, unless that lies less deep than half a radius

  vec3 tip() const;
};

/// Tubes of a fork as they are where it folds.
struct ForkStumps {
  Stump a, b;
  std::array<Stump, shared::kMostBranches> branch;

  /// Puts stumps in the place of parts that still fold: of one branch, or of all tubes where the trunk does,
  /// the wall where stumps left no hole included. Sets layout.stump and layout.cut. To be called after
  /// smoothFolds(). @param turns  as evaluateFork()'s
  void replaceFolds(const ForkShape& shape, ForkLayout& layout, std::span<SurfacePoint> vertices,
                    bool turns) const;
};

/// Smooths parts of a fork that fold until they do not, at most shared::kMostSmoothings times
/// (surface/fork_smooth.h). @param turns  as evaluateFork()'s @return how often
ForkSteps smoothFolds(const ForkShape& shape, const ForkLayout& layout, std::span<SurfacePoint> vertices,
                      bool turns);

}  // namespace vasa
