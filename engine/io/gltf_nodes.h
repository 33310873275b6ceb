#pragma once
#include <vector>

#include "io/gltf_asset.h"
#include "math/types.h"

namespace vasa::gltf {

/// The forest of nodes, resolved; everything one a node.
struct NodeTree {
  std::vector<int> parent;  ///< -1 at a root
  std::vector<int> order;   ///< every node, parents before children, depth first
  std::vector<mat4> local;  ///< at rest, as the file has it
  std::vector<mat4> world;
  std::vector<bool> inScene;  ///< below the default scene; everything where the file has no scene
};

NodeTree resolveNodes(const Model& model);

}  // namespace vasa::gltf
