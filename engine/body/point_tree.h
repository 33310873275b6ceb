#pragma once
#include <nanoflann.hpp>
#include <vector>

#include "math/types.h"

namespace vasa {

/// Points as nanoflann wants to see them.
struct PointCloud {
  std::vector<vec3> points;
  std::size_t kdtree_get_point_count() const { return points.size(); }
  float kdtree_get_pt(std::size_t i, std::size_t axis) const { return points[i][int(axis)]; }
  template <class Box>
  bool kdtree_get_bbox(Box&) const {
    return false;
  }
};

/// Nearest points of a cloud, by squared distance. The cloud must outlive the tree.
using PointTree =
    nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<float, PointCloud>, PointCloud, 3>;

}  // namespace vasa
