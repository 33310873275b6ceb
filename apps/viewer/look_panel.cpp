#include <imgui.h>

#include "viewer/panels.h"

namespace vasa::viewer {
namespace {

void choosePreset(ViewState& state) {
  for (const char* name : {"atlas", "clinical", "xray"}) {
    if (name[0] != 'a') ImGui::SameLine();
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

}  // namespace

void showLookSection(const PanelInput& in) {
  if (!ImGui::CollapsingHeader("Look", ImGuiTreeNodeFlags_DefaultOpen)) return;
  Look& look = in.state.look;
  choosePreset(in.state);
  if (ImGui::BeginTable("##shown", 2)) {
    const auto item = [&](const char* name, bool& shown) {
      ImGui::TableNextColumn();
      ImGui::Checkbox(name, &shown);
    };
    item("Arteries", look.drawArteries);
    item("Veins", look.drawVeins);
    item("Bones", look.drawBones);
    item("Heart", look.drawHeart);
    item("Skin", look.drawSkin);
    item("Other", look.drawOther);
    ImGui::EndTable();
  }
  look.drawOtherVessels = look.drawOther;
  ImGui::TextDisabled("Opacity");
  const auto opacity = [&](const char* name, float& value) {
    ImGui::SetNextItemWidth(-90 * in.scale);
    ImGui::SliderFloat(name, &value, 0, 1, "%.2f", ImGuiSliderFlags_AlwaysClamp);
  };
  opacity("Skin##opacity", look.skinOpacity);
  opacity("Bones##opacity", look.boneOpacity);
  opacity("Heart##opacity", look.heartOpacity);
  opacity("Arteries##opacity", look.arteryOpacity);
  opacity("Veins##opacity", look.veinOpacity);
  if (in.state.detail.capillaries > 0) opacity("Capillaries##opacity", look.capillaryOpacity);
  look.otherOpacity = look.heartOpacity;
  showCutControls(in);
  ImGui::SetNextItemWidth(-90 * in.scale);
  ImGui::SliderFloat("Cut", &in.state.cut, 0, 1, in.state.cut > 0 ? "%.2f" : "off", ImGuiSliderFlags_AlwaysClamp);
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("Cuts off what is nearer to you");
  bool orthographic = in.state.orbit.orthographic();
  if (ImGui::Checkbox("Orthographic", &orthographic)) in.state.orbit.setOrthographic(orthographic);
  ImGui::SameLine();
  ImGui::Checkbox("Fine stills", &in.state.fineStills);
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("What stands still is drawn anew with 4 samples a pixel and occlusion");
}

}  // namespace vasa::viewer
