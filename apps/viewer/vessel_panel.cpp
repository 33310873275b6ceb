#include <imgui.h>

#include "viewer/panels.h"
#include "shared/growth.h"

namespace vasa::viewer {

void showVesselSection(const PanelInput& in) {
  if (!ImGui::CollapsingHeader("Vessels", ImGuiTreeNodeFlags_DefaultOpen)) return;
  Detail& detail = in.state.detail;
  ImGui::Checkbox("Quads by size", &detail.automatic);
  if (!detail.automatic) {
    int quads[2] = {detail.around, detail.along};
    ImGui::SetNextItemWidth(-90 * in.scale);
    if (ImGui::SliderInt2("m x n", quads, 2, 16)) {
      detail.around = std::max(quads[0], 3);
      detail.along = quads[1];
    }
  }
  if (in.document && in.document->growth) {
    ImGui::SetNextItemWidth(-90 * in.scale);
    ImGui::SliderInt("Capillaries", &detail.capillaries, 0, int(shared::kMostGrowthLevels), detail.capillaries ? "%d generations" : "none",
                     ImGuiSliderFlags_AlwaysClamp);
  }
  Forces& forces = in.state.forces;
  ImGui::Checkbox("Keep apart", &forces.avoid);
  ImGui::SameLine();
  ImGui::Checkbox("Keep volume", &forces.volume);
  ImGui::Checkbox("Show contacts", &in.state.contacts);
  ImGui::SameLine();
  ImGui::Checkbox("Beat", &forces.beat);
  if (in.state.contacts && in.body) {
    const FrameReport& report = in.body->report;
    ImGui::TextDisabled("%u contacts, %u left", report.avoid.before.contacts, report.avoid.after.contacts);
  }
}

}  // namespace vasa::viewer
