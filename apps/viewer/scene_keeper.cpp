#include "viewer/scene_keeper.h"

#include <algorithm>
#include <cmath>

#include "atlas/scene_look.h"
#include "core/atomic_file.h"
#include "viewer/kept_views.h"

namespace vasa::viewer {
namespace {

// To so many parts of a whole, as the nearest float: nothing more is written of it.
float rounded(float value, double parts) { return float(std::round(double(value) * parts) / parts); }

CameraChoice cameraOf(const Orbit& orbit) {
  const ViewChoice view = viewOf(orbit);
  CameraChoice choice;
  choice.position = view.position;
  choice.target = view.target;
  choice.angleDegrees = view.angleDegrees;
  choice.orthographic = view.orthographic;
  return choice;
}

LookChoice lookOf(const ViewState& state) {
  LookChoice choice = atlas::choiceOf(state.look, state.preset);
  choice.colour = atlas::kColourings[std::size_t(state.colouring)];
  choice.legend = state.legend;
  return choice;
}

}  // namespace

std::vector<TurnChoice> poseOf(const Skeleton& skeleton, std::span<const JointTurn> turns) {
  std::vector<TurnChoice> pose;
  for (const JointTurn& turn : turns) {
    vec3 degrees, metres;
    for (int axis = 0; axis < 3; ++axis) {
      degrees[axis] = rounded(glm::degrees(turn.angles[axis]), 100);
      metres[axis] = rounded(turn.moved[axis], 10'000);
    }
    if (degrees != vec3(0) || metres != vec3(0))
      pose.push_back({skeleton.joints[turn.joint.value].name, degrees, metres});
  }
  return pose;
}

std::vector<JointTurn> turnsOf(const Skeleton& skeleton, std::span<const TurnChoice> pose) {
  std::vector<JointTurn> turns;
  for (const TurnChoice& choice : pose) {
    const auto joint = std::ranges::find(skeleton.joints, choice.joint, &Skeleton::Joint::name);
    if (joint == skeleton.joints.end()) continue;
    const JointId id{std::uint32_t(joint - skeleton.joints.begin())};
    turns.push_back({id, glm::radians(choice.degrees), jointMotion(skeleton, id, {}).axes, choice.metres});
  }
  return turns;
}

void SceneKeeper::opened(const SceneFile& file, const ViewState& state) {
  file_ = file;
  orbit_ = state.orbit;
}

// As it is found wherever the program is installed: a scene without a body, or without networks too, has the
// built-in human's.
SceneFile SceneKeeper::withoutBuiltIn(SceneFile file) const {
  if (builtIn_.empty() || file.body != builtIn_ / "human.glb") return file;
  file.body.clear();
  // Without a table of holds these vessels have the built-in one: then what lacks it is named.
  if (file.networks != std::vector{builtIn_ / "human.vasa"} || file.holds.empty()) return file;
  file.networks.clear();
  if (file.holds == builtIn_ / "human.holds.csv") file.holds.clear();
  return file;
}

Result<std::filesystem::path> SceneKeeper::save(const Document& document, const ViewState& state,
                                                const std::filesystem::path& unnamed,
                                                const std::filesystem::path& as) {
  SceneFile file = file_;
  if (!as.empty() && as != file.path) {
    // The journal goes along under the new name.
    if (!file.path.empty() && !file.edits.empty() && file.edits.back() == ownJournal(file.path))
      file.edits.pop_back();
    file.path = as;
  }
  if (file.path.empty()) file.path = unnamed;
  const Body& body = document.scene.body;
  const Playback& playback = state.playback;
  const auto& clips = body.clips;
  file.clip = playback.clip >= 0 ? clips[std::size_t(playback.clip)].name : "";
  file.time =
      playback.clip >= 0 ? rounded(playback.time - clips[std::size_t(playback.clip)].start, 10000) : 0;
  if (!file.camera.position || state.orbit != orbit_) file.camera = cameraOf(state.orbit);
  file.look = lookOf(state);
  file.capillaries.levels = unsigned(state.detail.capillaries);
  file.hidden = state.hidden.list();
  file.labels = state.labelled.list();
  file.views = state.views;
  file.pose = poseOf(body.skeleton, state.turns);
  file.chosen = state.selected ? document.scene.network.vessel(state.selected->vessel).name : "";
  const auto journal = ownJournal(file.path);
  std::string lines;
  for (const std::string& line : document.journal) lines += line + "\n";
  const bool named = !file.edits.empty() && file.edits.back() == journal;
  if (!named && !lines.empty()) file.edits.push_back(journal);
  if (named || !lines.empty())
    if (const auto written = writeFileAtomically(journal, lines); !written) return written.error();
  const SceneFile written = withoutBuiltIn(file);
  if (const auto done = writeFileAtomically(file.path, sceneText(written, file.path.parent_path())); !done)
    return done.error();
  opened(file, state);
  return file.path;
}

}  // namespace vasa::viewer
