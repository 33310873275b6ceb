#pragma once
#include <filesystem>
#include <vector>

#include "body/body.h"
#include "core/result.h"
#include "mesh/mesh_element.h"

// glTF 2.0, .gltf and .glb. Every file is checked completely before anything in it is used: container, JSON,
// every index, range and alignment, the forest of nodes, key times, finite values. A broken rule is
// Fault::badInput with "file: JSON place: rule; remedy"; a file that cannot be read is Fault::io. Pictures
// are never opened, and other files only where they lie in the asset's folder or below it. Morph targets are
// in as far as the file's weights say; what animations do to them, cameras and lights are ignored.
// Extensions: KHR_mesh_quantization is understood, meshes packed by EXT_meshopt_compression and
// KHR_draco_mesh_compression are unpacked; a file that requires any other that changes geometry is refused.
namespace vasa {

/// A body: skeleton, skinned meshes (one for each node and material), clips. The file must have a skin.
/// Skins are merged into one skeleton, meshes that hang on a joint without a skin follow it rigidly, and
/// meshes that nothing moves are left out with a warning. Weights that do not sum to 1 are mended with a
/// warning; more than four influences are cut to the strongest four. The rest pose is the one that the skin
/// with most joints is bound in, whatever pose the nodes have (that is kept by clips, in what they do not
/// move): positions and normals are those of the rest pose in model space, but for other skins bound in
/// another pose. What encloses the skeleton becomes the skin (body/skin_recognition.h). Joints that a VRM
/// file's table calls bones of a human bear its names.
Result<Body> readBody(const std::filesystem::path& path);

/// The same from memory. @param path  for messages, and whose folder holds the files beside it
Result<Body> parseBody(std::vector<std::byte> bytes, const std::filesystem::path& path);

/// One element for each node of the default scene that has a mesh, in the file's order: primitives merged, in
/// world coordinates, skinned ones in the rest pose, as above. The name is the node's; category and ontology
/// id are the node's (or the mesh's) extras "category" and "fma". A mesh that encodeGlb() wrote
/// (io/animated_mesh.h) is an element for each of its vessels.
Result<std::vector<MeshElement>> readGltfElements(const std::filesystem::path& path);
Result<std::vector<MeshElement>> parseGltfElements(std::vector<std::byte> bytes,
                                                   const std::filesystem::path& path);

struct GltfSummary {
  std::size_t nodes = 0, meshes = 0, skins = 0, animations = 0;
  bool body = false;  ///< whether readBody finds a skeleton
};

/// Counts what is in a file that can be read.
Result<GltfSummary> countGltf(const std::filesystem::path& path);

/// The same of a file that keeps all rules: also those of animations' keys, for which readBody leaves out the
/// animation alone.
Result<GltfSummary> checkGltf(const std::filesystem::path& path);

}  // namespace vasa
