#pragma once
#include <vector>

#include "body/body.h"

namespace vasa {

/// Where a body's ribs meet its spine, at rest: twelve on the left from low to high, then twelve on the
/// right. Empty where its bones do not tell all of them (body/axial_bones.h), or its joints not which side is
/// which. Landmarks of a trunk that no rig misplaces.
std::vector<vec3> ribHeads(Body body);

}  // namespace vasa
