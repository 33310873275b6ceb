#include <fmt/format.h>
#include <imgui.h>

#include <cmath>
#include <utility>

#include "viewer/flow.h"
#include "viewer/joint_names.h"
#include "viewer/label.h"
#include "viewer/panels.h"
#include "viewer/pose_tool.h"

// Posing: every joint by sliders, or dragged in the picture.
namespace vasa::viewer {
namespace {

// A joint's motions that go nowhere are shown only where something is turned that way all the same.
bool moves(const JointMotion& motion, const JointTurn& turn, int axis) {
  constexpr float kHardly = 0.21f, kTurned = 0.02f;  // [rad]
  return motion.most[axis] - motion.least[axis] > kHardly || std::abs(turn.angles[axis]) > kTurned;
}

void showJoint(const PanelInput& in, JointId joint) {
  const Mannequin& mannequin = *in.document->mannequin;
  const JointMotion& motion = mannequin.motion(joint);
  const std::string_view part = mannequin.partOf(joint);
  const vec3 senses = sensesOf(part);
  JointTurn& turn = turnOfJoint(in.state, joint, motion);
  bool changed = false;
  for (int axis = 0; axis < 3; ++axis) {
    if (!moves(motion, turn, axis)) continue;
    float angle = glm::degrees(senses[axis] * turn.angles[axis]);
    if (std::abs(angle) < 0.5f) angle = 0;  // not "-0"
    float least = glm::degrees(senses[axis] * motion.least[axis]),
          most = glm::degrees(senses[axis] * motion.most[axis]);
    if (least > most) std::swap(least, most);
    ImGui::SetNextItemWidth(-80 * in.scale);
    if (!ImGui::SliderFloat(wordForAxis(part, axis), &angle, least, most, "%.0f°",
                            ImGuiSliderFlags_AlwaysClamp))
      continue;
    turn.angles[axis] = senses[axis] * glm::radians(angle);
    changed = true;
  }
  if (changed) followOnOtherSide(mannequin, in.state, joint);
}

// "left elbow: flexion 45°"; more of them in one line.
std::string described(const Mannequin& mannequin, const JointTurn& turn) {
  const std::string_view part = mannequin.partOf(turn.joint);
  const vec3 senses = sensesOf(part);
  std::string text = mannequin.nameOf(turn.joint);
  const char* mark = ": ";
  for (int axis = 0; axis < 3; ++axis) {
    const float degrees = std::round(glm::degrees(senses[axis] * turn.angles[axis]));
    if (degrees == 0) continue;
    text += fmt::format("{}{} {:.0f}°", mark, wordForAxis(part, axis), degrees);
    mark = ", ";
  }
  if (turn.moved == vec3(0)) return text;
  const vec3 mm = glm::round(1000.0f * turn.moved) + 0.0f;  // not "-0"
  return text + fmt::format("{}{:.0f} mm up, {:.0f} to the left, {:.0f} forwards", mark, mm.y, mm.x, mm.z);
}

// The joints that are turned beside what the clip does; a click takes one to the sliders.
void showTurned(const PanelInput& in) {
  bool first = true;
  for (const JointTurn& turn : in.state.turns) {
    if (!turn.any()) continue;
    if (std::exchange(first, false)) ImGui::TextDisabled("posed beside the clip");
    ImGui::PushID(int(turn.joint.value));
    const std::string text = described(*in.document->mannequin, turn);
    if (selectableLines(text, in.state.joint == turn.joint)) in.state.joint = turn.joint;
    ImGui::PopID();
  }
}

// What concerns the pose as a whole.
void showPoseButtons(const PanelInput& in) {
  ViewState& state = in.state;
  const auto explained = [](bool pressed, const char* text) {
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", text);
    return pressed;
  };
  ImGui::Checkbox("Drag joints (P)", &state.posing);
  sameLineWithRoom(checkboxWidth("Both sides"));
  explained(ImGui::Checkbox("Both sides", &state.bothSides),
            "The body's other side does what is done to one");
  if (explained(ImGui::Button("Reset"), "The clip's pose")) state.turns.clear();
  sameLineWithRoom(buttonWidth("Mirror"));
  if (explained(ImGui::Button("Mirror"), "Left and right change places"))
    state.turns = mirroredTurns(*in.document->mannequin, state.turns);
  sameLineWithRoom(buttonWidth("Copy"));
  if (explained(ImGui::Button("Copy"), "Ctrl C while posing: the pose as text, as scenes have it"))
    state.wishCopyPose = true;
  sameLineWithRoom(buttonWidth("Paste"));
  if (explained(ImGui::Button("Paste"), "Ctrl V while posing")) state.wishPastePose = true;
}

void showJointChoice(const PanelInput& in) {
  ViewState& state = in.state;
  const Mannequin& mannequin = *in.document->mannequin;
  const float reset = state.joint.valid() ? 60 * in.scale : 0;
  ImGui::SetNextItemWidth(reset > 0 ? -reset : -1);
  if (ImGui::BeginCombo("##joint",
                        state.joint.valid() ? mannequin.nameOf(state.joint).c_str() : "choose a joint",
                        ImGuiComboFlags_HeightLarge)) {
    for (const std::uint32_t j : mannequin.listed()) {
      ImGui::PushID(int(j));
      if (ImGui::Selectable(mannequin.nameOf({j}).c_str(), state.joint.value == j)) state.joint = {j};
      ImGui::PopID();
    }
    ImGui::EndCombo();
  }
  if (!state.joint.valid()) return;
  ImGui::SameLine();
  if (ImGui::Button("Reset##joint")) {
    JointTurn& turn = turnOfJoint(state, state.joint, mannequin.motion(state.joint));
    turn.angles = turn.moved = vec3(0);
    followOnOtherSide(mannequin, state, state.joint);
  }
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("This joint as the clip has it");
  showJoint(in, state.joint);
}

}  // namespace

void showPoseSection(const PanelInput& in) {
  if (!in.document || !ImGui::CollapsingHeader("Pose")) return;
  showPoseButtons(in);
  showJointChoice(in);
  showTurned(in);
}

void showHandles(const PanelInput& in) {
  if (!in.state.posing || !in.document || !in.body) return;
  const Mannequin& mannequin = *in.document->mannequin;
  const auto handles = jointHandles(mannequin, in.body->pose, in.camera, in.layout.picture, in.scale);
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  const auto under =
      ImGui::GetIO().WantCaptureMouse ? std::nullopt : handleAt(handles, {mouse.x, mouse.y}, in.scale);
  const std::size_t none = mannequin.grips().size();
  const std::size_t lit = in.heldGrip.value_or(under ? under->grip : none);
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  const JointHandle* named = nullptr;
  for (const JointHandle& handle : handles) {
    const ImVec2 place{handle.place.x, handle.place.y};
    const bool bright = handle.grip == lit;
    const float radius = (bright ? kHandleRadius + 2 : kHandleRadius) * in.scale;
    list.AddCircleFilled(place, radius, bright ? IM_COL32(255, 190, 25, 255) : IM_COL32(255, 255, 255, 170));
    list.AddCircle(place, radius, IM_COL32(30, 30, 34, 255), 0, 1.5f * in.scale);
    if (bright) named = &handle;
  }
  if (named)
    drawLabel(named->place, mannequin.grips()[named->grip].name, 10 * in.scale, in.layout.picture, in.scale);
}

}  // namespace vasa::viewer
