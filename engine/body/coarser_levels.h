#pragma once
#include <string>
#include <vector>

#include "body/body.h"

namespace vasa {

/// Takes out the meshes that are coarser levels of detail of another one of the body: of those whose names
/// differ by the number after "LOD" alone (Body_LOD0, Body_LOD1) the lowest number stays. Drawn together they
/// are as many skins, one in the other. O(meshes^2)
/// @return the names of what was taken out
std::vector<std::string> leaveOutCoarserLevels(Body& body);

}  // namespace vasa
