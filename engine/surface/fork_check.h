#pragma once
#include "surface/fork.h"

namespace vasa {

/// Whether a triangle looks the other way than the normals of its corners, or almost: by a 100,000th of its
/// edges. The same on any device that rounds alike.
bool folds(const SurfacePoint& a, const SurfacePoint& b, const SurfacePoint& c);

/// Triangles of a fork that fold. @param form  see evaluateFork()
std::uint32_t foldedTriangles(const PosedNetwork& network, const shared::ForkRecord& fork,
                              std::uint32_t around, ForkForm form);

/// Whether some part of a fork is a stump.
bool isStump(const PosedNetwork& network, const shared::ForkRecord& fork, std::uint32_t around);

}  // namespace vasa
