#pragma once
#include <string>

#include "mesh/triangle_mesh.h"

// One polygonal vessel to its axis with radii. What comes in may be torn, holed, in several pieces,
// branching, non-manifold or empty: what can be had is returned, with a reason for the rest.
namespace vasa {

/// An unbranched run of sections.
struct ElementBranch {
  std::vector<vec4>
      sections;  ///< centre x y z [m], radius sqrt(area / pi) [m]; at least 2, neighbours distinct
  std::uint32_t startNode = 0, endNode = 0;  ///< into ElementSkeleton::nodes
};

/// Where branches end. Each incident branch has its first or last section exactly here (with its own radius).
struct ElementNode {
  vec3 position{0};
  std::uint32_t valence = 0;  ///< 1: a free end
};

struct ElementSkeleton {
  std::vector<ElementNode> nodes;
  std::vector<ElementBranch> branches;  ///< empty where nothing could be made
  std::string method;  ///< "rings", "level sets", "rings and level sets"; empty without branches
  std::string reason;  ///< why something is missing or was degraded; empty when all is well
  std::uint32_t componentsTotal = 0, componentsUsed = 0;
  std::size_t triangles = 0;  ///< in all components: without doubles and what is flat
};

struct ElementOptions {
  float weldTolerance = 1e-5f;  ///< [m] vertices nearer than this are one
  float minimumRadius = 5e-5f;  ///< [m] thinner sections are raised to this; components thinner are dropped
  float detail = 2e-3f;         ///< [m] side branches and loops shorter than this are left out
  float debrisShare = 0.002f;   ///< components with less than this share of the element's area are debris
  float bridgeRadii = 3.0f;     ///< ends facing one another within so many radii are joined across the gap
  bool useRings = true;         ///< trace the source's own rings where it has them
};

/// The axis of an element.
/// Method: rings of the source where at least 85 % of the vertices lie in them (convert/rings.h); otherwise
/// level sets of the distance along the surface, joined into a Reeb graph (convert/reeb.h), pruned, and two
/// passes of slices at right angles to the axis (convert/reslice.h). Free ends reach the end of the surface;
/// pieces whose ends face one another are joined. Never throws on bad geometry, never fails: see `reason`.
/// Deterministic, single-threaded. O(n log n).
ElementSkeleton skeletonise(const TriangleMesh& mesh, const ElementOptions& options);

}  // namespace vasa
