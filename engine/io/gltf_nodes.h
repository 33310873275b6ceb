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
  mat4 space{1};              ///< of the roots: scales a file that is not in metres
  std::vector<bool> inScene;  ///< below the default scene, everything where the file has none; not hidden
};

/// @param unit  metres a unit of the file
NodeTree resolveNodes(const Model& model, float unit = 1);

/// Says which meshes are not in it.
void warnOfUnseen(const Asset& asset, const NodeTree& tree);

}  // namespace vasa::gltf
