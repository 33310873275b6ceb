#include <cmath>
#include <set>

#include "io/gltf_check.h"

namespace vasa::gltf {
namespace {

// Exporters round; further off is an error and not rounding.
constexpr double kUnitTolerance = 0.01, kAffineTolerance = 1e-5;

void checkTransform(const JsonView& node) {
  const auto translation = node.find("translation"), rotation = node.find("rotation"),
             scale = node.find("scale");
  if (translation) translation->numbers(3);
  if (scale) scale->numbers(3);
  if (rotation) {
    const auto q = rotation->numbers(4);
    const double length = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    if (std::abs(length - 1) > kUnitTolerance)
      rotation->fail("must be a unit quaternion, has length " + std::to_string(length), "normalise it");
  }
  if (const auto matrix = node.find("matrix")) {
    const auto m = matrix->numbers(16);
    if (translation || rotation || scale)
      matrix->fail("must not be given beside translation, rotation or scale");
    const auto off = [](double value, double wanted) { return std::abs(value - wanted) > kAffineTolerance; };
    if (off(m[3], 0) || off(m[7], 0) || off(m[11], 0) || off(m[15], 1))
      matrix->fail("must be affine: the last row must be 0 0 0 1");
  }
}

void checkReferences(const JsonView& node, const JsonView& root, const std::vector<JsonView>& meshes) {
  const struct {
    const char *key, *array;
  } references[] = {{"mesh", "meshes"}, {"skin", "skins"}, {"camera", "cameras"}};
  for (const auto& [key, array] : references)
    if (const auto index = node.find(key)) index->index(countOf(root, array), array);
  if (node.has("skin") && !node.has("mesh")) node.at("skin").fail("must not be given without a mesh");
  const auto weights = node.find("weights");
  if (!weights) return;
  if (!node.has("mesh")) weights->fail("must not be given without a mesh");
  const JsonView& mesh = meshes[node.at("mesh").index(meshes.size(), "meshes")];
  const std::size_t targets = countOf(mesh.at("primitives").first(), "targets");
  checkMorphWeights(*weights, targets);
}

// Every node has at most one parent. Then a walk down from the parentless nodes reaches every node that is on
// no cycle, and none twice: nodes left over are on cycles or below one.
std::vector<std::int64_t> checkForest(const std::vector<JsonView>& nodes) {
  std::vector<std::int64_t> parent(nodes.size(), -1);
  std::vector<std::vector<std::uint32_t>> children(nodes.size());
  for (std::size_t i = 0; i < nodes.size(); ++i)
    for (const JsonView& item : nodes[i].items("children")) {
      const std::uint32_t child = item.index(nodes.size(), "nodes");
      if (child == i) item.fail("node " + std::to_string(i) + " is its own child");
      if (parent[child] >= 0)
        item.fail("node " + std::to_string(child) + " is already a child of node " +
                  std::to_string(parent[child]));
      parent[child] = std::int64_t(i);
      children[i].push_back(child);
    }
  std::vector<std::uint32_t> reached;
  for (std::size_t i = 0; i < nodes.size(); ++i)
    if (parent[i] < 0) reached.push_back(std::uint32_t(i));
  std::vector<bool> seen(nodes.size());
  for (std::size_t next = 0; next < reached.size(); ++next) {
    seen[reached[next]] = true;
    for (const std::uint32_t child : children[reached[next]]) reached.push_back(child);
  }
  for (std::size_t i = 0; i < nodes.size(); ++i)
    if (!seen[i]) nodes[i].fail("is on or below a cycle of nodes");
  return parent;
}

void checkScenes(const JsonView& root, const std::vector<std::int64_t>& parent) {
  for (const JsonView& scene : root.items("scenes")) {
    std::set<std::uint32_t> listed;
    for (const JsonView& item : scene.items("nodes")) {
      const std::uint32_t node = item.index(parent.size(), "nodes");
      if (!listed.insert(node).second) item.fail("node " + std::to_string(node) + " is listed twice");
      if (parent[node] >= 0) item.fail("node " + std::to_string(node) + " is not a root: it has a parent");
    }
  }
  if (const auto scene = root.find("scene")) scene->index(countOf(root, "scenes"), "scenes");
}

}  // namespace

void checkNodes(const JsonView& root) {
  const auto nodes = root.items("nodes"), meshes = root.items("meshes");
  for (const JsonView& node : nodes) {
    checkTransform(node);
    checkReferences(node, root, meshes);
  }
  checkScenes(root, checkForest(nodes));
}

}  // namespace vasa::gltf
