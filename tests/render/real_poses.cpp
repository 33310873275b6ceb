#include "real_poses.h"

#include "convert/convert.h"
#include "io/gltf.h"
#include "network/file.h"
#include "scene/frame.h"
#include "support/shared_data.h"

namespace vasa::test {
namespace {

Result<Scene> realScene(const std::filesystem::path& data, const std::filesystem::path& folder) {
  std::vector<SourceElement> sources;
  for (const char* name : {"bp3d_arteries", "bp3d_veins"}) {
    auto elements = readGltfElements(data / "bp3d" / (std::string(name) + ".glb"));
    if (!elements) return elements.error();
    for (SourceElement& source : describeElements(std::move(*elements), name)) sources.push_back(std::move(source));
  }
  auto conversion = convertElements(sources);
  if (!conversion) return conversion.error();
  if (auto written = writeNetwork(folder / "real.vasa", conversion->network); !written) return written.error();
  SceneFile file;
  file.body = data / "bp3d/bp3d_body.glb";
  file.networks = {folder / "real.vasa"};
  return loadScene(file);
}

}  // namespace

Result<RealPoses> realPoses(const std::filesystem::path& data, const std::vector<std::string>& clips, int steps) {
  const TemporaryFolder folder;
  const Result<Scene> scene = realScene(data, folder.path());
  if (!scene) return scene.error();
  FrameMaker maker(*scene);
  RealPoses result{scene->network, {}};
  const auto add = [&](const std::string& name, bool middle) {
    result.poses.push_back({name, middle, {maker.points().begin(), maker.points().end()},
                            {maker.knotFrames().begin(), maker.knotFrames().end()}});
  };
  maker.make(nullptr, 0);
  add("", true);
  for (const std::string& name : clips) {
    const Result<const Clip*> clip = findClip(scene->body, name);
    if (!clip) return clip.error();
    for (int step = 0; step <= steps; ++step) {
      maker.make(*clip, glm::mix((*clip)->start, (*clip)->end, float(step) / float(steps)));
      add(name, 2 * step == steps);
    }
  }
  return result;
}

}  // namespace vasa::test
