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
};

/// Joints are the joints of all skins, and besides them every node that moves one of them or a mesh and
/// cannot be folded into rootTransform: nodes between joints, animated nodes above joints or meshes, and,
/// where the root joints hang under different transforms, all nodes above them.
///
/// Where a skin's rest pose is its binding pose up to one transform (nearly every file), that transform is
/// baked into its vertices and the inverse bind matrices become the inverses of the rest pose. Then at rest
/// the vertices are where they are stored, and skins bound in different spaces share joints. Any other skin
/// keeps its matrices; a joint that would need two different ones is doubled. Throws BrokenRule where a
/// joint's matrix is no translation, rotation and scale.
BodySkeleton buildSkeleton(const Asset& asset, const NodeTree& tree);

}  // namespace vasa::gltf
