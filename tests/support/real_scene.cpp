#include "support/real_scene.h"

#include "convert/convert.h"
#include "io/gltf.h"
#include "network/file.h"
#include "repair/rest_repair.h"

namespace vasa::test {

Result<Scene> realScene(const std::filesystem::path& data, const std::filesystem::path& folder) {
  std::vector<SourceElement> sources;
  for (const char* name : {"bp3d_arteries", "bp3d_veins"}) {
    auto elements = readGltfElements(data / "bp3d" / (std::string(name) + ".glb"));
    if (!elements) return elements.error();
    for (SourceElement& source : describeElements(std::move(*elements), name))
      sources.push_back(std::move(source));
  }
  auto conversion = convertElements(
      sources, {.mend = [](const Network& network) { return Result(separateAtRest(network).network); }});
  if (!conversion) return conversion.error();
  if (auto written = writeNetwork(folder / "real.vasa", conversion->network); !written)
    return written.error();
  SceneFile file;
  file.body = data / "bp3d/bp3d_body.glb";
  file.networks = {folder / "real.vasa"};
  return loadScene(file);
}

}  // namespace vasa::test
