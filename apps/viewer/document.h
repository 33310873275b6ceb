#pragma once
#include <future>
#include <memory>
#include <string>

#include "core/cancellation.h"
#include "render/mesh_levels.h"
#include "scene/growth.h"
#include "scene/scene.h"
#include "surface/sweep_table.h"

namespace vasa::viewer {

/// What capillaries grow from, settled on a thread of its own behind the first pictures, which need none.
class GrowthBehind {
 public:
  GrowthBehind() = default;  ///< none
  /// @param rules  readGrowth(). Scene and table must outlive this
  GrowthBehind(SceneGrowth rules, const Scene& scene, const SweepTable& table);
  ~GrowthBehind();  ///< cancels
  GrowthBehind(const GrowthBehind&) = delete;
  GrowthBehind& operator=(GrowthBehind&&) = default;

  bool any() const { return settled_.valid(); }
  /// Waits until it is settled; null without any.
  const SceneGrowth* get() const { return any() ? settled_.get().get() : nullptr; }

 private:
  Cancellation cancellation_;
  std::shared_future<std::unique_ptr<const SceneGrowth>> settled_;
};

/// What is looked at: a scene, loaded, and what follows from it alone.
struct Document {
  SceneFile file;
  Scene scene;
  SweepTable table;   ///< of the network, with the forks planned
  BodyLevels levels;  ///< of the body's meshes
  std::string title;
  Aabb bounds;          ///< at rest [m]
  GrowthBehind growth;  ///< of its capillaries; none where there are no rules for them
};

/// What a scene is called in the window.
std::string titleOf(const SceneFile& file);

/// Reads a document; can be cancelled. @param rules  folder of the capillaries' rules where the scene names
/// none; empty: no capillaries
Result<std::shared_ptr<const Document>> loadDocument(const SceneFile& file,
                                                     const std::filesystem::path& rules,
                                                     const ReadingProgress& told);

}  // namespace vasa::viewer
