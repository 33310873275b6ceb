#include <fmt/format.h>
#include <imgui.h>

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
    if (ImGui::SliderFloat(axes[axis], &angle, least, most, "%.0f°", ImGuiSliderFlags_AlwaysClamp)) turn.angles[axis] = glm::radians(angle);
  }
}

}  // namespace

void showPoseSection(const PanelInput& in) {
  if (!in.document || !ImGui::CollapsingHeader("Pose")) return;
  ViewState& state = in.state;
  const Skeleton& skeleton = in.document->scene.body.skeleton;
  ImGui::Checkbox("Drag joints (P)", &state.posing);
  ImGui::SameLine();
  if (ImGui::Button("Reset")) state.turns.clear();
  const auto names = namesOf(skeleton);
  ImGui::SetNextItemWidth(-1);
  if (ImGui::BeginCombo("##joint", state.joint.valid() ? names[state.joint.value].c_str() : "choose a joint")) {
    for (std::uint32_t j = 0; j < names.size(); ++j)
      if (ImGui::Selectable(names[j].c_str(), state.joint.value == j)) state.joint = {j};
    ImGui::EndCombo();
  }
  if (state.joint.valid() && state.joint.value < names.size()) showJoint(in, state.joint, jointMotions(skeleton)[state.joint.value]);
  std::size_t count = 0;
  for (const JointTurn& turn : state.turns) count += turn.angles != vec3(0);
  ImGui::TextDisabled("%zu joint%s turned beside the clip", count, count == 1 ? "" : "s");
}

void showHandles(const PanelInput& in) {
  if (!in.state.posing || !in.document || !in.body) return;
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  for (const JointHandle& handle : jointHandles(in.document->scene.body.skeleton, in.body->pose, in.camera, in.layout.picture)) {
    const ImVec2 place{handle.place.x, handle.place.y};
    const bool held = in.heldJoint == handle.joint;
    list.AddCircleFilled(place, (held ? 6.0f : 4.0f) * in.scale, held ? IM_COL32(255, 190, 25, 255) : IM_COL32(255, 255, 255, 210));
    list.AddCircle(place, (held ? 6.0f : 4.0f) * in.scale, IM_COL32(30, 30, 34, 255), 0, 1.5f * in.scale);
  }
}

}  // namespace vasa::viewer
