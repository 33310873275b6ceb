#include "io/gltf_nodes.h"

#include <glm/gtc/matrix_transform.hpp>

#include "body/skeleton.h"
#include "core/log.h"

namespace vasa::gltf {
namespace {

mat4 localMatrix(const Model::Node& node) {
  if (!node.matrix.empty()) {
    mat4 matrix;
    for (int i = 0; i < 16; ++i)  // affine, whatever exporters round
      matrix[i / 4][i % 4] = i % 4 < 3 ? node.matrix[std::size_t(i)] : float(i == 15);
    return matrix;
  }
  return node.transform.matrix();
}

std::vector<int> depthFirst(const Model& model, const std::vector<int>& parent) {
  std::vector<int> order, waiting;
  for (int i = int(parent.size()) - 1; i >= 0; --i)
    if (parent[std::size_t(i)] < 0) waiting.push_back(i);
  while (!waiting.empty()) {
    const int node = waiting.back();
    waiting.pop_back();
    order.push_back(node);
    const auto& children = model.nodes[std::size_t(node)].children;
    waiting.insert(waiting.end(), children.rbegin(), children.rend());
  }
  return order;
}

std::vector<bool> sceneRoots(const Model& model) {
  if (!model.hasScenes) return std::vector<bool>(model.nodes.size(), true);
  std::vector<bool> root(model.nodes.size(), false);
  for (const int node : model.sceneNodes) root[std::size_t(node)] = true;
  return root;
}

}  // namespace

NodeTree resolveNodes(const Model& model, float unit) {
  NodeTree tree;
  if (unit != 1) tree.space = glm::scale(mat4(1), vec3(unit));
  const std::size_t count = model.nodes.size();
  tree.parent.assign(count, -1);
  for (std::size_t i = 0; i < count; ++i)
    for (const int child : model.nodes[i].children) tree.parent[std::size_t(child)] = int(i);
  tree.order = depthFirst(model, tree.parent);
  tree.local.resize(count);
  tree.world.resize(count);
  tree.inScene = sceneRoots(model);
  std::vector<bool> hidden(count, false);
  for (const int node : model.hidden) hidden[std::size_t(node)] = true;
  for (const int node : tree.order) {
    const auto i = std::size_t(node);
    const int parent = tree.parent[i];
    tree.local[i] = localMatrix(model.nodes[i]);
    tree.world[i] = (parent < 0 ? tree.space : tree.world[std::size_t(parent)]) * tree.local[i];
    if (parent >= 0) tree.inScene[i] = tree.inScene[i] || tree.inScene[std::size_t(parent)];
    if (parent >= 0 && hidden[std::size_t(parent)]) hidden[i] = true;
  }
  for (std::size_t i = 0; i < count; ++i) tree.inScene[i] = tree.inScene[i] && !hidden[i];
  return tree;
}

void warnOfUnseen(const Asset& asset, const NodeTree& tree) {
  std::size_t unseen = 0;
  std::string first;
  for (std::size_t i = 0; i < tree.inScene.size(); ++i) {
    const Model::Node& node = asset.model.nodes[i];
    if (node.mesh < 0 || tree.inScene[i]) continue;
    if (unseen++ == 0) first = node.name.empty() ? "node " + std::to_string(i) : node.name;
  }
  if (unseen > 0)
    logWarning(asset.name + ": meshes of " + std::to_string(unseen) +
               " nodes are hidden, or not in the scene that the file shows first, and left out: '" + first +
               (unseen > 1 ? "' first" : "'"));
}

}  // namespace vasa::gltf
