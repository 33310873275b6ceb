#pragma once
#include <span>
#include <vector>

#include "math/types.h"
#include "mesh/triangle_mesh.h"
#include "render/camera.h"

namespace vasa {

struct SkinnedMesh;

/// Fewer triangles over the vertices of a mesh, for pictures in which it is small.
struct MeshLevel {
  float error;  ///< [m] about how far its surface lies from the mesh's (Garland and Heckbert 1997, quadrics)
  std::vector<uvec3> triangles;
};

/// Ever coarser levels, each with twice the error of the one before; ends where hardly a triangle goes.
/// Cost: about 0.1 s for 100,000 triangles.
std::vector<MeshLevel> coarserLevels(const TriangleMesh& mesh);

/// Vertices of a mesh that go with one joint above all others.
struct JointBall {
  std::uint32_t joint;
  vec3 centre;   ///< [m] at rest
  float radius;  ///< [m]
};

/// One ball a joint that moves some vertex.
std::vector<JointBall> jointBalls(const SkinnedMesh& mesh);

/// Side of a pixel [m] at the place nearest to the eye that the balls reach in this pose, in front of the
/// camera.
/// @param jointMatrices  world · inverseBind; a ball whose joint is beyond them stays at rest
float finestPixel(std::span<const JointBall> balls, std::span<const mat4> jointMatrices, const Camera& camera,
                  std::uint32_t pictureHeight);

}  // namespace vasa
