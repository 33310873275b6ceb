#include "support/real_scene.h"

#include <fmt/format.h>

#include "convert/convert.h"
#include "core/atomic_file.h"
#include "core/hash.h"
#include "engine_print.h"
#include "io/gltf.h"
#include "network/file.h"
#include "repair/rest_repair.h"
#include "support/shared_data.h"

namespace vasa::test {
namespace {

// The network's file, which may not be there yet.
Result<std::filesystem::path> convertedFile(const std::vector<std::filesystem::path>& meshes) {
  std::uint64_t key = kEnginePrint;
  for (const auto& mesh : meshes) {
    const auto bytes = readFile(mesh);
    if (!bytes) return bytes.error();
    key = hashBytes(*bytes, key);
  }
  return std::filesystem::path(VASA_CONVERTED) / fmt::format("real-{:016x}.vasa", key);
}

Result<std::size_t> convertTo(const std::filesystem::path& file,
                              const std::vector<std::filesystem::path>& meshes) {
  std::vector<SourceElement> sources;
  for (const auto& mesh : meshes) {
    auto elements = readGltfElements(mesh);
    if (!elements) return elements.error();
    for (SourceElement& source : describeElements(std::move(*elements), mesh.stem().string()))
      sources.push_back(std::move(source));
  }
  auto conversion = convertElements(
      sources, {.mend = [](const Network& network) { return Result(separateAtRest(network).network); }});
  if (!conversion) return conversion.error();
  std::filesystem::create_directories(file.parent_path());
  for (const auto& other : filesIn(file.parent_path()))  // what an engine before this one made
    if (other != file) std::filesystem::remove(other);
  return writeNetwork(file, conversion->network);
}

}  // namespace

Result<Scene> realScene(const std::filesystem::path& data) {
  const std::vector<std::filesystem::path> meshes{data / "bp3d/bp3d_arteries.glb",
                                                  data / "bp3d/bp3d_veins.glb"};
  const auto network = convertedFile(meshes);
  if (!network) return network.error();
  if (!std::filesystem::exists(*network))
    if (auto converted = convertTo(*network, meshes); !converted) return converted.error();
  SceneFile file;
  file.body = data / "bp3d/bp3d_body.glb";
  file.networks = {*network};
  return loadScene(file);
}

}  // namespace vasa::test
