#pragma once
#include <memory>
#include <optional>
#include <string>

#include "atlas/vessel_groups.h"
#include "body/rebind.h"
#include "render/mesh_levels.h"
#include "scene/growth.h"
#include "scene/scene.h"
#include "surface/sweep_table.h"
#include "viewer/mannequin.h"

namespace vasa::viewer {

/// What capillaries grow from, settled on a thread of its own behind pictures that need none.
class GrowthBehind {
 public:
  GrowthBehind();  ///< none
  /// @param rules  readGrowth(). Scene and table must outlive this
  GrowthBehind(SceneGrowth rules, const Scene& scene, const SweepTable& table);
  ~GrowthBehind();  ///< cancels
  GrowthBehind(const GrowthBehind&) = delete;
  GrowthBehind& operator=(GrowthBehind&&) noexcept;

  bool any() const { return work_ != nullptr; }
  /// Begins to settle it, if that has not begun. One thread at a time calls this and what follows.
  void begin() const;
  /// Whether get() answers at once.
  bool settled() const;
  /// Waits until it is settled; null without any.
  const SceneGrowth* get() const;

 private:
  struct Work;
  std::unique_ptr<Work> work_;
};

/// What is looked at: a scene, loaded, and what follows from it alone.
struct Document {
  SceneFile file;
  Scene scene;
  std::shared_ptr<const SweepTable> table;            ///< of the network, with the forks planned
  std::shared_ptr<const BodyLevels> levels;           ///< of the body's meshes
  std::shared_ptr<const Mannequin> mannequin;         ///< the body's skeleton as something to pose
  std::shared_ptr<const atlas::VesselGroups> groups;  ///< what its vessels belong to
  std::vector<ClearedLimb> clearedLimbs;              ///< in its clips, by the clip's name
  std::string title;
  Aabb bounds;  ///< at rest [m]
  /// What its own journal is replayed onto; its own: the last that the scene names, if that lies beside the
  /// scene under the scene's name (ownJournal).
  std::shared_ptr<const Network> base;
  std::shared_ptr<const Binding> baseBinding;
  std::vector<std::string> journal;  ///< lines that were replayed
  bool live = false;                 ///< editedDocument()
  /// Of each vessel, its number in the base; invalid: an edit added it. Empty: they are the base's.
  std::vector<VesselId> origins;
  std::shared_ptr<ForkMemory> forks;  ///< of the base and all that is made of it, by one thread at a time
  std::shared_ptr<const Rebinder> rebinder;
  std::filesystem::path rules;  ///< of the capillaries; empty: none
  GrowthBehind growth;          ///< of its capillaries; none where there are no rules for them
};

/// What a scene is called in the window.
std::string titleOf(const SceneFile& file);

/// What a document takes from the program's own data.
struct Furnishing {
  std::filesystem::path rules;  ///< folder of the capillaries' rules, where the scene names none; empty: none
  std::filesystem::path ranges;  ///< table of how far joints go (io/joint_range.h); empty: none
};

/// Reads a document; can be cancelled.
/// @param edits  its own journal, where that is not what its file says
Result<std::shared_ptr<const Document>> loadDocument(
    const SceneFile& file, const Furnishing& furnishing, const ReadingProgress& told,
    const std::optional<std::vector<std::string>>& edits = std::nullopt);

/// The journal that belongs to a scene file: beside it, with its name.
std::filesystem::path ownJournal(const std::filesystem::path& scene);

/// The same document with another own journal: only vessels that changed are bound anew. badInput with the
/// refusal of the first line that is refused.
/// @param live  to be replaced at once: forks leave as they did (planForksAs)
Result<std::shared_ptr<const Document>> editedDocument(const Document& document,
                                                       std::vector<std::string> journal, bool live);

}  // namespace vasa::viewer
