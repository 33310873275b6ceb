#pragma once
#include <vector>

#include "body/body.h"

namespace vasa::human {

/// Of each of a body's clips, from the rest pose on always the pose that differs most from those chosen.
std::vector<Pose> extremePoses(const Body& body, int posesPerClip);

}  // namespace vasa::human
