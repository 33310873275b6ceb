#pragma once
#include <array>
#include <string>
#include <vector>

#include "body/clip.h"
#include "body/skeleton.h"
#include "mesh/triangle_mesh.h"

namespace vasa {

/// Up to four joints, or vertebrae of the body (Body::vertebrae), that move a vertex by linear blend
/// skinning; weights sum to 1.
struct SkinInfluence {
  std::array<std::uint16_t, 4> joints{};
  vec4 weights{0};

  /// Which of the four weighs most; the first of equals.
  std::size_t heaviest() const {
    std::size_t most = 0;
    for (std::size_t k = 1; k < 4; ++k)
      if (weights[int(k)] > weights[int(most)]) most = k;
    return most;
  }
};

/// A mesh that moves with the skeleton.
struct SkinnedMesh {
  std::string name;   ///< e.g. "skin", "bones", "heart"; says what it is (body/mesh_role.h)
  TriangleMesh mesh;  ///< in the space of the inverse binds: as a rule model space at rest (see readBody)
  std::vector<vec3> normals;              ///< unit, one a vertex
  std::vector<SkinInfluence> influences;  ///< one a vertex
  vec4 colour{0.8f, 0.8f, 0.8f, 1};       ///< linear base colour and opacity
};

/// A bone of its own within what one joint carries. Influences name the kth by the number of joints plus k.
struct Vertebra {
  JointId carrier;  ///< the joint that carries it in the file
  JointId head;     ///< the joint that ends its spine
  vec3 centre{0};   ///< [m] model space, at rest
};

/// What a glTF file gives: skeleton, the meshes it moves, and motion.
struct Body {
  std::string name;  ///< file name, for messages
  Skeleton skeleton;
  std::vector<SkinnedMesh> meshes;
  std::vector<Clip> clips;
  std::vector<Vertebra> vertebrae;  ///< none as read: body/vertebrae.h

  /// The joint that carries what an influence names.
  std::uint32_t carrier(std::uint32_t influence) const {
    const std::size_t joints = skeleton.joints.size();
    return influence < joints ? influence : vertebrae[influence - joints].carrier.value;
  }
  /// Vertical extent of the meshes at rest, or of the joints if there are none [m].
  float height() const;
};

}  // namespace vasa
