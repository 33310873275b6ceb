#pragma once
#include "body/body.h"
#include "make_human/bone_form.h"
#include "make_human/shape.h"

namespace vasa::human {

/// Meshes of bones, cartilage and teeth, in this order: every bone a closed smooth solid that moves with one
/// joint; of paired bones the right one is the left one mirrored. Parallel over bones, the same for any
/// number of threads.
std::vector<SkinnedMesh> makeBones(const std::vector<BoneForm>& forms, const Rig& rig);

/// Several meshes as one, with the first one's name and colour.
SkinnedMesh united(std::span<const SkinnedMesh> meshes);

/// A shape's parts as closed solids, united joint by joint; each moves with its path's first joint.
SkinnedMesh makeSolid(std::string name, vec4 colour, const Shape& shape, const Rig& rig);

}  // namespace vasa::human
