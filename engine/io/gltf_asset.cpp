#include "io/gltf_asset.h"

#include <nlohmann/json.hpp>

#include "core/log.h"
#include "io/gltf_check.h"
#include "io/gltf_container.h"
#include "io/gltf_json.h"
#include "io/gltf_rule.h"
#include "io/gltf_unpack.h"

namespace vasa::gltf {
namespace {

using nlohmann::json;

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

}  // namespace

Asset loadAsset(std::vector<std::byte> bytes, const std::filesystem::path& path) {
  Asset asset;
  asset.name = path.filename().string();
  asset.file = std::move(bytes);
  {
    const Container container = openContainer(asset.file, path);
    json document = parseJson(container.json);
    const JsonView root(document);
    checkStructure(root);
    if (uses(root, "EXT_mesh_gpu_instancing"))
      logWarning(asset.name +
                 ": copies of meshes by EXT_mesh_gpu_instancing are left out, each mesh is read once; make "
                 "the copies real objects before exporting");
    if (container.isGlb && !container.binary && countOf(root, "buffers") > 0 &&
        !root.at("buffers").first().has("uri"))
      root.at("buffers").first().fail("has no uri, and the GLB has no BIN chunk that could be meant");
    asset.buffers = loadBuffers(root, container.binary, path.parent_path());
    asset.bytes = asset.file.size() + asset.buffers.bytesBeside;
    if (const std::size_t unpacked = unpack(document, asset.buffers)) {
      checkStructure(root);  // as it is now
      asset.bytes += unpacked;
    }
    checkAmounts(root, asset.bytes);
    asset.model = modelOf(std::move(document));
  }
  checkData(asset);
  return asset;
}

}  // namespace vasa::gltf
