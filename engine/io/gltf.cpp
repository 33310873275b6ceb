#include "io/gltf.h"

#include <map>

#include "body/skinning.h"
#include "core/log.h"
#include "io/gltf_asset.h"
#include "io/gltf_clips.h"
#include "io/gltf_geometry.h"
#include "io/gltf_nodes.h"
#include "io/gltf_rule.h"
#include "io/gltf_skeleton.h"

namespace vasa {
namespace {

using namespace gltf;

/// Runs a reader and turns what it throws into an Error that begins with the file's name.
template <class T, class Reader>
Result<T> reading(const std::filesystem::path& path, Reader read) {
  const std::string file = path.string() + ": ";
  try {
    return read();
  } catch (const BrokenRule& broken) {
    return badInput(file + broken.place + ": " + broken.rule + "; " + broken.remedy);
  } catch (const Error& error) {
    return error.message.starts_with(file) ? error : Error{error.fault, file + error.message};
  } catch (const std::bad_alloc&) {
    return badInput(file + "needs more memory than there is; split or reduce the asset");
  } catch (const std::exception& error) {
    return badInput(file + "cannot be read: " + error.what() + "; " + kExportAgain);
  }
}

std::string primitivePlace(int mesh, std::size_t primitive) {
  return "/meshes/" + std::to_string(mesh) + "/primitives/" + std::to_string(primitive);
}

std::string nameOf(const std::string& first, const std::string& second, int node) {
  if (!first.empty()) return first;
  return second.empty() ? "node " + std::to_string(node) : second;
}

vec4 colourOf(const tinygltf::Model& model, int material) {
  if (material < 0) return SkinnedMesh{}.colour;
  const auto& found = model.materials[std::size_t(material)];
  const auto& factor = found.pbrMetallicRoughness.baseColorFactor;
  vec4 colour(1);
  for (int i = 0; i < 4; ++i) colour[i] = float(factor[std::size_t(i)]);
  if (found.alphaMode != "BLEND") colour.a = 1;
  return colour;
}

/// Reads the meshes of a body; the parts that every mesh needs are held together here.
class BodyMeshes {
 public:
  BodyMeshes(const Asset& asset, const NodeTree& tree, const BodySkeleton& joints)
      : asset_(asset), tree_(tree), joints_(joints) {}

  std::vector<SkinnedMesh> read() {
    std::vector<SkinnedMesh> meshes;
    for (int node = 0; node < int(asset_.model.nodes.size()); ++node)
      if (asset_.model.nodes[std::size_t(node)].mesh >= 0 && tree_.inScene[std::size_t(node)])
        add(node, meshes);
    return meshes;
  }

 private:
  void add(int index, std::vector<SkinnedMesh>& meshes) {
    const auto& node = asset_.model.nodes[std::size_t(index)];
    const auto& mesh = asset_.model.meshes[std::size_t(node.mesh)];
    const std::string name = nameOf(mesh.name, node.name, index);
    const JointId carrier = node.skin < 0 ? carrierOf(index) : JointId{};
    if (node.skin < 0 && !carrier.valid()) {
      logWarning(asset_.name + ": nothing moves the mesh \"" + name + "\"; left out");
      return;
    }
    const auto byMaterial = geometries(node);
    for (const auto& [material, geometry] : byMaterial) {
      if (geometry.mesh.empty()) continue;
      meshes.push_back(node.skin >= 0 ? skinned(geometry, node.skin, name) : rigid(geometry, carrier, index));
      meshes.back().name = name;
      if (byMaterial.size() > 1 && material >= 0)
        meshes.back().name += "/" + asset_.model.materials[std::size_t(material)].name;
      meshes.back().colour = colourOf(asset_.model, material);
    }
  }

  std::map<int, Geometry> geometries(const tinygltf::Node& node) {
    std::map<int, Geometry> byMaterial;
    const auto& primitives = asset_.model.meshes[std::size_t(node.mesh)].primitives;
    for (std::size_t i = 0; i < primitives.size(); ++i)
      appendPrimitive(asset_, primitives[i], node.skin >= 0, primitivePlace(node.mesh, i), budget_,
                      byMaterial[primitives[i].material]);
    return byMaterial;
  }

  SkinnedMesh skinned(Geometry geometry, int skin, const std::string& name) const {
    if (geometry.mendedWeights > 0)
      logWarning(asset_.name + ": mesh \"" + name + "\": the weights of " +
                 std::to_string(geometry.mendedWeights) + " vertices did not sum to 1; mended");
    const auto& binding = joints_.skins[std::size_t(skin)];
    transform(geometry, binding.bake);
    SkinnedMesh out;
    for (const auto& influence : geometry.influences) {
      SkinInfluence to{{}, influence.weights};
      for (std::size_t i = 0; i < 4; ++i)
        to.joints[i] = std::uint16_t(binding.joints[influence.joints[i]].value);
      out.influences.push_back(to);
    }
    out.mesh = std::move(geometry.mesh);
    out.normals = std::move(geometry.normals);
    return out;
  }

  SkinnedMesh rigid(Geometry geometry, JointId carrier, int node) const {
    const auto& joint = joints_.skeleton.joints[carrier.value];
    transform(geometry, glm::inverse(joint.restWorld * joint.inverseBind) * tree_.world[std::size_t(node)]);
    SkinnedMesh out;
    out.influences.assign(geometry.mesh.positions.size(),
                          SkinInfluence{{std::uint16_t(carrier.value), 0, 0, 0}, vec4(1, 0, 0, 0)});
    out.mesh = std::move(geometry.mesh);
    out.normals = std::move(geometry.normals);
    return out;
  }

  JointId carrierOf(int node) const {
    for (; node >= 0; node = tree_.parent[std::size_t(node)])
      if (joints_.jointOfNode[std::size_t(node)].valid()) return joints_.jointOfNode[std::size_t(node)];
    return {};
  }

  const Asset& asset_;
  const NodeTree& tree_;
  const BodySkeleton& joints_;
  Budget budget_;
};

Body bodyOf(const Asset& asset) {
  if (asset.model.skins.empty())
    breaks("/skins", "a body needs a skeleton, and the file has no skin",
           "export the body with its armature");
  const NodeTree tree = resolveNodes(asset.model);
  BodySkeleton joints = buildSkeleton(asset, tree);
  Body body;
  body.name = asset.name;
  body.meshes = BodyMeshes(asset, tree, joints).read();
  body.clips = readClips(asset, joints.jointOfNode);
  body.skeleton = std::move(joints.skeleton);
  return body;
}

std::string extra(const tinygltf::Value& node, const tinygltf::Value& mesh, const char* key) {
  for (const auto* extras : {&node, &mesh})
    if (extras->IsObject() && extras->Get(key).IsString()) return extras->Get(key).Get<std::string>();
  return {};
}

std::vector<MeshElement> elementsOf(const Asset& asset) {
  const NodeTree tree = resolveNodes(asset.model);
  Budget budget;
  std::vector<MeshElement> elements;
  for (std::size_t i = 0; i < asset.model.nodes.size(); ++i) {
    const auto& node = asset.model.nodes[i];
    if (node.mesh < 0 || !tree.inScene[i]) continue;
    const auto& mesh = asset.model.meshes[std::size_t(node.mesh)];
    Geometry geometry;
    for (std::size_t k = 0; k < mesh.primitives.size(); ++k)
      appendPrimitive(asset, mesh.primitives[k], false, primitivePlace(node.mesh, k), budget, geometry);
    transform(geometry, tree.world[i]);
    elements.push_back({nameOf(node.name, mesh.name, int(i)), extra(node.extras, mesh.extras, "category"),
                        extra(node.extras, mesh.extras, "fma"), std::move(geometry.mesh)});
  }
  if (elements.empty()) breaks("/nodes", "no node of the scene has a mesh", "export the meshes too");
  return elements;
}

}  // namespace

Result<Body> readBody(const std::filesystem::path& path) {
  return reading<Body>(path, [&] { return bodyOf(loadAsset(path)); });
}

Result<std::vector<MeshElement>> readGltfElements(const std::filesystem::path& path) {
  return reading<std::vector<MeshElement>>(path, [&] { return elementsOf(loadAsset(path)); });
}

Result<GltfSummary> checkGltf(const std::filesystem::path& path) {
  return reading<GltfSummary>(path, [&] {
    const Asset asset = loadAsset(path);
    GltfSummary summary{asset.model.nodes.size(), asset.model.meshes.size(), asset.model.skins.size(),
                        asset.model.animations.size(), 0};
    return summary;
  });
}

}  // namespace vasa
