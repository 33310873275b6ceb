#pragma once
#include "body/body.h"

namespace vasa::test {

/// A closed box, every face with its own normal, that follows joint 0.
SkinnedMesh boxMesh(std::string name, vec3 low, vec3 high);

}  // namespace vasa::test
