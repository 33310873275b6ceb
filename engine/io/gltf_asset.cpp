#include "io/gltf_asset.h"

#include <nlohmann/json.hpp>

#include "core/atomic_file.h"
#include "io/gltf_buffers.h"
#include "io/gltf_check.h"
#include "io/gltf_container.h"
#include "io/gltf_json.h"
#include "io/gltf_rule.h"

// tinygltf gets a document that is reduced to what is used here, whose integers are written as such and whose
// buffers are named by number; its file callbacks serve them from memory. It refuses indices that are all
// zeros or sparse (no buffer view), which are valid, so those are put in afterwards.
namespace vasa::gltf {
namespace {

using nlohmann::json;
using Bytes = std::vector<unsigned char>;

json parseJson(std::string_view text) {
  try {
    return json::parse(text);
  } catch (const json::exception& error) {
    // The library's text: "[json.exception.parse_error.101] parse error at line 1, column 2: ..."
    const std::string what = error.what();
    const std::size_t end = what.find("] ");
    breaks("JSON", end == std::string::npos ? what : what.substr(end + 2), kExportAgain);
  }
}

const Bytes kNothing{0};  // stands in for a buffer without data: tinygltf refuses an empty one

json reducedForTinygltf(const json& document, const std::vector<Bytes>& buffers) {
  json reduced = json::object();
  for (const char* key : {"asset", "accessors", "bufferViews", "meshes", "nodes", "scenes", "scene", "skins",
                          "materials", "animations"})
    if (const auto it = document.find(key); it != document.end()) reduced[key] = *it;
  for (std::size_t i = 0; i < buffers.size(); ++i)
    reduced["buffers"].push_back(
        {{"uri", std::to_string(i)}, {"byteLength", std::max<std::size_t>(buffers[i].size(), 1)}});
  if (const auto meshes = reduced.find("meshes"); meshes != reduced.end())
    for (json& mesh : *meshes)
      for (json& primitive : mesh["primitives"])
        for (const char* key : {"indices", "targets"}) primitive.erase(key);
  normaliseIntegers(reduced);
  return reduced;
}

void restoreIndices(const json& document, tinygltf::Model& model) {
  for (std::size_t mesh = 0; mesh < model.meshes.size(); ++mesh)
    for (std::size_t i = 0; i < model.meshes[mesh].primitives.size(); ++i) {
      const json& primitive = document["meshes"][mesh]["primitives"][i];
      if (const auto indices = primitive.find("indices"); indices != primitive.end())
        model.meshes[mesh].primitives[i].indices = int(indices->get<double>());
    }
}

const Bytes& bufferNamed(const std::string& name, void* buffers) {
  const Bytes& bytes = static_cast<std::vector<Bytes>*>(buffers)->at(std::stoul(name));
  return bytes.empty() ? kNothing : bytes;
}

tinygltf::FsCallbacks fromMemory(std::vector<Bytes>& buffers) {
  tinygltf::FsCallbacks callbacks{};
  callbacks.FileExists = [](const std::string&, void*) { return true; };
  callbacks.ExpandFilePath = [](const std::string& path, void*) { return path; };
  callbacks.ReadWholeFile = [](Bytes* out, std::string*, const std::string& path, void* all) {
    *out = bufferNamed(path, all);
    return true;
  };
  callbacks.user_data = &buffers;
  return callbacks;
}

tinygltf::Model parseModel(const std::string& text, std::vector<Bytes>& buffers) {
  tinygltf::TinyGLTF loader;
  loader.SetFsCallbacks(fromMemory(buffers));
  tinygltf::Model model;
  std::string error, warning;
  if (!loader.LoadASCIIFromString(&model, &error, &warning, text.data(), unsigned(text.size()), ""))
    breaks("JSON", error.substr(0, error.find('\n')), kExportAgain);
  return model;
}

}  // namespace

Asset loadAsset(const std::filesystem::path& path) {
  auto bytes = readFile(path, kMaximumFileBytes);
  if (!bytes) throw Error(bytes.error());
  const Container container = openContainer(*bytes, path);
  const json document = parseJson(container.json);
  const JsonView root(document);
  checkStructure(root);
  if (container.isGlb && !container.binary && countOf(root, "buffers") > 0 &&
      !root.at("buffers").first().has("uri"))
    root.at("buffers").first().fail("has no uri, and the GLB has no BIN chunk that could be meant");
  std::vector<Bytes> buffers = loadBuffers(root, container.binary, path.parent_path());
  const std::string text = reducedForTinygltf(document, buffers).dump();
  Asset asset;
  asset.name = path.filename().string();
  asset.model = parseModel(text, buffers);
  restoreIndices(document, asset.model);
  for (const Bytes& buffer : buffers) asset.bufferPresent.push_back(!buffer.empty());
  checkData(asset);
  return asset;
}

}  // namespace vasa::gltf
