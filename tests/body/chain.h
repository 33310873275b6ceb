#pragma once
#include <vector>

#include "body/body.h"

namespace vasa::test {

/// A body without meshes and clips: a chain of joints, each the next one's parent.
Body chainBody(const std::vector<vec3>& centres);

/// A pose in which joints are turned by these rotations, beyond their rest rotation.
Pose turned(const Body& body, const std::vector<std::pair<std::uint32_t, quat>>& turns);

/// A two-frame clip from rest to a joint turned.
Clip turningClip(std::uint32_t joint, quat turn);

/// Points of parallel vessels on rings around an axis from `from` to `to`: vessel after vessel, `along` each.
std::vector<vec4> bundle(vec3 from, vec3 to, const std::vector<float>& distances, std::uint32_t around,
                         std::uint32_t along);

}  // namespace vasa::test
