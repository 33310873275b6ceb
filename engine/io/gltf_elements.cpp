#include <algorithm>
#include <map>
#include <optional>

#include "body/skinning.h"
#include "core/ids.h"
#include "io/colour_runs.h"
#include "io/gltf_accessor.h"
#include "io/gltf_body.h"
#include "io/gltf_rule.h"

namespace vasa::gltf {
namespace {

constexpr int kNodesAbove = 8;  // collections are not nested deeper, and chains of nodes may be long

// A skinned node's place comes from its joints; its own transform counts for nothing.
struct RestPose {
  BodySkeleton joints;
  std::vector<mat4> matrices;
};

RestPose restOf(const Asset& asset, const NodeTree& tree) {
  RestPose rest{buildSkeleton(asset, tree), {}};
  rest.matrices = skinMatrices(rest.joints.skeleton, restPose(rest.joints.skeleton));
  return rest;
}

TriangleMesh atRest(Geometry geometry, int skin, const RestPose& rest) {
  SkinnedMesh mesh = onSkin(std::move(geometry), rest.joints.skins[std::size_t(skin)]);
  std::vector<vec3> positions;
  skinPositions(mesh, rest.matrices, positions);
  mesh.mesh.positions = std::move(positions);
  return std::move(mesh.mesh);
}

// The node's, or else its mesh's.
Model::Labels labelsOf(const Model& model, int node) {
  Model::Labels labels;
  if (const auto own = model.nodeLabels.find(node); own != model.nodeLabels.end()) labels = own->second;
  const auto mesh = model.meshLabels.find(model.nodes[std::size_t(node)].mesh);
  if (mesh == model.meshLabels.end()) return labels;
  if (labels.category.empty()) labels.category = mesh->second.category;
  if (labels.ontologyId.empty()) labels.ontologyId = mesh->second.ontologyId;
  return labels;
}

// Longer ones name nothing that a reader knows, and each element has a copy.
constexpr std::size_t kLongestName = 256;

// From near to far; what is said of the element itself first.
std::vector<std::string> surroundingsOf(const Model& model, const NodeTree& tree, int node) {
  std::vector<std::string> names;
  const auto& mesh = model.meshes[std::size_t(model.nodes[std::size_t(node)].mesh)];
  const auto add = [&](const std::string& name) {
    const bool counts = !name.empty() && name.size() <= kLongestName;
    if (counts && std::ranges::find(names, name) == names.end()) names.push_back(name);
  };
  add(mesh.name);
  for (const auto& primitive : mesh.primitives)
    if (primitive.material >= 0) add(model.materials[std::size_t(primitive.material)].name);
  for (int at = tree.parent[std::size_t(node)], depth = 0; at >= 0 && depth < kNodesAbove;
       at = tree.parent[std::size_t(at)], ++depth)
    add(model.nodes[std::size_t(at)].name);
  return names;
}

// Colours of a primitive's vertices; empty where it has none.
std::vector<vec3> coloursOf(const Asset& asset, const Model::Primitive& primitive) {
  if (primitive.colour < 0) return {};
  const Model::Accessor& accessor = asset.model.accessors[std::size_t(primitive.colour)];
  const std::size_t each = elementLayout(accessor).components();
  if ((each != 3 && each != 4) || !hasData(asset, primitive.colour)) return {};
  const std::vector<float> values = readFloats(asset, primitive.colour);
  std::vector<vec3> colours(values.size() / each);
  for (std::size_t i = 0; i < colours.size(); ++i)
    colours[i] = {values[each * i], values[each * i + 1], values[each * i + 2]};
  return colours;
}

// What the triangles from `first` on are drawn with, a primitive's: its material, or its vertices' colours.
void addMaterials(const Asset& asset, const Model::Primitive& primitive, const TriangleMesh& mesh,
                  std::size_t firstVertex, std::uint32_t first, std::vector<MeshMaterial>& materials) {
  MeshMaterial own{{}, {}, first};
  if (primitive.material >= 0) {
    const auto& told = asset.model.materials[std::size_t(primitive.material)];
    if (told.name.size() <= kLongestName) own.name = told.name;
    own.colour = vec3(told.baseColour);
  }
  if (mesh.triangles.size() == first)
    return materials.push_back(std::move(own));  // nothing is drawn with them
  const std::vector<vec3> colours = coloursOf(asset, primitive);
  if (colours.empty()) return materials.push_back(std::move(own));
  addColourRuns(mesh, first, mesh.triangles.size(), colours, firstVertex, own, materials);
}

std::optional<vec3> colourTold(std::span<const MeshMaterial> materials) {
  const auto told =
      std::ranges::find_if(materials, [](const MeshMaterial& own) { return own.colour.has_value(); });
  return told == materials.end() ? std::nullopt : told->colour;
}

// Ours (io/animated_mesh.h): in the place of the last element one for each of its vessels that has triangles,
// and one for triangles that are of none. A triangle is its first corner's.
void takeApart(std::span<const Model::VesselLabel> labels, std::span<const std::uint32_t> vesselOf,
               std::vector<MeshElement>& elements) {
  const MeshElement whole = std::move(elements.back());
  elements.pop_back();
  std::map<std::size_t, std::vector<uvec3>> own;  // of those that have any
  for (const uvec3& t : whole.mesh.triangles)
    own[std::min<std::size_t>(vesselOf[t.x], labels.size())].push_back(t);
  std::vector<std::uint32_t> numbers(whole.mesh.positions.size(), kNone);  // in the element being made
  for (auto& [k, triangles] : own) {
    MeshElement element{whole.name, whole.category, whole.ontologyId, {}, whole.surroundings, {}, {}};
    if (k < labels.size()) {
      element.name = labels[k].name, element.category = labels[k].kind,
      element.ontologyId = labels[k].ontologyId;
      // The mesh's materials are those of all kinds.
      if (!element.category.empty())
        std::erase_if(element.surroundings, [&](const std::string& name) {
          return std::ranges::find(whole.materials, name, &MeshMaterial::name) != whole.materials.end();
        });
    }
    std::vector<std::uint32_t> used;
    for (uvec3& t : triangles)
      for (int c = 0; c < 3; ++c) {
        std::uint32_t& number = numbers[t[c]];
        if (number == kNone) {
          number = std::uint32_t(used.size());
          used.push_back(t[c]);
          element.mesh.positions.push_back(whole.mesh.positions[t[c]]);
        }
        t[c] = number;
      }
    for (const std::uint32_t vertex : used) numbers[vertex] = kNone;
    element.mesh.triangles = std::move(triangles);
    elements.push_back(std::move(element));
  }
}

}  // namespace

std::vector<MeshElement> elementsOf(const Asset& asset) {
  const NodeTree tree = resolveNodes(asset.model);
  std::optional<RestPose> rest;
  checkExpandedSize(asset, tree, sizeof(vec3));
  warnOfUnseen(asset, tree);
  std::vector<MeshElement> elements;
  for (std::size_t i = 0; i < asset.model.nodes.size(); ++i) {
    const auto& node = asset.model.nodes[i];
    if (node.mesh < 0 || !tree.inScene[i]) continue;
    const auto& mesh = asset.model.meshes[std::size_t(node.mesh)];
    Geometry geometry;
    std::vector<MeshMaterial> materials;
    for (const auto& primitive : mesh.primitives) {
      const std::size_t vertices = geometry.mesh.positions.size();
      const auto triangles = std::uint32_t(geometry.mesh.triangles.size());
      appendPrimitive(asset, primitive, weightsOf(asset.model, node), node.skin >= 0, geometry);
      addMaterials(asset, primitive, geometry.mesh, vertices, triangles, materials);
    }
    const std::vector<std::uint32_t> vessels = std::move(geometry.vessels);
    if (node.skin < 0)
      transform(geometry, tree.world[i]);
    else if (!rest)
      rest = restOf(asset, tree);
    Model::Labels labels = labelsOf(asset.model, int(i));
    elements.push_back(
        {nameOf(node.name, mesh.name, int(i)), std::move(labels.category), std::move(labels.ontologyId),
         node.skin < 0 ? std::move(geometry.mesh) : atRest(std::move(geometry), node.skin, *rest)});
    elements.back().surroundings = surroundingsOf(asset.model, tree, int(i));
    elements.back().colour = colourTold(materials);
    elements.back().materials = std::move(materials);
    mustBeFinite(elements.back().mesh.positions, int(i));
    if (!mesh.vessels.empty()) takeApart(mesh.vessels, vessels, elements);
  }
  if (elements.empty()) breaks("/nodes", "no node that the scene shows has a mesh", "export the meshes too");
  return elements;
}

}  // namespace vasa::gltf
