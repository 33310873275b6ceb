#pragma once
#include <vector>

#include "body/skeleton.h"

namespace vasa::gltf {

/// A skin's joints and where each is told to be when the skin is bound.
struct BoundSkin {
  std::vector<JointId> joints;
  std::vector<mat4> inverseBinds;  ///< one a joint
  /// Its vertices are stored as integers (KHR_mesh_quantization): the matrices also bring them to their size
  /// and place, which the file tells of nowhere else.
  bool packed = false;
};

/// The skin with most joints, the first of equals; or null where there is none.
const BoundSkin* largestSkin(const std::vector<BoundSkin>& skins);

/// The largest between elements of two matrices.
float difference(const mat4& a, const mat4& b);

/// Moves a skeleton from the pose that a file's nodes have (a frame of some motion, as a rule) to the one in
/// which its largest skin is bound; joints that no skin binds keep their place beside their parent.
///
/// What space the inverse bind matrices are in is not told by the file: of the world and the space of the
/// nodes above the joints, upright or turned by right angles, the one in which the links point most as they
/// do in the nodes' pose, in the unit in which they are as long. That of packed vertices is their own: its
/// unit is what the matrices have to that of the nodes, and its place is such that the skin's topmost joint
/// stays where the nodes have it.
/// @return whether anything moved. False where the skin is bound in the nodes' pose already, up to one
/// transform, and where the matrices are none of joints (with shear, not invertible, or all in one place)
bool restAtBinding(Skeleton& skeleton, const std::vector<BoundSkin>& skins);

}  // namespace vasa::gltf
