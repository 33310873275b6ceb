#pragma once
#include <span>

#include "network/network.h"
#include "surface/fork.h"

namespace vasa {

/// Triangles of a fork that look the other way than the normals of their corners: the surface folds there.
std::uint32_t foldedTriangles(const PosedNetwork& network, const shared::ForkRecord& fork, std::uint32_t around);

}  // namespace vasa
