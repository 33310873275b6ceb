#pragma once
#include <atomic>
#include <functional>
#include <future>
#include <memory>
#include <string>

#include "render/mesh_levels.h"
#include "scene/growth.h"
#include "scene/scene.h"

namespace vasa::viewer {

/// What is looked at: a scene, loaded, and what follows from it alone.
struct Document {
  SceneFile file;
  Scene scene;
  std::unique_ptr<SceneGrowth> growth;  ///< of its capillaries; null where there are no rules for them
  BodyLevels levels;                    ///< of the body's meshes
  std::string title;
  Aabb bounds;                          ///< at rest [m]
};

/// Reads a document. @param rules  folder of the capillaries' rules where the scene names none; empty: no capillaries
/// @param stage  told what is being done, from the calling thread
Result<std::shared_ptr<const Document>> loadDocument(const SceneFile& file, const std::filesystem::path& rules,
                                                     const std::function<void(const char*)>& stage);

/// Loads on a thread of its own, so that the window stays alive. A load that is cancelled goes on unheeded until its
/// current step is over.
class Loader {
 public:
  using Answer = Result<std::shared_ptr<const Document>>;
  ~Loader();

  /// Starts; cancels what is being loaded. @param changed  called from the loading thread at every step and at the end
  void start(const SceneFile& file, const std::filesystem::path& rules, std::function<void()> changed);
  void cancel();

  bool busy() const { return job_ != nullptr; }
  /// What is being done, and of what.
  const char* stage() const;
  const std::string& title() const { return title_; }
  /// The document, or why there is none, once; null while it is being loaded.
  std::unique_ptr<Answer> take();
  /// Waits until there is something to take.
  void wait() const;

 private:
  struct Job {
    std::atomic<const char*> stage{"starting"};
    std::atomic<bool> cancelled{false};
    std::future<Answer> answer;
  };
  void drop();

  std::shared_ptr<Job> job_;
  std::vector<std::shared_ptr<Job>> dropped_;  // still at their last step
  std::string title_;
};

}  // namespace vasa::viewer
