#include "viewer/panels.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>

namespace vasa::viewer {
namespace {

constexpr ImGuiWindowFlags kFixed = ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize |
                                    ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                                    ImGuiWindowFlags_NoCollapse;
constexpr ImGuiWindowFlags kText = kFixed | ImGuiWindowFlags_NoInputs | ImGuiWindowFlags_AlwaysAutoResize |
                                   ImGuiWindowFlags_NoFocusOnAppearing;

void place(const Rect& rect) {
  ImGui::SetNextWindowPos({rect.left, rect.top});
  ImGui::SetNextWindowSize({rect.width, rect.height});
}

// A share where one is known, else (below 0) something that moves: the work goes on.
void showProgressBar(float done, float scale) {
  const ImVec2 size{ImGui::GetContentRegionAvail().x, 6 * scale};
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const bool known = done >= 0;
  const float share = known ? done : 0.25f;
  const float phase = std::fmod(float(ImGui::GetTime()), 1.6f) / 0.8f;
  const float from = known ? 0 : (1 - share) * std::min(phase, 2 - phase);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddRectFilled(at, {at.x + size.x, at.y + size.y}, ImGui::GetColorU32(ImGuiCol_FrameBg), size.y / 2);
  list.AddRectFilled({at.x + from * size.x, at.y}, {at.x + (from + share) * size.x, at.y + size.y},
                     ImGui::GetColorU32(ImGuiCol_SliderGrab), size.y / 2);
  ImGui::Dummy(size);
}

void showProgress(const PanelInput& in, const Loader::Stage& stage) {
  ImGui::TextWrapped("Opening %s", in.loadingTitle.c_str());
  const bool known = stage.total > 1;
  showProgressBar(known ? float(stage.done) / float(stage.total) : -1, in.scale);
  if (known)
    ImGui::TextDisabled("%s: %zu of %zu", stage.what, stage.done, stage.total);
  else
    ImGui::TextDisabled("%s", stage.what);
  if (ImGui::Button("Cancel (Esc)")) in.state.wishCancel = true;
}

void showSide(const PanelInput& in) {
  if (in.layout.panels.width <= 0) return;
  place(in.layout.panels);
  if (ImGui::Begin("##side", nullptr, kFixed)) {
    showEditSection(in);
    showInspectorSection(in);
    showLookSection(in);
    showVesselSection(in);
    showPoseSection(in);
    showTimingSection(in);
  }
  ImGui::End();
}

}  // namespace

void showHeads(const PanelInput& in) {
  if (!in.document) return;
  const vec4 page = in.state.look.background;
  const bool light = page.x > 0.5f;
  const float edge = 6 * in.scale;
  ImGui::PushStyleColor(ImGuiCol_Text,
                        light ? ImVec4(0.15f, 0.15f, 0.17f, 1) : ImVec4(0.85f, 0.86f, 0.88f, 1));
  ImGui::PushStyleColor(ImGuiCol_TextDisabled,
                        light ? ImVec4(0.36f, 0.37f, 0.40f, 1) : ImVec4(0.66f, 0.68f, 0.71f, 1));
  ImGui::PushStyleColor(ImGuiCol_WindowBg, ImVec4(page.x, page.y, page.z, 0.82f));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, edge);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {10 * in.scale, 6 * in.scale});
  ImGui::SetNextWindowPos({in.layout.picture.left + edge, in.layout.picture.top + edge});
  if (ImGui::Begin("##head", nullptr, kText)) {
    const Network& network = in.document->scene.network;
    ImGui::PushTextWrapPos(in.layout.picture.width - 2 * edge - ImGui::GetStyle().WindowPadding.x);
    ImGui::Text("%s", in.document->title.c_str());
    ImGui::TextDisabled("%zu vessels, %u sweeps", network.vessels().size(), network.sweepCount());
    if (in.state.recording) ImGui::TextColored({0.85f, 0.15f, 0.12f, 1}, "recording (R ends it)");
    if (in.state.posing) ImGui::TextUnformatted("drag a joint; Ctrl: it alone (P ends it)");
    if (in.state.measuring) ImGui::TextUnformatted("click two vessels (M ends it)");
    showRefusal(in);
    if (!in.message.empty()) ImGui::TextUnformatted(in.message.c_str());
    ImGui::PopTextWrapPos();
  }
  ImGui::End();
  ImGui::PopStyleVar(2);
  ImGui::PopStyleColor(3);
}

void showLoading(const PanelInput& in) {
  if (!in.loading && in.document) return;
  const Rect& picture = in.layout.picture;
  ImGui::SetNextWindowPos({picture.left + picture.width / 2, picture.top + picture.height / 2}, 0,
                          {0.5f, 0.5f});
  ImGui::SetNextWindowSize({std::min(360 * in.scale, picture.width), 0});
  if (ImGui::Begin("##loading", nullptr, kFixed)) {
    if (in.loading)
      showProgress(in, *in.loading);
    else
      ImGui::TextWrapped(
          "Nothing is open. Drop a scene (.json), or a body (.glb) together with its vessels, here.");
  }
  ImGui::End();
}

// In a corner: work in the picture goes on.
void showExporting(const PanelInput& in) {
  if (in.exportTitle.empty()) return;
  const Rect& picture = in.layout.picture;
  const float edge = 8 * in.scale;
  ImGui::SetNextWindowPos({picture.left + picture.width - edge, picture.top + picture.height - edge}, 0,
                          {1, 1});
  ImGui::SetNextWindowSize({std::min(280 * in.scale, picture.width - 2 * edge), 0});
  if (ImGui::Begin("##exporting", nullptr, kFixed | ImGuiWindowFlags_NoFocusOnAppearing)) {
    ImGui::TextWrapped("Writing %s", in.exportTitle.c_str());
    showProgressBar(in.exportShare > 0 ? in.exportShare : -1, in.scale);
    if (ImGui::Button("Cancel (Esc)")) in.state.wishCancelExport = true;
  }
  ImGui::End();
}

void showPanels(const PanelInput& in) {
  showCutOutline(in);
  showChosen(in);
  showHandles(in);
  showEditHandle(in);
  showNames(in);
  showLegend(in);
  showHeads(in);
  showEdit(in);
  showOutliner(in);
  if (in.state.panels) {
    showBar(in);
    showSide(in);
    place(in.layout.transport);
    if (ImGui::Begin("##transport", nullptr, kFixed | ImGuiWindowFlags_NoScrollbar)) showTransport(in);
    ImGui::End();
  }
  showExporting(in);
  showContextMenu(in);
  showHelp(in);
  showQuestion(in);
  showFailure(in);
  showFileChooser(in);
  showLoading(in);
}

}  // namespace vasa::viewer
