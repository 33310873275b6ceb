#include <imgui.h>

#include <algorithm>

#include "viewer/actions.h"
#include "viewer/panels.h"

// F1: what keys and the mouse do, menu after menu.
namespace vasa::viewer {
namespace {

void showRows(const char* title, std::span<const Shortcut> rows, float scale) {
  ImGui::TextUnformatted(title);
  if (!ImGui::BeginTable(title, 2, ImGuiTableFlags_SizingFixedFit)) return;
  ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthFixed, 140 * scale);
  ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthStretch);
  for (const Shortcut& row : rows) {
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(row.keys.c_str());
    ImGui::TableNextColumn();
    ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled));
    ImGui::TextWrapped("%s", row.what.c_str());
    ImGui::PopStyleColor();
  }
  ImGui::EndTable();
  ImGui::Spacing();
}

}  // namespace

void showHelp(const PanelInput& in) {
  if (!in.state.help) return;
  const ImVec2 window = ImGui::GetIO().DisplaySize;
  const float edge = 16 * in.scale, most = 860 * in.scale;
  const ImVec2 size{std::min(window.x - 2 * edge, most), std::min(window.y - 2 * edge, 560 * in.scale)};
  ImGui::SetNextWindowPos({window.x / 2, window.y / 2}, 0, {0.5f, 0.5f});
  ImGui::SetNextWindowSize(size);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, std::max(1.0f, in.scale));
  if (ImGui::Begin("Keys and mouse", &in.state.help,
                   ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                       ImGuiWindowFlags_NoCollapse)) {
    const bool wide = size.x > 640 * in.scale;
    ImGui::PushStyleVar(ImGuiStyleVar_CellPadding, {10 * in.scale, 0});
    const bool sides = ImGui::BeginTable("##sides", wide ? 2 : 1);
    ImGui::PopStyleVar();
    if (sides) {
      ImGui::TableNextColumn();
      showRows("Mouse", mouseShortcuts(), in.scale);
      for (const MenuId menu : {MenuId::file, MenuId::edit, MenuId::pose})
        showRows(kMenuNames[std::size_t(menu)], shortcutsOf(menu), in.scale);
      ImGui::TableNextColumn();
      for (const MenuId menu : {MenuId::view, MenuId::help})
        showRows(kMenuNames[std::size_t(menu)], shortcutsOf(menu), in.scale);
      ImGui::EndTable();
    }
    ImGui::TextWrapped("vasa help view and vasa help scenes tell more.");
  }
  ImGui::End();
  ImGui::PopStyleVar();
}

}  // namespace vasa::viewer
