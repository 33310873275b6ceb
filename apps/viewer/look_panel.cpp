#include <imgui.h>

#include "viewer/flow.h"
#include "viewer/panels.h"

namespace vasa::viewer {
namespace {

void choosePreset(ViewState& state) {
  for (const char* name : {"atlas", "clinical", "xray"}) {
    if (name[0] != 'a') sameLineWithRoom(checkboxWidth(name));
    if (!ImGui::RadioButton(name, state.preset == name)) continue;
    state.preset = name;
    Look look = *lookNamed(name);
    look.drawArteries = state.look.drawArteries;
    look.drawVeins = state.look.drawVeins;
    look.drawOtherVessels = state.look.drawOtherVessels;
    look.drawBones = state.look.drawBones;
    look.drawHeart = state.look.drawHeart;
    look.drawOther = state.look.drawOther;
    look.drawSkin = state.look.drawSkin;
    state.look = look;
  }
}

// What is shown, and how much it lets shine through.
void showParts(const PanelInput& in, Look& look) {
  if (!ImGui::BeginTable("##parts", 2)) return;
  ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthFixed, 110 * in.scale);
  ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthStretch);
  const auto row = [](const char* name, bool* shown, float& opacity) {
    ImGui::TableNextColumn();
    ImGui::PushID(name);
    if (shown)
      ImGui::Checkbox(name, shown);
    else
      ImGui::AlignTextToFramePadding(), ImGui::TextUnformatted(name);
    ImGui::TableNextColumn();
    ImGui::SetNextItemWidth(-1);
    ImGui::SliderFloat("##opacity", &opacity, 0, 1, "%.2f", ImGuiSliderFlags_AlwaysClamp);
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("Opacity");
    ImGui::PopID();
  };
  row("Arteries", &look.drawArteries, look.arteryOpacity);
  row("Veins", &look.drawVeins, look.veinOpacity);
  row("Bones", &look.drawBones, look.boneOpacity);
  row("Heart", &look.drawHeart, look.heartOpacity);
  row("Organs", &look.drawOther, look.otherOpacity);
  row("Skin", &look.drawSkin, look.skinOpacity);
  if (in.state.detail.capillaries > 0) row("Capillaries", nullptr, look.capillaryOpacity);
  ImGui::EndTable();
  look.drawOtherVessels = look.drawOther;
}

}  // namespace

void showLookSection(const PanelInput& in) {
  if (!ImGui::CollapsingHeader("Look", ImGuiTreeNodeFlags_DefaultOpen)) return;
  Look& look = in.state.look;
  choosePreset(in.state);
  showParts(in, look);
  showCutControls(in);
  ImGui::SetNextItemWidth(-90 * in.scale);
  ImGui::SliderFloat("Near cut", &in.state.cut, 0, 1, in.state.cut > 0 ? "%.2f" : "off",
                     ImGuiSliderFlags_AlwaysClamp);
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("Cuts off what is nearer to you, wherever you look from");
  bool orthographic = in.state.orbit.orthographic();
  if (ImGui::Checkbox("Orthographic", &orthographic)) in.state.orbit.setOrthographic(orthographic);
  sameLineWithRoom(checkboxWidth("Fine stills"));
  ImGui::Checkbox("Fine stills", &in.state.fineStills);
  if (ImGui::IsItemHovered())
    ImGui::SetTooltip("What stands still is drawn anew with 4 samples a pixel and occlusion");
}

}  // namespace vasa::viewer
