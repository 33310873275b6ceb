#include "viewer/document.h"

#include "core/parallel.h"
#include "core/stage_log.h"
#include "network/measure.h"

namespace vasa::viewer {

GrowthBehind::GrowthBehind(SceneGrowth rules, const Scene& scene, const SweepTable& table)
    : settled_(std::async(std::launch::async,
                          [growth = std::make_unique<SceneGrowth>(std::move(rules)), &scene, &table,
                           cancellation = cancellation_]() mutable -> std::unique_ptr<const SceneGrowth> {
                            const CancellationScope scope(cancellation);
                            const StageLog stage("behind the picture: settling where capillaries grow");
                            giveWay();
                            try {
                              settleGrowth(*growth, scene, table);
                            } catch (const Cancelled&) {
                              return nullptr;
                            }
                            return std::move(growth);
                          })) {}

GrowthBehind::~GrowthBehind() {
  if (!settled_.valid()) return;
  cancellation_.ask();
  settled_.wait();
}

std::string titleOf(const SceneFile& file) {
  return file.networks.empty() ? file.body.filename().string() : file.networks.front().filename().string();
}

Result<std::shared_ptr<const Document>> loadDocument(const SceneFile& file,
                                                     const std::filesystem::path& rules,
                                                     const ReadingProgress& told) {
  auto document = std::make_shared<Document>();
  document->file = file;
  document->title = titleOf(file);
  auto scene = loadScene(file, told);
  if (!scene) return scene.error();
  document->scene = std::move(*scene);
  if (!file.clip.empty())
    if (const auto clip = findClip(document->scene.body, file.clip); !clip) return clip.error();
  const std::filesystem::path folder = file.capillaries.rules.empty() ? rules : file.capillaries.rules;
  auto growth = folder.empty() ? Result<SceneGrowth>(SceneGrowth{}) : readGrowth(document->scene, folder);
  if (!growth) return growth.error();
  checkpoint();
  const char* what = "planning where vessels join, preparing the body's meshes";
  const StageLog stage(what);
  told(what, 0, 0);
  parallelFor(2, 1, [&](std::size_t part) {
    if (part == 0)
      document->table = makeSweepTable(document->scene.network);
    else
      document->levels = bodyLevels(document->scene.body.meshes);
  });
  document->bounds = measure(document->scene.network, document->scene.network.points()).bounds;
  for (const SkinnedMesh& mesh : document->scene.body.meshes) document->bounds.add(mesh.mesh.bounds());
  if (!folder.empty()) document->growth = GrowthBehind(std::move(*growth), document->scene, document->table);
  return std::shared_ptr<const Document>(std::move(document));
}

}  // namespace vasa::viewer
