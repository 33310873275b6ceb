#pragma once
#include <array>
#include <string>
#include <vector>

#include "body/clip.h"
#include "body/skeleton.h"
#include "mesh/triangle_mesh.h"

namespace vasa {

/// Up to four joints, or axial bones of the body, that move a vertex by linear blend
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

/// A vertebra, a disc or a rib that moves by itself within what one joint carries. Influences name the kth by
/// the number of joints plus k.
struct AxialBone {
  JointId carrier;                 ///< the joint that carries it in the file
  JointId head;                    ///< the joint that ends its spine
  vec3 place{0};                   ///< [m] at rest: a vertebra's middle, a rib's front end
  std::uint32_t vertebra = kNone;  ///< of a rib: which of the axial bones before it it hangs on
  vec3 root{0};                    ///< [m] of a rib: where
  JointId frontCarrier;            ///< of a rib: carries what the front end is joined to; none: flesh does
};

/// What a glTF file gives: skeleton, the meshes it moves, and motion.
struct Body {
  std::string name;  ///< file name, for messages
  Skeleton skeleton;
  std::vector<SkinnedMesh> meshes;
  std::vector<Clip> clips;
  std::vector<AxialBone> axialBones;  ///< none as read: body/axial_bones.h

  /// The joint that carries what an influence names.
  std::uint32_t carrier(std::uint32_t influence) const {
    const std::size_t joints = skeleton.joints.size();
    return influence < joints ? influence : axialBones[influence - joints].carrier.value;
  }
  /// Extent of the meshes at rest along uprightAxis() (body/trunk.h), or of the joints if there are none [m].
  float height() const;
};

/// Gives a body some of its joints alone: meshes and clips go on with what each joint is now. What is left
/// out must move nothing; its tracks go.
void takeJoints(Body& body, JointsKept kept);

}  // namespace vasa
