#pragma once
#include <memory>
#include <string>

#include "render/mesh_levels.h"
#include "scene/growth.h"
#include "scene/scene.h"
#include "surface/sweep_table.h"
#include "viewer/forces.h"

namespace vasa::viewer {

/// What is looked at: a scene, loaded, and what follows from it alone.
struct Document {
  SceneFile file;
  Scene scene;
  std::unique_ptr<SceneGrowth> growth;  ///< of its capillaries; null where there are no rules for them
  SweepTable table;                     ///< of the network, with the forks planned
  BodyLevels levels;                    ///< of the body's meshes
  std::string title;
  Aabb bounds;                          ///< at rest [m]
  Forces forces;                        ///< of `maker`
  std::shared_ptr<FrameMaker> maker;    ///< made along with the rest, as it takes a while; the pose worker's alone
};

/// What a scene is called in the window.
std::string titleOf(const SceneFile& file);

/// Reads a document; can be cancelled. @param rules  folder of the capillaries' rules where the scene names none; empty:
/// no capillaries
Result<std::shared_ptr<const Document>> loadDocument(const SceneFile& file, const std::filesystem::path& rules, const Forces& forces,
                                                     const ReadingProgress& told);

}  // namespace vasa::viewer
