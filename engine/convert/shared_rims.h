#pragma once
#include "convert/source.h"

namespace vasa {

/// Where the surfaces of two elements hang together: a run of vertices that both have, as where one surface
/// was divided into vessels by name or by material.
struct SharedRim {
  std::uint32_t first, second;  ///< elements, first < second
  vec3 centre;                  ///< mean of the vertices
  float radius;                 ///< [m] mean distance of the vertices from there
};

/// All runs of at least three vertices that two elements have at equal places and that are joined by edges of
/// the first. In the order of the elements. Places that more than eight elements have are left out, and those
/// that are not finite. O(n log n) for n vertices and triangles; can be cancelled.
std::vector<SharedRim> sharedRims(std::span<const SourceElement> elements);

}  // namespace vasa
