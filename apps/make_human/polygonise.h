#pragma once
#include <functional>

#include "mesh/triangle_mesh.h"

namespace vasa::human {

struct ImplicitSurface {
  std::function<float(vec3)> distance;         ///< [m] negative inside, slope not far from 1
  std::function<float(vec3, float)> cellSize;  ///< [m] wanted size of the polygons within a radius of a point
  Aabb bounds;
  float certainty = 20;  ///< the distance may be wrong by this factor: beside thin lofted plates it is
};

/// A closed, outward-oriented mesh of the surface distance = 0: dual contouring on an octree (Ju, Losasso,
/// Schaefer, Warren 2002), its vertices then relaxed along the surface and put onto it.
/// @param coarse  [m] largest leaf; leaves are halved up to 3 times where a finer cell is wanted
TriangleMesh polygonise(const ImplicitSurface& surface, float coarse);

}  // namespace vasa::human
