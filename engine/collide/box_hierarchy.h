#pragma once
#include <span>
#include <vector>

#include "collide/bounding_boxes.h"
#include "collide/exclusions.h"
#include "collide/tube_surface.h"

namespace vasa {

/// A conventional hierarchy of boxes over the triangles of a tessellated network, as libraries for polygon
/// soups build it: what the paper's Table II compares with. A yardstick, not what the program uses.
///
/// A binary tree, halved at the median along its box's longest direction, first tubes and then the triangles
/// of each, so that whole pairs of tubes can be left out; a triangle a leaf. The halves follow from the
/// counts, so that a node is its box and nothing else. A node within a tube is fitted to the vertices below
/// it, one above to its children's corners. One thread.
template <class Box>
class BoxHierarchy {
 public:
  /// @param surface, exclusions  must outlive the hierarchy
  /// @param positions  [m] TubeSurface::shape(): of exclusions.tubeCount() tubes
  BoxHierarchy(const TubeSurface& surface, std::span<const vec3> positions, const Exclusions& exclusions);

  /// Fits all boxes to another shape of the same tubes, which must stay in place until detect() is done.
  void refit(std::span<const vec3> positions);

  /// Pairs of tubes, not excluded, of which two triangles cross; sorted; valid until the next call. One tube
  /// inside another is not found: no triangles cross.
  std::span<const TubePair> detect();

  /// Boxes, and the order of triangles and tubes; without the mesh.
  std::size_t bytes() const {
    return boxes_.size() * sizeof(Box) + (tubes_.size() + triangles_.size()) * sizeof(std::uint32_t);
  }

 private:
  // A node: its box, and the items below it (tubes in tubes_, or triangles of one tube in triangles_).
  struct Part {
    std::uint32_t box, first, count;
  };
  template <class Centre>
  void split(std::span<std::uint32_t> items, const Centre& centreOf);
  Part leftOf(const Part& part, std::uint32_t leaves) const;
  Part rightOf(const Part& part, std::uint32_t leaves) const;
  Part trianglesOf(const Part& tube) const;
  void fitTubes(const Part& part);
  void fitTriangles(const Part& part, std::uint32_t tube);
  void meetSelf(const Part& part);
  void meetTubes(const Part& a, const Part& b);
  bool meetTriangles(const Part& a, std::uint32_t tubeA, const Part& b, std::uint32_t tubeB) const;
  bool cross(std::uint32_t tubeA, std::uint32_t a, std::uint32_t tubeB, std::uint32_t b) const;

  const TubeSurface& surface_;
  const Exclusions& exclusions_;
  std::span<const vec3> positions_;
  std::vector<Box> boxes_;                // parents first, the left half's before the right's
  std::vector<std::uint32_t> tubes_;      // leaf -> tube
  std::vector<std::uint32_t> triangles_;  // of the tubes in that order: leaf -> triangle of the tube
  std::vector<vec3> scratch_;
  std::vector<TubePair> pairs_;
};

extern template class BoxHierarchy<AlignedBox>;
extern template class BoxHierarchy<OrientedBox>;

}  // namespace vasa
