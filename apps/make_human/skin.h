#pragma once
#include "body/body.h"
#include "make_human/shape.h"

namespace vasa::human {

/// The closed skin of a shape, with normals and weights. A part's path of joints moves what lies near it,
/// each joint passing to the next over its blend length; parts that meet share by their distances; at last
/// the weights are smoothed over the mesh.
SkinnedMesh makeSkin(const Shape& shape, const Rig& rig);

}  // namespace vasa::human
