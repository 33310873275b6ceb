#pragma once
#include <string>
#include <vector>

#include "body/body.h"
#include "io/gltf_asset.h"
#include "io/gltf_geometry.h"
#include "io/gltf_nodes.h"
#include "io/gltf_skeleton.h"
#include "mesh/mesh_element.h"

// What readBody and readGltfElements make of a checked file; see io/gltf.h for what they promise.
namespace vasa::gltf {

/// Whether there is a skeleton: a skin's, or without any skin that of rigid pieces that hang on one another
/// as a person's limbs do, by their names and places.
bool holdsBody(const Asset& asset);
Body bodyOf(const Asset& asset);
std::vector<MeshElement> elementsOf(const Asset& asset);

/// Throws BrokenRule where the scene's meshes, each counted as often as nodes use it, are more than memory
/// should hold: a few bytes of JSON can name a mesh any number of times.
/// @param vertexBytes  that a vertex takes in what is made
void checkExpandedSize(const Asset& asset, const NodeTree& tree, std::size_t vertexBytes);

/// The first name that is not empty, or the node's number.
std::string nameOf(const std::string& first, const std::string& second, int node);

/// Throws BrokenRule where a transform has made a position infinite.
void mustBeFinite(const std::vector<vec3>& positions, int node);

/// A mesh on the joints of a skin: vertices baked, joints renumbered. Name and colour are left to the caller.
SkinnedMesh onSkin(Geometry geometry, const BodySkeleton::Skin& skin);

}  // namespace vasa::gltf
