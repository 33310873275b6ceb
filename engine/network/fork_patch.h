#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "core/ids.h"
#include "math/types.h"

// The paper's way to draw a fork (Park, Shim, Park, Kang, Kim 2013, section 3.3): the part of the source mesh
// around it.
namespace vasa {

class Network;

/// Where a patch meets a vessel's tube: the vessel's section there when the patch was cut out.
struct PatchRing {
  VesselId vessel;
  float parameter = 0;         ///< u in [0, spans]
  vec3 centre{0};              ///< [m]
  vec3 outward{0, 0, 1};       ///< unit, along the vessel away from the fork
  float radius = 0;            ///< [m]
  std::uint32_t vertices = 0;  ///< of the patch's loop beside it, at least 3
};

/// Most vertices on one loop of a patch: a shader goes around it, and devices bound that.
constexpr std::uint32_t kMostOnLoop = 4096;

/// A piece of wall with one loop of border edges beside each ring. It does not reach the rings: a strip from
/// loop to ring closes the surface, whatever number of vertices the ring is drawn with.
struct ForkPatch {
  static constexpr std::size_t kFewestRings = 3, kMostRings = 4, kMostVertices = 65535;

  std::vector<PatchRing> rings;  ///< the trunk's two, then one a branch
  /// [m] The loops' vertices come first, loop after loop, counter-clockwise about PatchRing::outward.
  std::vector<vec3> positions;
  /// How much a vertex moves with each ring; their sum is 255.
  std::vector<std::array<std::uint8_t, kMostRings>> weights;
  std::vector<uvec3> triangles;  ///< counter-clockwise seen from outside
};

/// What is wrong with a patch for that network; empty if nothing is. It has to be a surface whose every edge
/// has two triangles that agree on its outside, and whose border is its loops. O(n log n).
std::string patchFault(const Network& network, const ForkPatch& patch);

}  // namespace vasa
