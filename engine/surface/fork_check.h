#pragma once
#include "surface/fork.h"

namespace vasa {

/// Whether a triangle looks the other way than the normals of its corners, or almost: by a 100,000th of its
/// edges. The same on any device that rounds alike.
bool folds(const SurfacePoint& a, const SurfacePoint& b, const SurfacePoint& c);

/// Triangles of a fork that fold. @param fixed  see evaluateFork()
std::uint32_t foldedTriangles(const PosedNetwork& network, const shared::ForkRecord& fork,
                              std::uint32_t around, const ForkSteps* fixed);
/// Triangles that would fold if nothing were smoothed.
inline std::uint32_t foldedUnsmoothed(const PosedNetwork& network, const shared::ForkRecord& fork,
                                      std::uint32_t around) {
  constexpr ForkSteps kUnsmoothed;
  return foldedTriangles(network, fork, around, &kUnsmoothed);
}

/// What a pose settles of a fork.
ForkLayout settledFork(const PosedNetwork& network, const shared::ForkRecord& fork, std::uint32_t around);

/// Whether some part of a fork is a stump.
bool isStump(const ForkLayout& layout);
inline bool isStump(const PosedNetwork& network, const shared::ForkRecord& fork, std::uint32_t around) {
  return isStump(settledFork(network, fork, around));
}

}  // namespace vasa
