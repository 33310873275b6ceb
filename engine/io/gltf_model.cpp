#include "io/gltf_model.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/name_words.h"
#include "io/gltf_rule.h"
#include "io/gltf_tinygltf.h"

// tinygltf gets a document that has been checked and reduced to what is used here: integers are written as
// such, extras and extensions are taken out, and buffers stand for themselves with one byte, as their bytes
// are views elsewhere (io/gltf_buffers.h). It refuses indices that are all zeros or sparse (no buffer view),
// which are valid, so those are put in afterwards. Everything has been checked: indices refer to something,
// numbers are numbers and in range.
namespace vasa::gltf {
namespace {

using nlohmann::json;

// While a list grows, its old and its new room: at most three times what it holds.
constexpr std::size_t kGrowing = 3;
constexpr std::size_t kAnAttribute = 96;  // a node of a tree with a short name

// What tinygltf is not given, in the order of the document.
struct Aside {
  std::vector<int> indices, vertices;                    // of every primitive of every mesh
  std::vector<std::vector<int>> targets;                 // likewise
  std::vector<std::vector<Model::VesselLabel>> vessels;  // of every mesh
  std::map<int, Model::Labels> nodeLabels, meshLabels;
  std::map<int, std::string> humanoid;
  std::vector<int> hidden;
};

int integerIn(const json& object, const char* key, int otherwise) {
  const auto value = object.find(key);
  return value == object.end() ? otherwise : int(value->get<double>());
}

const json& listIn(const json& object, const char* key) {
  static const json none = json::array();
  const auto list = object.find(key);
  return list == object.end() ? none : *list;
}

std::string labelIn(const json& extras, const char* key) {
  const auto value = extras.find(key);
  return value != extras.end() && value->is_string() ? value->get<std::string>() : std::string();
}

// The number of an ontology's term in a text, right behind the ontology's name or behind its "id".
std::string ontologyIdIn(const std::string& text) {
  std::string_view ontology;
  for (const std::string& word : nameWords(text)) {
    const bool isNumber = word[0] >= '0' && word[0] <= '9';
    if (isNumber && !ontology.empty()) return std::string(ontology) + word;
    if (word == "fma" || word == "uberon")
      ontology = word == "fma" ? "FMA" : "UBERON:";
    else if (word != "id")
      ontology = {};
  }
  return {};
}

// That of what extras tell under whatever key: "FMA": 3734, "uberon_id": "UBERON:0000947", "id" with an
// address that ends in FMA_3734. What "fma" says is the element's own; other keys may tell others' as well.
std::string ontologyIdIn(const json& extras) {
  constexpr std::size_t kLongest = 200;
  const auto told = [&](const std::string& key, const json& value) {
    if (!value.is_string() && !value.is_number_unsigned()) return std::string();
    const std::string text =
        value.is_string() ? value.get<std::string>() : std::to_string(value.get<std::uint64_t>());
    return key.size() + text.size() > kLongest ? std::string() : ontologyIdIn(key + ' ' + text);
  };
  if (const auto own = extras.find("fma"); own != extras.end())
    if (std::string id = told("fma", *own); !id.empty()) return id;
  for (const auto& [key, value] : extras.items())
    if (std::string id = told(key, value); !id.empty()) return id;
  return labelIn(extras, "fma");
}

// "artery", "vein" ...
std::string categoryIn(const json& extras) {
  for (const char* key : {"category", "kind"})
    if (std::string told = labelIn(extras, key); !told.empty()) return told;
  return {};
}

void addLabels(const json& object, int number, std::map<int, Model::Labels>& labels) {
  const auto extras = object.find("extras");
  if (extras == object.end() || !extras->is_object()) return;
  Model::Labels found{categoryIn(*extras), ontologyIdIn(*extras)};
  if (!found.category.empty() || !found.ontologyId.empty()) labels.emplace(number, std::move(found));
}

// All of them or none: their numbers count.
std::vector<Model::VesselLabel> vesselsIn(const json& mesh) {
  const auto extras = mesh.find("extras");
  if (extras == mesh.end() || !extras->is_object()) return {};
  const json& list = listIn(*extras, "vessels");
  if (!list.is_array()) return {};
  std::vector<Model::VesselLabel> vessels;
  for (const json& entry : list) {
    if (!entry.is_object() || labelIn(entry, "name").empty()) return {};
    vessels.push_back({labelIn(entry, "name"), labelIn(entry, "kind"), labelIn(entry, "id")});
  }
  return vessels;
}

std::vector<int> targetsIn(const json& primitive) {
  std::vector<int> targets;
  for (const json& target : listIn(primitive, "targets"))
    targets.push_back(integerIn(target, "POSITION", -1));
  return targets;
}

const json& memberOf(const json& object, const char* key) {
  static const json none;
  const auto found = object.is_object() ? object.find(key) : object.end();
  return object.is_object() && found != object.end() ? *found : none;
}

// VRM's humanoid: a list of {bone, node} in its version 0, an object bone -> {node} in version 1. Not part of
// what is checked: what is no such table is passed over.
std::map<int, std::string> humanoidOf(const json& document) {
  std::map<int, std::string> bones;
  const std::size_t nodes = listIn(document, "nodes").size();
  const auto add = [&](const std::string& bone, const json& node) {
    if (!node.is_number_integer() || node.get<double>() < 0 || node.get<double>() >= double(nodes) ||
        bone.size() > 40)
      return;
    bones.emplace(node.get<int>(), bone);
  };
  const json& extensions = memberOf(document, "extensions");
  const json& list = memberOf(memberOf(memberOf(extensions, "VRM"), "humanoid"), "humanBones");
  if (list.is_array())
    for (const json& entry : list)
      if (memberOf(entry, "bone").is_string())
        add(entry.at("bone").get<std::string>(), memberOf(entry, "node"));
  const json& table = memberOf(memberOf(memberOf(extensions, "VRMC_vrm"), "humanoid"), "humanBones");
  if (table.is_object())
    for (const auto& [bone, entry] : table.items()) add(bone, memberOf(entry, "node"));
  return bones;
}

bool isHidden(const json& node) {
  const json& visible = memberOf(memberOf(memberOf(node, "extensions"), "KHR_node_visibility"), "visible");
  return visible.is_boolean() && !visible.get<bool>();
}

Aside takeAside(const json& document) {
  Aside aside;
  aside.humanoid = humanoidOf(document);
  const json& accessors = listIn(document, "accessors");
  int number = 0;
  for (const json& node : listIn(document, "nodes")) {
    if (isHidden(node)) aside.hidden.push_back(number);
    addLabels(node, number++, aside.nodeLabels);
  }
  number = 0;
  for (const json& mesh : listIn(document, "meshes")) {
    addLabels(mesh, number++, aside.meshLabels);
    aside.vessels.push_back(vesselsIn(mesh));
    for (const json& primitive : mesh.at("primitives")) {
      aside.indices.push_back(integerIn(primitive, "indices", -1));
      aside.targets.push_back(targetsIn(primitive));
      const auto first = std::size_t(primitive.at("attributes").begin()->get<double>());
      aside.vertices.push_back(integerIn(accessors.at(first), "count", 0));
    }
  }
  return aside;
}

// Numbers such as 3.0 become 3, which some exporters write and glTF allows; at most 64 deep: checked before
// parsing.
void prune(json& value) {
  if (value.is_object()) value.erase("extras"), value.erase("extensions");
  if (value.is_structured()) {
    for (json& child : value) prune(child);
  } else if (value.is_number_float()) {
    const double number = value.get<double>();
    constexpr double kExact = 9007199254740992;  // 2^53: whole numbers below are exact, and no cast overflows
    if (std::abs(number) <= kExact && number == std::trunc(number)) value = std::int64_t(number);
  }
}

std::string reducedText(json document) {
  json reduced = json::object();
  for (const char* key : {"asset", "accessors", "bufferViews", "meshes", "nodes", "scenes", "scene", "skins",
                          "materials", "animations"})
    if (const auto it = document.find(key); it != document.end()) reduced[key] = std::move(*it);
  for (std::size_t i = 0; i < listIn(document, "buffers").size(); ++i)
    reduced["buffers"].push_back({{"uri", "byte"}, {"byteLength", 1}});
  if (const auto meshes = reduced.find("meshes"); meshes != reduced.end())
    for (json& mesh : *meshes)
      for (json& primitive : mesh["primitives"])
        for (const char* key : {"indices", "targets"}) primitive.erase(key);
  prune(reduced);
  return reduced.dump();
}

tinygltf::FsCallbacks oneByteForEach() {
  tinygltf::FsCallbacks callbacks{};
  callbacks.FileExists = [](const std::string&, void*) { return true; };
  callbacks.ExpandFilePath = [](const std::string& path, void*) { return path; };
  callbacks.ReadWholeFile = [](std::vector<unsigned char>* out, std::string*, const std::string&, void*) {
    out->assign(1, 0);
    return true;
  };
  return callbacks;
}

tinygltf::Model parse(const std::string& text) {
  tinygltf::TinyGLTF loader;
  loader.SetFsCallbacks(oneByteForEach());
  tinygltf::Model model;
  std::string error, warning;
  if (!loader.LoadASCIIFromString(&model, &error, &warning, text.data(), unsigned(text.size()), ""))
    breaks("JSON", error.substr(0, error.find('\n')), kExportAgain);
  return model;
}

Model::BufferView viewOf(const tinygltf::BufferView& view) {
  return {view.buffer, view.byteOffset, view.byteLength, view.byteStride};
}

Model::Sparse sparseOf(const tinygltf::Accessor& accessor) {
  const auto& sparse = accessor.sparse;
  if (!sparse.isSparse) return {};
  return {std::size_t(sparse.count),
          sparse.indices.bufferView,
          sparse.indices.componentType,
          sparse.values.bufferView,
          std::size_t(sparse.indices.byteOffset),
          std::size_t(sparse.values.byteOffset)};
}

std::string typeName(int type) {
  switch (type) {
    case TINYGLTF_TYPE_SCALAR:
      return "SCALAR";
    case TINYGLTF_TYPE_VEC2:
      return "VEC2";
    case TINYGLTF_TYPE_VEC3:
      return "VEC3";
    case TINYGLTF_TYPE_VEC4:
      return "VEC4";
    case TINYGLTF_TYPE_MAT2:
      return "MAT2";
    case TINYGLTF_TYPE_MAT3:
      return "MAT3";
    default:
      return "MAT4";
  }
}

Model::Accessor accessorOf(const tinygltf::Accessor& accessor) {
  return {accessor.bufferView,     accessor.componentType, accessor.normalized,
          typeName(accessor.type), accessor.byteOffset,    accessor.count,
          accessor.minValues,      accessor.maxValues,     sparseOf(accessor)};
}

Model::Primitive primitiveOf(const tinygltf::Primitive& primitive, int indices, int vertices) {
  const auto named = [&](const std::string& name) {
    const auto found = primitive.attributes.find(name);
    return found == primitive.attributes.end() ? -1 : found->second;
  };
  Model::Primitive out;
  out.position = named("POSITION");
  out.normal = named("NORMAL");
  out.indices = indices;
  out.vessel = named("_VESSEL");
  out.colour = named("COLOR_0");
  out.material = primitive.material;
  out.mode = primitive.mode < 0 ? int(kTriangles) : primitive.mode;
  out.vertices = std::size_t(vertices);
  for (std::size_t set = 0; named("JOINTS_" + std::to_string(set)) >= 0; ++set) {
    out.joints.push_back(named("JOINTS_" + std::to_string(set)));
    out.weights.push_back(named("WEIGHTS_" + std::to_string(set)));
  }
  return out;
}

Model::Node nodeOf(const tinygltf::Node& node) {
  Model::Node out{node.name,
                  node.mesh,
                  node.skin,
                  {},
                  {node.matrix.begin(), node.matrix.end()},
                  node.children,
                  {node.weights.begin(), node.weights.end()}};
  if (const auto& t = node.translation; !t.empty()) out.transform.translation = vec3(dvec3(t[0], t[1], t[2]));
  if (const auto& s = node.scale; !s.empty()) out.transform.scale = vec3(dvec3(s[0], s[1], s[2]));
  if (const auto& q = node.rotation; !q.empty())
    out.transform.rotation = glm::normalize(quat(float(q[3]), float(q[0]), float(q[1]), float(q[2])));
  return out;
}

Model::Material materialOf(const tinygltf::Material& material) {
  Model::Material out{material.name, vec4(1), material.alphaMode == "BLEND"};
  const auto& factor = material.pbrMetallicRoughness.baseColorFactor;
  for (std::size_t i = 0; i < factor.size(); ++i)
    out.baseColour[int(i)] = float(std::clamp(factor[i], 0.0, 1.0));
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

Model::Animation animationOf(const tinygltf::Animation& animation) {
  Model::Animation out{animation.name, {}, {}};
  for (const auto& sampler : animation.samplers)
    out.samplers.push_back({sampler.input, sampler.output, interpolationNamed(sampler.interpolation)});
  for (const auto& channel : animation.channels)
    out.channels.push_back({channel.sampler, channel.target_node, pathNamed(channel.target_path)});
  return out;
}

// Each item makes room for the next: what has been turned into a Model is no longer needed.
template <class From, class To, class Maker>
void fill(std::vector<From>& from, std::vector<To>& out, Maker make) {
  out.reserve(from.size());
  for (const From& item : from) out.push_back(make(item));
  from = {};
}

}  // namespace

std::span<const float> weightsOf(const Model& model, const Model::Node& node) {
  return node.weights.empty() ? model.meshes[std::size_t(node.mesh)].weights : node.weights;
}

std::size_t modelMemory(const JsonView& root) {
  using namespace tinygltf;
  std::size_t bytes = 0;
  const auto add = [&](std::size_t count, std::size_t each, std::size_t ours) {
    bytes += count * (kGrowing * each + ours);
  };
  add(countOf(root, "bufferViews"), sizeof(BufferView), sizeof(Model::BufferView));
  add(countOf(root, "accessors"), sizeof(Accessor), sizeof(Model::Accessor));
  add(countOf(root, "nodes"), sizeof(Node), sizeof(Model::Node));
  add(countOf(root, "skins"), sizeof(Skin), sizeof(Model::Skin));
  add(countOf(root, "materials"), sizeof(Material), sizeof(Model::Material));
  add(countOf(root, "scenes"), sizeof(Scene), 0);
  add(countOf(root, "buffers"), sizeof(Buffer), 0);
  for (const JsonView& mesh : root.items("meshes")) {
    add(1, sizeof(Mesh), sizeof(Model::Mesh));
    for (const JsonView& primitive : mesh.items("primitives")) {
      add(1, sizeof(Primitive) + kAnAttribute * primitive.at("attributes").members().size(),
          sizeof(Model::Primitive));
      add(countOf(primitive, "targets"), 0, kGrowing * sizeof(int));
    }
    if (const auto extras = mesh.find("extras"); extras && extras->isObject())
      add(countOf(*extras, "vessels"), 0, kGrowing * sizeof(Model::VesselLabel));
  }
  for (const JsonView& animation : root.items("animations")) {
    add(1, sizeof(Animation), sizeof(Model::Animation));
    add(countOf(animation, "samplers"), sizeof(AnimationSampler), sizeof(Model::Sampler));
    add(countOf(animation, "channels"), sizeof(AnimationChannel), sizeof(Model::Channel));
  }
  return bytes;
}

Model modelOf(json document) {
  Aside aside = takeAside(document);
  tinygltf::Model read = parse(reducedText(std::move(document)));
  Model model;
  fill(read.bufferViews, model.bufferViews, viewOf);
  fill(read.accessors, model.accessors, accessorOf);
  std::size_t primitive = 0;
  fill(read.meshes, model.meshes, [&](const tinygltf::Mesh& mesh) {
    Model::Mesh out{mesh.name, {}, {mesh.weights.begin(), mesh.weights.end()}, {}};
    out.vessels = std::move(aside.vessels[model.meshes.size()]);
    out.primitives.reserve(mesh.primitives.size());
    for (const auto& part : mesh.primitives) {
      out.primitives.push_back(primitiveOf(part, aside.indices[primitive], aside.vertices[primitive]));
      out.primitives.back().targets = std::move(aside.targets[primitive]);
      ++primitive;
    }
    return out;
  });
  fill(read.nodes, model.nodes, nodeOf);
  fill(read.skins, model.skins, [](const tinygltf::Skin& skin) {
    return Model::Skin{skin.joints, skin.inverseBindMatrices};
  });
  fill(read.materials, model.materials, materialOf);
  fill(read.animations, model.animations, animationOf);
  model.hasScenes = !read.scenes.empty();
  if (model.hasScenes) model.sceneNodes = read.scenes[std::size_t(std::max(read.defaultScene, 0))].nodes;
  model.nodeLabels = std::move(aside.nodeLabels);
  model.meshLabels = std::move(aside.meshLabels);
  model.humanoid = std::move(aside.humanoid);
  model.hidden = std::move(aside.hidden);
  return model;
}

}  // namespace vasa::gltf
