#pragma once
#include <string>
#include <vector>

#include "body/body.h"

namespace vasa {

/// Leaves out what is no part of a person though it moves with one: a sword in a hand, a flag on the back,
/// the floor. Such a piece hangs together, follows one joint and reaches farther from the skeleton's links
/// than flesh, hair and clothes do. With it the body would be as tall as its sword, and the floor would be
/// its skin. What is named as bones, heart or organs stays, and so do limbs, which may be one piece each
/// without a joint of their own farther out. Nothing is left out where the skeleton is no person's. O(n log
/// n) in the vertices.
/// @return names of the meshes that had such pieces
std::vector<std::string> leaveOutProps(Body& body);

}  // namespace vasa
