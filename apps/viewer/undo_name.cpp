#include "viewer/undo_name.h"

#include <algorithm>

#include "edit/journal.h"

namespace vasa::viewer {
namespace {

std::string editName(const std::string& line) {
  const auto edits = parseJournal(line, "");
  if (!edits || edits->empty()) return "edit";
  const EditOperation& operation = edits->front().operation;
  return std::string(operationName(operation)) + " of " + vesselOf(operation);
}

JointTurn turnOf(const std::vector<JointTurn>& turns, JointId joint) {
  const auto found = std::ranges::find(turns, joint, &JointTurn::joint);
  return found == turns.end() ? JointTurn{joint} : *found;
}

// The grip that moves all of these joints, and the fewest besides.
const Grip* gripOf(const Mannequin& mannequin, const std::vector<JointId>& joints) {
  const Grip* best = nullptr;
  for (const Grip& grip : mannequin.grips()) {
    const auto moves = [&](JointId joint) {
      return std::ranges::find(grip.limb.joints, joint, &ReachJoint::joint) != grip.limb.joints.end();
    };
    if (std::ranges::all_of(joints, moves) && (!best || grip.limb.joints.size() < best->limb.joints.size()))
      best = &grip;
  }
  return best;
}

std::string poseName(const Undoable& before, const Undoable& after, const Mannequin& mannequin) {
  std::vector<JointId> joints;
  for (const Undoable* step : {&before, &after})
    for (const JointTurn& turn : step->turns) {
      const JointTurn was = turnOf(before.turns, turn.joint), is = turnOf(after.turns, turn.joint);
      if (was.moved != is.moved && !after.turns.empty()) return "move of " + mannequin.nameOf(turn.joint);
      if (was.angles != is.angles && std::ranges::find(joints, turn.joint) == joints.end())
        joints.push_back(turn.joint);
    }
  if (joints.size() == 1) return "turn of " + mannequin.nameOf(joints.front());
  if (after.turns.empty()) return "reset of the pose";
  const Grip* grip = gripOf(mannequin, joints);
  return grip ? "move of " + grip->name : "pose";
}

}  // namespace

std::string undoName(const Undoable& before, const Undoable& after, const Mannequin& mannequin) {
  if (after.journal.size() < before.journal.size()) return "taking back an edit";
  if (before.journal != after.journal) return editName(after.journal.back());
  if (before.turns != after.turns) return poseName(before, after, mannequin);
  if (before.hidden != after.hidden) return after.hidden.any() ? "hiding" : "showing all";
  if (before.labelled != after.labelled) return "names in the picture";
  if (before.views != after.views) return "keeping a view";
  if (before.colouring != after.colouring) return "colouring";
  if (before.legend != after.legend) return "legend";
  if (before.contacts != after.contacts) return "contacts";
  if (before.forces != after.forces) return "what vessels follow";
  if (before.preset != after.preset || before.look != after.look) return "look";
  if (before.detail != after.detail || before.fineStills != after.fineStills) return "detail";
  if (before.cut != after.cut || before.cutPlane != after.cutPlane) return "cut";
  return "view";
}

}  // namespace vasa::viewer
