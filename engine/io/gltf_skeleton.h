#pragma once
#include <vector>

#include "body/skeleton.h"
#include "io/gltf_asset.h"
#include "io/gltf_nodes.h"

namespace vasa::gltf {

/// One skeleton for all skins of a file.
struct BodySkeleton {
  Skeleton skeleton;
  std::vector<JointId> jointOfNode;  ///< one a node; invalid where the node is no joint
  struct Skin {
    std::vector<JointId> joints;  ///< one a joint of the skin
    /// What takes the skin's vertices to where the skeleton's inverse bind matrices expect them.
    mat4 bake{1};
  };
  std::vector<Skin> skins;
  /// Where the rest pose is not the one the file's nodes have: their transforms, one a joint, and what takes
  /// a joint from there to rest. Empty where both are the same.
  std::vector<JointTransform> fileRest;
  std::vector<mat4> fileToRest;
  /// Likewise, and the place at rest is the topmost joint's in the file's pose (io/gltf_binding.h).
  bool packedAndPosed = false;
};

/// Joints are the joints of all skins, and besides them every node that moves one of them or a mesh and
/// cannot be folded into rootTransform: nodes between joints, animated nodes above joints or meshes, and,
/// where the root joints hang under different transforms, all nodes above them. In a file without skins, what
/// carries meshes, or is a mesh with a place of its own.
///
/// The rest pose is the pose that the skin is bound in, for every command: what the nodes say may be any
/// frame of a motion (io/gltf_binding.h). Where that is so up to one transform (nearly every skin), that
/// transform is baked into its vertices and the inverse bind matrices become the inverses of the rest pose.
/// Then at rest the vertices are where they are stored, and skins bound in different spaces share joints. A
/// second skin bound in another pose keeps its matrices; a joint that would need two different ones is
/// doubled. Throws BrokenRule where a joint's matrix is no translation, rotation and scale.
BodySkeleton buildSkeleton(const Asset& asset, const NodeTree& tree);

}  // namespace vasa::gltf
