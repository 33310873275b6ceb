#pragma once
#include <array>
#include <string>
#include <vector>

#include "body/clip.h"
#include "body/skeleton.h"
#include "mesh/triangle_mesh.h"

namespace vasa {

/// Up to four joints that move a vertex by linear blend skinning; weights sum to 1.
struct SkinInfluence {
  std::array<std::uint16_t, 4> joints{};
  vec4 weights{0};
};

/// A mesh that moves with the skeleton.
struct SkinnedMesh {
  std::string name;   ///< e.g. "skin", "bones", "heart"; says what it is (body/mesh_role.h)
  TriangleMesh mesh;  ///< in the space of the inverse binds: as a rule model space at rest (see readBody)
  std::vector<vec3> normals;              ///< unit, one a vertex
  std::vector<SkinInfluence> influences;  ///< one a vertex
  vec4 colour{0.8f, 0.8f, 0.8f, 1};       ///< linear base colour and opacity
};

/// What a glTF file gives: skeleton, the meshes it moves, and motion.
struct Body {
  std::string name;  ///< file name, for messages
  Skeleton skeleton;
  std::vector<SkinnedMesh> meshes;
  std::vector<Clip> clips;

  /// Vertical extent of the meshes at rest, or of the joints if there are none [m].
  float height() const;
};

}  // namespace vasa
