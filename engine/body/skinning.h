#pragma once
#include <span>
#include <vector>

#include "body/body.h"

namespace vasa {

/// One matrix a joint: from the space that meshes are bound in to the posed model space (pose · inverse
/// bind).
std::vector<mat4> skinMatrices(const Skeleton& skeleton, const Pose& pose);

/// With those of a body's axial bones, each as its carrier has it: at rest, or where nothing is bound to it.
std::vector<mat4> skinMatrices(const Body& body, const Pose& pose);

/// Linear blend skinning, the specification of what the GPU does: p' = Σ w (M p), and n' the unit vector
/// along Σ w (M_linear n). Using M itself for normals is exact for rotation and uniform scale, which is what
/// skeletons do; under other scales normals tilt a little.
/// @param matrices   from skinMatrices
/// @param positions  [m] resized to the mesh's; so is normals
void skinVertices(const SkinnedMesh& mesh, const std::vector<mat4>& matrices, std::vector<vec3>& positions,
                  std::vector<vec3>& normals);

/// One vertex of it.
vec3 skinnedPosition(const SkinnedMesh& mesh, std::span<const mat4> matrices, std::uint32_t vertex);

/// All of them without normals.
void skinPositions(const SkinnedMesh& mesh, const std::vector<mat4>& matrices, std::vector<vec3>& positions);

}  // namespace vasa
