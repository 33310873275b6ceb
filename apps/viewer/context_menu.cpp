#include <imgui.h>

#include <utility>

#include "viewer/actions.h"
#include "viewer/panels.h"
#include "viewer/pose_tool.h"

// What can be done with a vessel or a joint that was clicked with the right button.
namespace vasa::viewer {
namespace {

void showItems(const PanelInput& in, std::initializer_list<ActionId> ids) {
  for (const ActionId id : ids) showActionItem(in, id);
}

void showVesselMenu(const PanelInput& in) {
  const auto& vessel = in.document->scene.network.vessel(in.state.selected->vessel);
  ImGui::TextDisabled("%s", vessel.name.c_str());
  ImGui::Separator();
  showItems(in, {ActionId::focus, ActionId::isolate, ActionId::label, ActionId::hide, ActionId::hideOthers,
                 ActionId::showAll});
  ImGui::Separator();
  showColourings(in);
  ImGui::Separator();
  showItems(in, {ActionId::stenosis, ActionId::branch, ActionId::graft});
  // Deleting belongs to editing; here it begins it.
  for (const ActionId id : {ActionId::remove, ActionId::removeTree})
    if (ImGui::MenuItem(actionOf(id).name)) in.state.editing = true, perform(id, in.state, in.document);
}

void showJointMenu(const PanelInput& in, JointId joint) {
  const Mannequin& mannequin = *in.document->mannequin;
  ImGui::TextDisabled("%s", mannequin.nameOf(joint).c_str());
  ImGui::Separator();
  if (ImGui::MenuItem("Reset this joint")) {
    turnOfJoint(in.state, joint, mannequin.motion(joint)).angles = vec3(0);
    followOnOtherSide(mannequin, in.state, joint);
  }
  if (const JointId twin = mannequin.twinOf(joint);
      twin != joint && ImGui::MenuItem("Same on the other side")) {
    const vec3 angles = turnOfJoint(in.state, joint, mannequin.motion(joint)).angles;
    turnOfJoint(in.state, twin, mannequin.motion(twin)).angles = mirroredAngles(angles);
  }
  ImGui::Separator();
  showItems(in, {ActionId::bothSides, ActionId::mirrorPose, ActionId::resetPose, ActionId::copyPose,
                 ActionId::pastePose});
}

}  // namespace

void showContextMenu(const PanelInput& in) {
  ContextTarget& target = in.state.context;
  if (std::exchange(target.opens, false)) ImGui::OpenPopup("##context");
  if (!ImGui::BeginPopup("##context")) return;
  if (in.document && target.joint.valid())
    showJointMenu(in, target.joint);
  else if (in.document && target.vessel && in.state.selected)
    showVesselMenu(in);
  else {
    showItems(in, {ActionId::home, ActionId::front, ActionId::leftSide, ActionId::back, ActionId::showAll});
    showColourings(in);
    showItems(in, {ActionId::outliner, ActionId::pose, ActionId::edit});
  }
  ImGui::EndPopup();
}

}  // namespace vasa::viewer
