#pragma once
#include "body/body.h"

namespace vasa {

/// Finds the skin of a body whose meshes bear others' names, by what a skin is: the surface that the
/// skeleton's links lie in, a finger's breadth below it at least. Meshes that bend with the joints and do not
/// lie inside it (head, hair, clothes, sleeves of another material) belong to it; all of them become one
/// mesh, "skin: NAME, NAME ...". What moves by rigid parts and lies outside (a head, hair on it, shoes) comes
/// to them; as what encloses the links it is taken only where nothing else does, and what is named bones,
/// heart or organs only then, too. Bodies with a single mesh that bends and is named
/// skin or body are left alone, and those in which nothing encloses half of the links. O(n log n) in the
/// meshes' triangles.
void recogniseSkin(Body& body);

}  // namespace vasa
