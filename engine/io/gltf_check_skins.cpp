#include <set>
#include <utility>

#include "io/gltf_accessor.h"
#include "io/gltf_check.h"

namespace vasa::gltf {
namespace {

constexpr std::size_t kMaximumJoints = 65535;  // joints are numbered in 16 bits

// The root of each node's tree.
std::vector<std::uint32_t> rootsOf(const JsonView& root) {
  const auto nodes = root.items("nodes");
  std::vector<std::uint32_t> rootOf(nodes.size());
  for (std::uint32_t i = 0; i < nodes.size(); ++i) rootOf[i] = i;
  for (std::uint32_t i = 0; i < nodes.size(); ++i)
    for (const JsonView& child : nodes[i].items("children")) rootOf[child.index(nodes.size(), "nodes")] = i;
  // So far parents; each walk up shortens the way for the next.
  for (std::uint32_t i = 0; i < nodes.size(); ++i) {
    std::uint32_t top = i;
    while (rootOf[top] != top) top = rootOf[top];
    for (std::uint32_t at = i; rootOf[at] != top;) at = std::exchange(rootOf[at], top);
  }
  return rootOf;
}

void checkSkin(const JsonView& skin, const JsonView& root, const std::vector<JsonView>& accessors,
               const std::vector<std::uint32_t>& rootOf) {
  const std::size_t nodes = countOf(root, "nodes");
  const JsonView joints = skin.at("joints");
  if (joints.size() == 0 || joints.size() > kMaximumJoints)
    joints.fail("must hold between 1 and " + std::to_string(kMaximumJoints) + " joints, holds " +
                std::to_string(joints.size()));
  std::set<std::uint32_t> listed;
  for (const JsonView& joint : joints.items()) {
    const std::uint32_t node = joint.index(nodes, "nodes");
    if (!listed.insert(node).second) joint.fail("is listed twice");
    if (rootOf[node] != rootOf[joints.first().index(nodes, "nodes")])
      joint.fail("node " + std::to_string(node) + " and the first joint have no common root",
                 "put all joints below one node");
  }
  if (const auto skeleton = skin.find("skeleton")) skeleton->index(nodes, "nodes");
  const auto matrices = skin.find("inverseBindMatrices");
  if (!matrices) return;
  const JsonView& accessor = accessors[matrices->index(accessors.size(), "accessors")];
  if (accessor.at("type").text() != "MAT4" ||
      !isFloatComponent(accessor.at("componentType").integer(0, 65535)))
    matrices->fail("inverse bind matrices must be MAT4 of floats");
  if (hasStride(accessor, root.items("bufferViews")))
    matrices->fail("inverse bind matrices must lie one behind the other, without a byteStride");
  const auto count = std::size_t(accessor.at("count").integer(1, std::int64_t(1) << 40));
  if (count < joints.size())
    matrices->fail(std::to_string(count) + " matrices are too few for " + std::to_string(joints.size()) +
                   " joints");
}

// A mesh's first primitive that has no joints; none where all have.
std::optional<JsonView> withoutJoints(const JsonView& mesh) {
  for (const JsonView& primitive : mesh.at("primitives").items())
    if (!primitive.at("attributes").has("JOINTS_0")) return primitive;
  return std::nullopt;
}

}  // namespace

void checkSkins(const JsonView& root) {
  const auto accessors = root.items("accessors");
  const auto rootOf = rootsOf(root);
  for (const JsonView& skin : root.items("skins")) checkSkin(skin, root, accessors, rootOf);
  std::vector<std::optional<JsonView>> bare;
  for (const JsonView& mesh : root.items("meshes")) bare.push_back(withoutJoints(mesh));
  for (const JsonView& node : root.items("nodes")) {
    if (!node.has("skin")) continue;
    const auto& primitive = bare[node.at("mesh").index(bare.size(), "meshes")];
    if (primitive) node.at("skin").fail("the mesh has no joints and weights: see " + primitive->place());
  }
}

}  // namespace vasa::gltf
