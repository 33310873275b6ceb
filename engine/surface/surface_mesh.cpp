#include "surface/surface_mesh.h"

namespace vasa {

SurfaceMesh surfaceMesh(const Network& network, std::span<const vec4> points, std::span<const quat> knotFrames,
                        const SweepShape& shape) {
  Surface surface = tessellate(network, points, knotFrames, shape);
  SurfaceMesh mesh;
  mesh.vesselOfVertex.resize(surface.positions.size());
  for (std::uint32_t vessel = 0; vessel + 1 < surface.firstTriangle.size(); ++vessel)
    for (std::uint32_t i = surface.firstTriangle[vessel]; i < surface.firstTriangle[vessel + 1]; ++i)
      for (int corner = 0; corner < 3; ++corner) mesh.vesselOfVertex[surface.triangles[i][corner]] = vessel;
  mesh.positions = std::move(surface.positions);
  mesh.normals = std::move(surface.normals);
  mesh.triangles = std::move(surface.triangles);
  return mesh;
}

}  // namespace vasa
