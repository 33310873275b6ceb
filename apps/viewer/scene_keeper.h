#pragma once
#include "viewer/document.h"
#include "viewer/view_state.h"

namespace vasa::viewer {

/// Joints by name as a scene has them, and back; joints that a body does not have are left out.
std::vector<TurnChoice> poseOf(const Skeleton& skeleton, std::span<const JointTurn> turns);
std::vector<JointTurn> turnsOf(const Skeleton& skeleton, std::span<const TurnChoice> pose);

/// The scene file that is being worked on: what was read from it, and what is written to it.
class SceneKeeper {
 public:
  /// @param builtIn  folder of the human that ships with the program: scenes do not name it
  explicit SceneKeeper(std::filesystem::path builtIn) : builtIn_(std::move(builtIn)) {}

  /// What is shown is what this file says.
  void opened(const SceneFile& file, const ViewState& state);
  /// Writes the journal beside the scene, then the scene, each whole or not at all. A view that has not been
  /// changed is written as it was read, to the last digit.
  /// @param unnamed  of a scene that has no file yet
  /// @param as       another file from now on; empty: the one it has
  Result<std::filesystem::path> save(const Document& document, const ViewState& state,
                                     const std::filesystem::path& unnamed,
                                     const std::filesystem::path& as = {});
  /// Another motion is shown, from its start; all else is as it was.
  void takeMotion(const std::string& clip) { file_.clip = clip, file_.time = 0; }
  /// As it was opened or saved last.
  const SceneFile& file() const { return file_; }
  /// Empty: there is none yet.
  const std::filesystem::path& path() const { return file_.path; }

 private:
  SceneFile withoutBuiltIn(SceneFile file) const;

  std::filesystem::path builtIn_;
  SceneFile file_;
  Orbit orbit_;
};

}  // namespace vasa::viewer
