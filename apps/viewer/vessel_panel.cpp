#include <imgui.h>

#include <algorithm>

#include "shared/growth.h"
#include "viewer/flow.h"
#include "viewer/panels.h"

namespace vasa::viewer {

void showVesselSection(const PanelInput& in) {
  if (!ImGui::CollapsingHeader("Vessels", ImGuiTreeNodeFlags_DefaultOpen)) return;
  Detail& detail = in.state.detail;
  const auto explain = [](const char* text) {
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", text);
  };
  ImGui::Checkbox("Quads by size", &detail.automatic);
  explain("As many quads around and along each vessel as its size in the picture asks for");
  if (!detail.automatic) {
    int quads[2] = {detail.around, detail.along};
    ImGui::SetNextItemWidth(-90 * in.scale);
    if (ImGui::SliderInt2("m x n", quads, 2, 16)) {
      detail.around = std::max(quads[0], 3);
      detail.along = quads[1];
    }
  }
  if (in.document && in.document->growth.any()) {
    ImGui::SetNextItemWidth(-90 * in.scale);
    ImGui::SliderInt("Capillaries", &detail.capillaries, 0, int(shared::kMostGrowthLevels),
                     detail.capillaries ? "%d generations" : "none", ImGuiSliderFlags_AlwaysClamp);
  }
  Forces& forces = in.state.forces;
  const bool pairs = ImGui::GetContentRegionAvail().x > 2 * checkboxWidth("Keep volume") + 16 * in.scale;
  if (ImGui::BeginTable("##forces", pairs ? 2 : 1)) {
    const auto item = [&](const char* name, bool& on, const char* text) {
      ImGui::TableNextColumn();
      ImGui::Checkbox(name, &on);
      explain(text);
    };
    item("Keep apart", forces.avoid, "Move vessels that run through one another or through bone");
    item("Keep volume", forces.volume, "A vessel that is stretched gets thinner");
    item("Contacts (C)", in.state.contacts,
         "Grey vessels; yellow: ran through another before they were moved, red: still do");
    item("Heartbeat", forces.beat, "The heart beats, and the vessels beside it go along");
    ImGui::EndTable();
  }
  const ImGuiStyle& style = ImGui::GetStyle();
  const float room =
      ImGui::GetContentRegionAvail().x - style.ItemInnerSpacing.x - ImGui::CalcTextSize("colour (K)").x;
  const float beside = room - style.ItemSpacing.x - checkboxWidth("Legend (L)");
  ImGui::SetNextItemWidth(std::clamp(beside, std::min(90 * in.scale, room), 110 * in.scale));
  int colouring = int(in.state.colouring);
  if (ImGui::Combo("colour (K)", &colouring, atlas::kColourings.data(), int(atlas::kColourings.size())))
    setColouring(in.state, atlas::Colouring(colouring));
  sameLineWithRoom(checkboxWidth("Legend (L)"));
  ImGui::Checkbox("Legend (L)", &in.state.legend);
  if (in.state.contacts && in.body) {
    const FrameReport& report = in.body->report;
    ImGui::TextDisabled("%u contacts, %u left", in.body->contactsBefore, report.avoid.after.contacts);
  }
}

}  // namespace vasa::viewer
