#pragma once
#include <map>
#include <optional>
#include <utility>

#include "io/gltf_asset.h"
#include "io/gltf_json.h"
#include "io/gltf_rule.h"

// Our own complete check of a glTF 2.0 document. Each function throws BrokenRule at the first rule broken.
namespace vasa::gltf {

/// Everything that can be told from the JSON alone, before any data is touched.
void checkStructure(const JsonView& root);

/// Whether the file asks for no more than one of so many bytes may. Needs checkStructure.
void checkAmounts(const JsonView& root, std::size_t bytes);

/// Everything that needs the buffers' bytes, but for the keys of animations.
void checkData(const Asset& asset);

/// The keys of single animations, for which no body need be refused. What was found of an accessor is
/// remembered: many samplers may share one.
class AnimationChecks {
 public:
  /// @param asset  must outlive this
  explicit AnimationChecks(const Asset& asset) : asset_(&asset) {}
  void channel(const Model::Animation& animation, const Model::Channel& channel);

 private:
  const Asset* asset_;
  std::map<int, std::optional<BrokenRule>> times_;
  std::map<std::pair<int, bool>, std::optional<BrokenRule>> rotations_;
};

/// Whether an accessor's buffer view has a stride of its own. Only vertex attributes may: other readers take
/// what else has one as packed, and see other numbers than we.
bool hasStride(const JsonView& accessor, const std::vector<JsonView>& views);

/// One finite number a target.
void checkMorphWeights(const JsonView& weights, std::size_t targets);

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
