#include "viewer/document.h"

#include "core/cancellation.h"
#include "network/measure.h"

namespace vasa::viewer {

std::string titleOf(const SceneFile& file) {
  return file.networks.empty() ? file.body.filename().string() : file.networks.front().filename().string();
}

Result<std::shared_ptr<const Document>> loadDocument(const SceneFile& file, const std::filesystem::path& rules, const Forces& forces,
                                                     const ReadingProgress& told) {
  const auto tell = [&](const char* what) {
    checkpoint();
    told(what, 0, 0);
  };
  auto document = std::make_shared<Document>();
  document->file = file;
  document->title = titleOf(file);
  auto scene = loadScene(file, told);
  if (!scene) return scene.error();
  document->scene = std::move(*scene);
  if (!file.clip.empty())
    if (const auto clip = findClip(document->scene.body, file.clip); !clip) return clip.error();
  tell("planning where vessels join");
  document->table = makeSweepTable(document->scene.network);
  const std::filesystem::path folder = file.capillaries.rules.empty() ? rules : file.capillaries.rules;
  if (!folder.empty()) {
    tell("preparing capillaries");
    auto growth = loadGrowth(document->scene, folder, document->table);
    if (!growth) return growth.error();
    document->growth = std::make_unique<SceneGrowth>(std::move(*growth));
  }
  tell("preparing the body's meshes");
  document->levels = bodyLevels(document->scene.body.meshes);
  tell("preparing how vessels move");
  document->forces = forces;
  document->maker = std::make_shared<FrameMaker>(document->scene, frameOptions(forces, false));
  tell("measuring");
  document->bounds = measure(document->scene.network, document->scene.network.points()).bounds;
  for (const SkinnedMesh& mesh : document->scene.body.meshes) document->bounds.add(mesh.mesh.bounds());
  return std::shared_ptr<const Document>(std::move(document));
}

}  // namespace vasa::viewer
