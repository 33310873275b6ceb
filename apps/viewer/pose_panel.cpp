#include <fmt/format.h>
#include <imgui.h>

#include <utility>

#include "viewer/panels.h"
#include "viewer/pose_tool.h"

// Posing: every joint by sliders, or dragged in the picture.
namespace vasa::viewer {
namespace {

std::vector<std::string> namesOf(const Skeleton& skeleton) {
  std::vector<std::string> names;
  for (const Skeleton::Joint& joint : skeleton.joints) names.push_back(joint.name);
  return names;
}

void showJoint(const PanelInput& in, JointId joint, const JointMotion& motion) {
  JointTurn& turn = turnOfJoint(in.state, joint, motion);
  constexpr const char* axes[] = {"bend", "spread", "twist"};
  for (int axis = 0; axis < 3; ++axis) {
    float angle = glm::degrees(turn.angles[axis]);
    ImGui::SetNextItemWidth(-60 * in.scale);
    const float least = glm::degrees(motion.least[axis]), most = glm::degrees(motion.most[axis]);
    if (ImGui::SliderFloat(axes[axis], &angle, least, most, "%.0f°", ImGuiSliderFlags_AlwaysClamp))
      turn.angles[axis] = glm::radians(angle);
  }
}

// The joints that are turned beside what the clip does; a click takes one to the sliders.
void showTurned(ViewState& state, const std::vector<std::string>& names) {
  bool first = true;
  for (const JointTurn& turn : state.turns) {
    if (turn.angles == vec3(0) || turn.joint.value >= names.size()) continue;
    if (std::exchange(first, false)) ImGui::TextDisabled("turned beside the clip");
    ImGui::PushID(int(turn.joint.value));
    if (ImGui::Selectable(names[turn.joint.value].c_str(), state.joint == turn.joint))
      state.joint = turn.joint;
    ImGui::PopID();
  }
}

// What a handle turns, beside it.
void showName(const PanelInput& in, const std::string& name, ImVec2 at) {
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  const ImVec2 size = ImGui::CalcTextSize(name.c_str());
  const float gap = 4 * in.scale;
  const ImVec2 low{at.x + 10 * in.scale, at.y - size.y / 2};
  list.AddRectFilled({low.x - gap, low.y - gap / 2}, {low.x + size.x + gap, low.y + size.y + gap / 2},
                     IM_COL32(30, 30, 34, 220), gap);
  list.AddText(low, IM_COL32(235, 236, 238, 255), name.c_str());
}

}  // namespace

void showPoseSection(const PanelInput& in) {
  if (!in.document || !ImGui::CollapsingHeader("Pose")) return;
  ViewState& state = in.state;
  const Skeleton& skeleton = in.document->scene.body.skeleton;
  ImGui::Checkbox("Drag joints (P)", &state.posing);
  ImGui::SameLine();
  if (ImGui::Button("Reset")) state.turns.clear();
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("The clip's pose");
  const auto names = namesOf(skeleton);
  ImGui::SetNextItemWidth(-1);
  if (ImGui::BeginCombo("##joint", state.joint.valid() ? names[state.joint.value].c_str() : "choose a joint",
                        ImGuiComboFlags_HeightLarge)) {
    for (std::uint32_t j = 0; j < names.size(); ++j)
      if (ImGui::Selectable(names[j].c_str(), state.joint.value == j)) state.joint = {j};
    ImGui::EndCombo();
  }
  if (state.joint.valid() && state.joint.value < names.size())
    showJoint(in, state.joint, jointMotions(skeleton)[state.joint.value]);
  showTurned(state, names);
}

void showHandles(const PanelInput& in) {
  if (!in.state.posing || !in.document || !in.body) return;
  const Skeleton& skeleton = in.document->scene.body.skeleton;
  const auto handles = jointHandles(skeleton, in.body->pose, in.camera, in.layout.picture, in.scale);
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  const auto under =
      ImGui::GetIO().WantCaptureMouse ? std::nullopt : handleAt(handles, {mouse.x, mouse.y}, in.scale);
  const JointId lit = in.heldJoint.valid() ? in.heldJoint : under ? under->joint : JointId{};
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  for (const JointHandle& handle : handles) {
    const ImVec2 place{handle.place.x, handle.place.y};
    const bool bright = handle.joint == lit;
    const float radius = (bright ? 6.0f : 4.0f) * in.scale;
    list.AddCircleFilled(place, radius, bright ? IM_COL32(255, 190, 25, 255) : IM_COL32(255, 255, 255, 210));
    list.AddCircle(place, radius, IM_COL32(30, 30, 34, 255), 0, 1.5f * in.scale);
    if (bright) showName(in, skeleton.joints[skeleton.joints[handle.joint.value].parent.value].name, place);
  }
}

}  // namespace vasa::viewer
