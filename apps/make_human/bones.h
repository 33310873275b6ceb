#pragma once
#include "body/body.h"
#include "make_human/shape.h"

namespace vasa::human {

/// The skeleton's bones as closed solids, each with weight 1 to one joint: tubes and balls of bones.csv, and
/// the free forms of `shape`, whose parts are united joint by joint.
Result<SkinnedMesh> makeBones(const std::filesystem::path& bones, const Shape& shape, const Rig& rig);

/// A shape's parts as closed solids, united joint by joint; each moves with its path's first joint.
SkinnedMesh makeSolid(std::string name, vec4 colour, const Shape& shape, const Rig& rig);

}  // namespace vasa::human
