#pragma once
#include <string>
#include <vector>

#include "body/body.h"

namespace vasa {

/// Takes joints out of a body that neither move anything nor tell how far what they hang on reaches: handles
/// of inverse kinematics, chains of controls beside the ones that deform. Vessels beside them would follow
/// them, and motions be carried to them, while the body follows others.
/// What moves nothing, with all that hangs on it, stays where its nearest vertex follows the nearest joint
/// above it that moves any (the end of a head, of toes), unless it lies at that joint's own place. The others
/// keep their order. Bodies without meshes stay as they are, those whose clips move only what would go,
/// and those of which less of a person would be known without it (a skin of head and chest alone).
/// O((joints + vertices) · log vertices)
/// @param body  as read: no axial bones; vertices at rest
/// @param keep  one a joint: stays whatever it moves
/// @return names of the joints that were taken out
std::vector<std::string> leaveOutIdleJoints(Body& body, const std::vector<bool>& keep);

}  // namespace vasa
