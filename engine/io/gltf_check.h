#pragma once
#include "io/gltf_asset.h"
#include "io/gltf_json.h"

// Our own complete check of a glTF 2.0 document. Each function throws BrokenRule at the first rule broken.
namespace vasa::gltf {

/// Everything that can be told from the JSON alone, before any data is touched.
void checkStructure(const JsonView& root);

/// Everything that needs the buffers' bytes.
void checkData(const Asset& asset);

// The topics of checkStructure, in its order.
void checkHead(const JsonView& root);        ///< asset version, extensions, kinds of the top-level arrays
void checkBuffers(const JsonView& root);     ///< buffers and buffer views
void checkAccessors(const JsonView& root);   ///< layout, alignment and bounds, sparse parts included
void checkMaterials(const JsonView& root);   ///< colours; references to textures, images, samplers
void checkMeshes(const JsonView& root);      ///< attributes, indices, modes, morph targets
void checkNodes(const JsonView& root);       ///< transforms, the forest, scenes
void checkSkins(const JsonView& root);       ///< joints, inverse bind matrices, nodes that use them
void checkAnimations(const JsonView& root);  ///< samplers and channels

}  // namespace vasa::gltf
