#include <imgui.h>

#include "viewer/panels.h"
#include "viewer/projection.h"

// The cutting plane: sliders in the panel, its outline in the picture.
namespace vasa::viewer {
void showCutControls(const PanelInput& in) {
  CutPlane& cut = in.state.cutPlane;
  ImGui::Checkbox("Cutting plane (X)", &cut.on);
  if (!cut.on) return;
  const auto slider = [&](const char* name, float& value, float least, float most, const char* format) {
    ImGui::SetNextItemWidth(-90 * in.scale);
    ImGui::SliderFloat(name, &value, least, most, format, ImGuiSliderFlags_AlwaysClamp);
  };
  slider("Depth", cut.place, 0, 1, "%.3f");
  slider("Turn", cut.turn, -180, 180, "%.0f°");
  slider("Tilt", cut.tilt, -90, 90, "%.0f°");
  if (ImGui::Button("Front")) cut.turn = cut.tilt = 0;
  ImGui::SameLine();
  if (ImGui::Button("Side")) cut.turn = 90, cut.tilt = 0;
  ImGui::SameLine();
  if (ImGui::Button("Top")) cut.turn = 0, cut.tilt = 90;
  ImGui::SameLine();
  if (ImGui::Button("To me")) faceViewer(cut, -cameraAxes(in.camera)[2]);
}

void showCutOutline(const PanelInput& in) {
  if (!in.state.cutPlane.on || !in.document) return;
  const Rect& picture = in.layout.picture;
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  list.PushClipRect({picture.left, picture.top},
                    {picture.left + picture.width, picture.top + picture.height});
  const auto corners = cutOutline(in.state.cutPlane, in.bodyBox);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const auto from = seenAt(corners[i], in.camera, picture),
               to = seenAt(corners[(i + 1) % corners.size()], in.camera, picture);
    if (from && to)
      list.AddLine({from->x, from->y}, {to->x, to->y}, IM_COL32(255, 165, 20, 220), 1.5f * in.scale);
  }
  list.PopClipRect();
}

}  // namespace vasa::viewer
