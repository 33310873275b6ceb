#include "io/gltf_model.h"

#include <algorithm>
#include <limits>

// Everything has been checked: indices refer to something, numbers are numbers and in range.
namespace vasa::gltf {
namespace {

constexpr std::int64_t kAny = std::int64_t(1) << 52;

std::size_t sizeIn(const JsonView& object, std::string_view key) {
  const auto value = object.find(key);
  return value ? std::size_t(value->integer(0, kAny)) : 0;
}

int indexIn(const JsonView& object, std::string_view key) {
  const auto value = object.find(key);
  return value ? int(value->integer(0, std::numeric_limits<int>::max())) : -1;
}

int numberIn(const JsonView& object, std::string_view key, int otherwise) {
  const auto value = object.find(key);
  return value ? int(value->integer(0, std::numeric_limits<int>::max())) : otherwise;
}

std::string textIn(const JsonView& object, std::string_view key) {
  const auto value = object.find(key);
  return value ? value->text() : std::string();
}

std::vector<double> numbersIn(const JsonView& object, std::string_view key) {
  const auto values = object.find(key);
  return values ? values->numbers(values->size()) : std::vector<double>{};
}

std::vector<int> indicesIn(const JsonView& object, std::string_view key) {
  std::vector<int> out;
  const auto items = object.items(key);
  out.reserve(items.size());
  for (const JsonView& item : items) out.push_back(int(item.integer(0, std::numeric_limits<int>::max())));
  return out;
}

Model::BufferView viewOf(const JsonView& view) {
  return {indexIn(view, "buffer"), sizeIn(view, "byteOffset"), sizeIn(view, "byteLength"), sizeIn(view, "byteStride")};
}

Model::Sparse sparseOf(const JsonView& sparse) {
  const JsonView indices = sparse.at("indices"), values = sparse.at("values");
  return {sizeIn(sparse, "count"),       indexIn(indices, "bufferView"), indexIn(indices, "componentType"),
          indexIn(values, "bufferView"), sizeIn(indices, "byteOffset"),  sizeIn(values, "byteOffset")};
}

Model::Accessor accessorOf(const JsonView& accessor) {
  Model::Accessor out;
  out.bufferView = indexIn(accessor, "bufferView");
  out.componentType = indexIn(accessor, "componentType");
  if (const auto normalised = accessor.find("normalized")) out.normalised = normalised->boolean();
  out.type = textIn(accessor, "type");
  out.byteOffset = sizeIn(accessor, "byteOffset");
  out.count = sizeIn(accessor, "count");
  out.least = numbersIn(accessor, "min");
  out.most = numbersIn(accessor, "max");
  if (const auto sparse = accessor.find("sparse")) out.sparse = sparseOf(*sparse);
  return out;
}

Model::Primitive primitiveOf(const JsonView& primitive, const std::vector<Model::Accessor>& accessors) {
  Model::Primitive out;
  const JsonView attributes = primitive.at("attributes");
  out.position = indexIn(attributes, "POSITION");
  out.normal = indexIn(attributes, "NORMAL");
  out.indices = indexIn(primitive, "indices");
  out.material = indexIn(primitive, "material");
  out.mode = numberIn(primitive, "mode", kTriangles);
  out.vertices = accessors[attributes.members().front().second.index(accessors.size(), "accessors")].count;
  for (std::size_t set = 0; attributes.has("JOINTS_" + std::to_string(set)); ++set) {
    out.joints.push_back(indexIn(attributes, "JOINTS_" + std::to_string(set)));
    out.weights.push_back(indexIn(attributes, "WEIGHTS_" + std::to_string(set)));
  }
  return out;
}

Model::Node nodeOf(const JsonView& node) {
  Model::Node out;
  out.name = textIn(node, "name");
  out.mesh = indexIn(node, "mesh");
  out.skin = indexIn(node, "skin");
  if (const auto t = numbersIn(node, "translation"); !t.empty()) out.transform.translation = vec3(dvec3(t[0], t[1], t[2]));
  if (const auto s = numbersIn(node, "scale"); !s.empty()) out.transform.scale = vec3(dvec3(s[0], s[1], s[2]));
  if (const auto q = numbersIn(node, "rotation"); !q.empty())
    out.transform.rotation = glm::normalize(quat(float(q[3]), float(q[0]), float(q[1]), float(q[2])));
  for (const double value : numbersIn(node, "matrix")) out.matrix.push_back(float(value));
  out.children = indicesIn(node, "children");
  return out;
}

Model::Material materialOf(const JsonView& material) {
  Model::Material out;
  out.name = textIn(material, "name");
  out.blends = textIn(material, "alphaMode") == "BLEND";
  if (const auto pbr = material.find("pbrMetallicRoughness")) {
    const auto factor = numbersIn(*pbr, "baseColorFactor");
    for (std::size_t i = 0; i < factor.size(); ++i) out.baseColour[int(i)] = float(factor[i]);
  }
  return out;
}

Interpolation interpolationNamed(const std::string& name) {
  if (name == "STEP") return Interpolation::step;
  return name == "CUBICSPLINE" ? Interpolation::cubic : Interpolation::linear;
}

Model::Path pathNamed(const std::string& name) {
  if (name == "translation") return Model::Path::translation;
  if (name == "rotation") return Model::Path::rotation;
  return name == "scale" ? Model::Path::scale : Model::Path::other;
}

Model::Animation animationOf(const JsonView& animation) {
  Model::Animation out{textIn(animation, "name"), {}, {}};
  for (const JsonView& sampler : animation.items("samplers"))
    out.samplers.push_back({indexIn(sampler, "input"), indexIn(sampler, "output"), interpolationNamed(textIn(sampler, "interpolation"))});
  for (const JsonView& channel : animation.items("channels")) {
    const JsonView target = channel.at("target");
    out.channels.push_back({indexIn(channel, "sampler"), indexIn(target, "node"), pathNamed(textIn(target, "path"))});
  }
  return out;
}

void addLabels(const JsonView& object, int number, std::map<int, Model::Labels>& labels) {
  const auto extras = object.find("extras");
  if (!extras || !extras->isObject()) return;
  Model::Labels found;
  if (const auto value = extras->find("category"); value && value->isText()) found.category = value->text();
  if (const auto value = extras->find("fma"); value && value->isText()) found.ontologyId = value->text();
  if (!found.category.empty() || !found.ontologyId.empty()) labels.emplace(number, std::move(found));
}

template <class T, class Maker>
void fill(std::vector<T>& out, const JsonView& root, const char* array, Maker make) {
  const auto items = root.items(array);
  out.reserve(items.size());
  for (const JsonView& item : items) out.push_back(make(item));
}

}  // namespace

Model modelOf(const JsonView& root) {
  Model model;
  fill(model.bufferViews, root, "bufferViews", viewOf);
  fill(model.accessors, root, "accessors", accessorOf);
  fill(model.meshes, root, "meshes", [&](const JsonView& mesh) {
    addLabels(mesh, int(model.meshes.size()), model.meshLabels);
    Model::Mesh out{textIn(mesh, "name"), {}};
    fill(out.primitives, mesh, "primitives", [&](const JsonView& primitive) { return primitiveOf(primitive, model.accessors); });
    return out;
  });
  fill(model.nodes, root, "nodes", [&](const JsonView& node) {
    addLabels(node, int(model.nodes.size()), model.nodeLabels);
    return nodeOf(node);
  });
  fill(model.skins, root, "skins", [](const JsonView& skin) {
    return Model::Skin{indicesIn(skin, "joints"), indexIn(skin, "inverseBindMatrices")};
  });
  fill(model.materials, root, "materials", materialOf);
  fill(model.animations, root, "animations", animationOf);
  if (const auto scenes = root.items("scenes"); !scenes.empty()) {
    model.hasScenes = true;
    model.sceneNodes = indicesIn(scenes[sizeIn(root, "scene")], "nodes");
  }
  return model;
}

}  // namespace vasa::gltf
