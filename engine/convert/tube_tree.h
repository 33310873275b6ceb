#pragma once
#include <span>
#include <vector>

#include "math/aabb.h"
#include "network/network.h"

namespace vasa {

/// A short piece of tube: a straight axis with a radius that changes linearly.
struct TubePiece {
  vec4 a, b;  ///< centres and radii
  std::uint32_t vessel = 0;
};

/// Cuts a vessel's sweeps into pieces, kPiecesPerSpan a span.
constexpr int kPiecesPerSpan = 6;
void appendPieces(std::span<const vec4> points, std::uint32_t vessel, std::vector<TubePiece>& pieces);

/// Bounding-box tree over pieces of tube, for distances to the tubes' walls. O(n log n) to build.
class TubeTree {
 public:
  explicit TubeTree(std::vector<TubePiece> pieces);

  struct Hit {
    float distance;  ///< to the wall [m], negative inside the tube
    float radius;    ///< there
    std::uint32_t vessel;
  };
  /// The wall nearest to p, inside or outside; `limit` and no vessel (kNone) if none is nearer than
  /// that.
  Hit nearestWall(vec3 p, float limit) const;
  /// Whether p lies deeper than `margin` inside a tube of another vessel than `own`.
  bool insideAnother(vec3 p, std::uint32_t own, float margin) const;

 private:
  struct Branch {
    Aabb box;  // of the tubes, not only their axes
    std::uint32_t first = 0, count = 0;
  };
  void build(std::uint32_t first, std::uint32_t count);

  std::vector<TubePiece> pieces_;
  std::vector<Branch> branches_;
};

}  // namespace vasa
