#include "viewer/flow.h"

#include <imgui.h>

namespace vasa::viewer {

float checkboxWidth(const char* name) {
  return ImGui::GetFrameHeight() + ImGui::GetStyle().ItemInnerSpacing.x + ImGui::CalcTextSize(name).x;
}

float buttonWidth(const char* name) {
  return ImGui::CalcTextSize(name).x + 2 * ImGui::GetStyle().FramePadding.x;
}

void sameLineWithRoom(float width) {
  const float end = ImGui::GetWindowPos().x + ImGui::GetWindowContentRegionMax().x;
  if (ImGui::GetItemRectMax().x + ImGui::GetStyle().ItemSpacing.x + width <= end) ImGui::SameLine();
}

bool selectableLines(const std::string& text, bool chosen) {
  const float width = ImGui::GetContentRegionAvail().x;
  const ImVec2 at = ImGui::GetCursorPos();
  const float height = ImGui::CalcTextSize(text.c_str(), nullptr, false, width).y;
  ImGui::PushID(text.c_str());
  const bool clicked = ImGui::Selectable("##lines", chosen, 0, {0, height});
  ImGui::PopID();
  const ImVec2 next = ImGui::GetCursorPos();
  ImGui::SetCursorPos(at);
  ImGui::PushTextWrapPos(at.x + width);
  ImGui::TextUnformatted(text.c_str());
  ImGui::PopTextWrapPos();
  ImGui::SetCursorPos(next);
  return clicked;
}

}  // namespace vasa::viewer
