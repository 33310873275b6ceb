#pragma once
#include <optional>

#include "mesh/edges.h"
#include "mesh/triangle_tree.h"

namespace vasa {

/// Where a plane cuts a mesh: a polygon in that plane.
struct Contour {
  std::vector<vec3> points;
  bool closed = false;
};

/// Area, centroid and shape of a contour about a plane's normal; an open one is closed by its chord.
struct SectionShape {
  vec3 centre{0};     ///< area centroid
  float radius = 0;   ///< sqrt(area / pi)
  float nearest = 0;  ///< least and greatest distance from the centre to a corner: how round it is
  float farthest = 0;
  float perimeter = 0;    ///< without the chord
  float chord = 0;        ///< length of the closing chord, 0 where closed
  bool contains = false;  ///< the plane's point lies inside
};

/// Cuts a mesh by planes. Holds references: mesh, edges and tree must outlive it. Not for several threads.
class Slicer {
 public:
  /// Of BodyParts3D's vessels none needs more than 97. Of few triangles all may be met by each of thousands
  /// of planes, as of a straight tube of two rings, so that a mesh counts as this many at least.
  static constexpr std::size_t kMostCuts = 1000, kFewTriangles = 200;

  Slicer(const TriangleMesh& mesh, const MeshEdges& edges, const TriangleTree& tree)
      : mesh_(mesh), edges_(edges), tree_(tree) {}

  /// The contours of the plane through `onPlane` among the triangles within `reach` of it. They follow the
  /// mesh's edges, so they are exact; a contour that leaves the reach, or meets a border, is open.
  /// @param normal  unit
  const std::vector<Contour>& cut(vec3 onPlane, vec3 normal, float reach);

  /// The shape of the contour around the point: the smallest one that contains it, or else the one whose
  /// centroid is nearest and within `reach / 2`. None where there is no such contour, or where what is there
  /// is open by more than 40 % of its outline. None any more where planes have met the mesh's triangles
  /// kMostCuts times each, as in a tangle that every plane meets everywhere.
  std::optional<SectionShape> section(vec3 onPlane, vec3 normal, float reach);

 private:
  const TriangleMesh& mesh_;
  const MeshEdges& edges_;
  const TriangleTree& tree_;
  std::vector<std::uint32_t> candidates_;
  std::vector<Contour> contours_;
  std::size_t met_ = 0;  // triangles by planes, so far
};

SectionShape shapeOf(const Contour& contour, vec3 onPlane, vec3 normal);

}  // namespace vasa
