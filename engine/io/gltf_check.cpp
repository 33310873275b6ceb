#include "io/gltf_check.h"

#include <array>
#include <set>
#include <string>

namespace vasa::gltf {
namespace {

// Required extensions that change nothing but looks, which this program chooses itself, or are understood.
bool isHarmless(const std::string& extension) {
  // Understood: see checkMeshes and io/gltf_unpack.h.
  for (const char* known : {"KHR_mesh_quantization", "EXT_meshopt_compression", "KHR_draco_mesh_compression"})
    if (extension == known) return true;
  for (const char* prefix : {"KHR_materials_",
                             "KHR_texture_",
                             "EXT_texture_",
                             "KHR_lights_",
                             "EXT_lights_",
                             "KHR_xmp",
                             "KHR_audio",
                             "KHR_animation_pointer",
                             "KHR_interactivity",
                             "KHR_node_",
                             "KHR_physics_",
                             "EXT_structural_metadata",
                             "EXT_mesh_features",
                             "ADOBE_",
                             "AGI_",
                             "CESIUM_primitive_outline",
                             "FB_",
                             "GOOGLE_",
                             "MOZ_",
                             "MSFT_",
                             "OMI_",
                             "VRM"})
    if (extension.starts_with(prefix)) return true;
  return false;
}

void checkVersion(const JsonView& asset) {
  const JsonView version = asset.at("version");
  const std::string& text = version.text();
  if (!text.starts_with("2.") || text.size() < 3 ||
      text.find_first_not_of("0123456789", 2) != std::string::npos)
    version.fail("\"" + text + "\" must be 2.x", "export as glTF 2.0");
  if (const auto least = asset.find("minVersion"); least && least->text() != "2.0")
    least->fail("\"" + least->text() + "\" is newer than the 2.0 that is understood", "export as glTF 2.0");
}

std::set<std::string> uniqueNames(const JsonView& root, const char* key) {
  std::set<std::string> names;
  for (const JsonView& item : root.items(key))
    if (!names.insert(item.text()).second) item.fail("\"" + item.text() + "\" is listed twice");
  return names;
}

void checkExtensions(const JsonView& root) {
  const auto used = uniqueNames(root, "extensionsUsed");
  uniqueNames(root, "extensionsRequired");
  for (const JsonView& item : root.items("extensionsRequired")) {
    if (!isHarmless(item.text()))
      item.fail(
          "the file needs the extension " + item.text() + ", which is not supported",
          item.text() == "EXT_mesh_gpu_instancing"
              ? "make the copies of its meshes real objects (Blender: Make Instances Real), and export again"
              : "export without it (for compressed meshes: without compression)");
    if (!used.contains(item.text()))
      item.fail("\"" + item.text() + "\" must also be listed in extensionsUsed");
  }
  if (const auto extensions = root.find("extensions"))
    for (const auto& [name, value] : extensions->members()) value.mustBeObject();
}

}  // namespace

void checkHead(const JsonView& root) {
  root.mustBeObject();
  const JsonView asset = root.at("asset");
  checkVersion(asset);
  constexpr std::array kArrays = {"accessors", "animations", "buffers", "bufferViews", "cameras",
                                  "images",    "materials",  "meshes",  "nodes",       "samplers",
                                  "scenes",    "skins",      "textures"};
  for (const char* array : kArrays)
    for (const JsonView& item : root.items(array)) {
      item.mustBeObject();
      if (const auto name = item.find("name")) name->text();
    }
  checkExtensions(root);
}

void checkStructure(const JsonView& root) {
  checkHead(root);
  checkBuffers(root);
  checkAccessors(root);
  checkMaterials(root);
  checkMeshes(root);
  checkNodes(root);
  checkSkins(root);
  checkAnimations(root);
}

}  // namespace vasa::gltf
