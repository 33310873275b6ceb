#pragma once
#include <span>
#include <vector>

#include "math/types.h"
#include "mesh/triangle_mesh.h"
#include "render/camera.h"

namespace vasa {

struct SkinnedMesh;
struct Skeleton;

/// A mesh with fewer triangles, or the mesh itself. It has vertices of its own, so that only those that it
/// needs are moved.
struct MeshLevel {
  float error;  ///< [m] about how far its surface lies from the mesh's (Garland and Heckbert 1997, quadrics)
  std::vector<std::uint32_t> vertices;  ///< of the mesh; one may be there several times
  std::vector<vec3> normals;  ///< unit, one a vertex: the mesh's, turned where a triangle is far from them
  std::vector<uvec3>
      triangles;  ///< of places in `vertices`, in an order in which a vertex is shaded about once
};

struct LevelledMesh {
  std::vector<MeshLevel> levels;  ///< the mesh itself, then ever coarser ones
  bool closed = false;            ///< isClosed(): from outside, the backs of its triangles are never seen
};

/// The mesh alone, as it is, and not looked at whether it is closed.
LevelledMesh oneLevel(const SkinnedMesh& mesh);
/// The mesh, then ever coarser levels, each with √2 times the error of the one before at least; ends at 1 cm
/// or where hardly a triangle goes. A straight arm at rest needs no vertices at its elbow, a bent one does:
/// where a skeleton is given, what bends with it is made coarser with all joints bent. Cost: about 0.5 s for
/// 100,000 triangles.
LevelledMesh coarserLevels(const SkinnedMesh& mesh, const Skeleton* skeleton = nullptr);

/// Levels of each of a body's meshes. Renderers of one body can share them (RenderOptions::levels).
using BodyLevels = std::vector<LevelledMesh>;
/// coarserLevels() of each, several at a time, or what an earlier run kept of them (core/kept.h).
BodyLevels bodyLevels(std::span<const SkinnedMesh> meshes, const Skeleton* skeleton = nullptr);

/// Every piece of it has a closed surface that faces outwards.
bool isClosed(const TriangleMesh& mesh);

/// Vertices of a mesh that go with one joint above all others.
struct JointBall {
  std::uint32_t joint;
  vec3 centre;   ///< [m] at rest
  float radius;  ///< [m]
};

/// One ball a joint that moves some vertex.
std::vector<JointBall> jointBalls(const SkinnedMesh& mesh);

/// How far before the eye [m] the nearest place lies that the balls reach in this pose; those wholly behind
/// the camera's near plane do not count. The camera's farDistance where there is none.
/// @param jointMatrices  world · inverseBind; a ball whose joint is beyond them stays at rest
float nearestDepth(std::span<const JointBall> balls, std::span<const mat4> jointMatrices,
                   const Camera& camera);

/// Side of a pixel [m] at a depth, or at the near plane where that is farther away.
float pixelAt(float depth, const Camera& camera, std::uint32_t pictureHeight);

}  // namespace vasa
