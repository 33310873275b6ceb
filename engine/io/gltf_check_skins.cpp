#include <set>

#include "io/gltf_accessor.h"
#include "io/gltf_check.h"

namespace vasa::gltf {
namespace {

constexpr std::size_t kMaximumJoints = 65535;  // joints are numbered in 16 bits

void checkSkin(const JsonView& skin, const JsonView& root, const std::vector<JsonView>& accessors) {
  const std::size_t nodes = countOf(root, "nodes");
  const JsonView joints = skin.at("joints");
  if (joints.size() == 0 || joints.size() > kMaximumJoints)
    joints.fail("must hold between 1 and " + std::to_string(kMaximumJoints) + " joints, holds " +
                std::to_string(joints.size()));
  std::set<std::uint32_t> listed;
  for (const JsonView& joint : joints.items())
    if (!listed.insert(joint.index(nodes, "nodes")).second) joint.fail("is listed twice");
  if (const auto skeleton = skin.find("skeleton")) skeleton->index(nodes, "nodes");
  const auto matrices = skin.find("inverseBindMatrices");
  if (!matrices) return;
  const JsonView& accessor = accessors[matrices->index(accessors.size(), "accessors")];
  if (accessor.at("type").text() != "MAT4" ||
      !isFloatComponent(accessor.at("componentType").integer(0, 65535)))
    matrices->fail("inverse bind matrices must be MAT4 of floats");
  const auto count = std::size_t(accessor.at("count").integer(1, std::int64_t(1) << 40));
  if (count < joints.size())
    matrices->fail(std::to_string(count) + " matrices are too few for " + std::to_string(joints.size()) +
                   " joints");
}

// Place of a mesh's first primitive that has no joints; empty where all have.
std::string placeWithoutJoints(const JsonView& mesh) {
  for (const JsonView& primitive : mesh.at("primitives").items())
    if (!primitive.at("attributes").has("JOINTS_0")) return primitive.place();
  return {};
}

}  // namespace

void checkSkins(const JsonView& root) {
  const auto accessors = root.items("accessors");
  for (const JsonView& skin : root.items("skins")) checkSkin(skin, root, accessors);
  std::vector<std::string> withoutJoints;
  for (const JsonView& mesh : root.items("meshes")) withoutJoints.push_back(placeWithoutJoints(mesh));
  for (const JsonView& node : root.items("nodes")) {
    if (!node.has("skin")) continue;
    const std::string& place = withoutJoints[node.at("mesh").index(withoutJoints.size(), "meshes")];
    if (!place.empty()) node.at("skin").fail("the mesh has no joints and weights: see " + place);
  }
}

}  // namespace vasa::gltf
