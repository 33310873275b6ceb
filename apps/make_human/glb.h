#pragma once
#include "body/body.h"
#include "make_human/rig.h"

namespace vasa::human {

/// The bytes of a binary glTF 2.0 file: the joints as nodes (rest rotations identity, inverse binds
/// translations), one skin, each mesh a node of its own, and the clips with linear keys. Every clip's tracks
/// must have equal times; translation tracks are only written where they have values.
std::vector<std::byte> writeGlb(const Rig& rig, const std::vector<SkinnedMesh>& meshes,
                                const std::vector<Clip>& clips);

}  // namespace vasa::human
