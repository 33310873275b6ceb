#include <imgui.h>

#include <algorithm>

#include "viewer/editor.h"
#include "viewer/file_chooser.h"
#include "viewer/flow.h"
#include "viewer/panels.h"
#include "viewer/projection.h"

// What edits the chosen vessel, over the picture; the handle that moves it; the question before quitting or
// opening something else; why something could not be opened.
namespace vasa::viewer {
namespace {

constexpr ImGuiWindowFlags kFixedTool = ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize |
                                        ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                                        ImGuiWindowFlags_AlwaysAutoResize;

void showTools(const PanelInput& in) {
  Editor& editor = *in.editor;
  ViewState& state = in.state;
  const Document& document = *in.document;
  const float words = ImGui::CalcTextSize("stenosis").x + ImGui::GetStyle().ItemInnerSpacing.x;
  ImGui::PushItemWidth(std::min(120 * in.scale, ImGui::GetContentRegionAvail().x - words));
  const auto stenosis = editor.stenosisThere(document, state);
  float percent = stenosis ? float(stenosis->percent) : 0;
  if (ImGui::SliderFloat("stenosis", &percent, 0, 95, "%.0f %%", ImGuiSliderFlags_AlwaysClamp) &&
      percent >= 1)
    editor.setStenosis(percent, document, state);
  const auto radius = editor.radiusThere(document, state);
  float factor = radius ? float(radius->factor) : 1;
  if (ImGui::SliderFloat("radius", &factor, 0.3f, 3, "x %.2f", ImGuiSliderFlags_AlwaysClamp))
    editor.setRadius(factor, document, state);
  ImGui::SliderFloat("length", &editor.lengthMm, 2, 100, "%.0f mm", ImGuiSliderFlags_AlwaysClamp);
  ImGui::PopItemWidth();
  const auto tool = [&](const char* name, EditTool which) {
    if (ImGui::RadioButton(name, state.editTool == which)) state.editTool = which;
  };
  tool("move", EditTool::change);
  sameLineWithRoom(checkboxWidth("branch"));
  tool("branch", EditTool::branch);
  sameLineWithRoom(checkboxWidth("graft"));
  tool("graft", EditTool::graft);
  sameLineWithRoom(buttonWidth("Delete"));
  if (ImGui::Button("Delete")) state.wishDelete = true;
  ImGui::TextDisabled("%s", state.editTool == EditTool::branch ? "click where the branch is to end"
                            : state.editTool == EditTool::graft
                                ? "click places that it passes, if any; then a vessel"
                                : "drag the ring to move the vessel");
}

// The latest lines, cut where the panel ends: wrapped they would cover the vessels. All of one under the
// pointer.
void showJournal(const PanelInput& in) {
  constexpr std::size_t kShown = 5;
  const auto& journal = in.state.journal;
  ImGui::PushTextWrapPos(-1);
  for (std::size_t i = journal.size() > kShown ? journal.size() - kShown : 0; i < journal.size(); ++i) {
    ImGui::TextDisabled("%zu  %s", i + 1, journal[i].c_str());
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", journal[i].c_str());
  }
  ImGui::PopTextWrapPos();
}

// Over a smaller picture than this they would lie on most of it, and on what is below.
bool isSmall(const PanelInput& in) {
  return in.layout.picture.width < 272 * in.scale || in.layout.picture.height < 300 * in.scale;
}

bool inPanel(const PanelInput& in) { return in.layout.panels.width > 0 && isSmall(in); }

bool anyEditing(const PanelInput& in) { return in.state.editing && in.document && in.editor; }

void tellRefusal(const PanelInput& in, const ImVec4& colour) {
  if (!in.editor->refusal.empty()) ImGui::TextColored(colour, "%s", in.editor->refusal.c_str());
}

void showContents(const PanelInput& in) {
  ImGui::PushTextWrapPos();
  if (in.state.selected) {
    ImGui::Text("%s at %.4g", in.document->scene.network.vessel(in.state.selected->vessel).name.c_str(),
                shareOf(in.document->scene.network, *in.state.selected));
    showTools(in);
  } else {
    ImGui::TextDisabled("Click a vessel to edit it.");
  }
  if (!isSmall(in)) tellRefusal(in, {0.98f, 0.62f, 0.35f, 1});
  showJournal(in);
  ImGui::PopTextWrapPos();
}

}  // namespace

void showEditSection(const PanelInput& in) {
  if (!anyEditing(in) || !inPanel(in)) return;
  int& lastShown = *ImGui::GetStateStorage()->GetIntRef(ImGui::GetID("edit, frame"), -1);
  if (lastShown != ImGui::GetFrameCount() - 1) ImGui::SetScrollY(0);  // it has just come
  lastShown = ImGui::GetFrameCount();
  if (ImGui::CollapsingHeader("Edit", ImGuiTreeNodeFlags_DefaultOpen)) showContents(in);
}

void showEdit(const PanelInput& in) {
  if (!anyEditing(in) || inPanel(in)) return;
  const float edge = 6 * in.scale;
  const Rect& picture = in.layout.picture;
  // The head: sliders must not move away under the pointer as lines are added.
  const float below = 84 * in.scale;
  const float width = std::min(316 * in.scale, picture.width - 2 * edge);
  ImGui::SetNextWindowPos({picture.left + edge, picture.top + below});
  ImGui::SetNextWindowSizeConstraints({width, 0}, {width, std::max(picture.height - below - edge, 1.0f)});
  if (ImGui::Begin("##edit", nullptr, kFixedTool)) showContents(in);
  ImGui::End();
}

void showRefusal(const PanelInput& in) {
  if (anyEditing(in) && isSmall(in)) tellRefusal(in, {0.85f, 0.15f, 0.12f, 1});
}

void showEditHandle(const PanelInput& in) {
  if (!in.state.editing || !in.document || !in.body || !in.editor || !in.state.selected) return;
  for (const vec3& passed : in.editor->passed(*in.document, *in.body, in.state))
    if (const auto at = seenAt(passed, in.camera, in.layout.picture); at && in.layout.picture.holds(*at)) {
      ImDrawList& list = *ImGui::GetBackgroundDrawList();
      list.AddCircleFilled({at->x, at->y}, 5 * in.scale, IM_COL32(30, 30, 34, 255));
      list.AddCircleFilled({at->x, at->y}, 3.5f * in.scale, IM_COL32(255, 190, 25, 255));
    }
  const auto place =
      seenAt(centreOf(*in.document, *in.body, *in.state.selected), in.camera, in.layout.picture);
  if (!place || !in.layout.picture.holds(*place)) return;
  const ImVec2 mouse = ImGui::GetIO().MousePos, at{place->x, place->y};
  const bool lit = in.editor->held() || (!ImGui::GetIO().WantCaptureMouse &&
                                         glm::distance(*place, vec2(mouse.x, mouse.y)) < 9 * in.scale);
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  list.AddCircle(at, 7 * in.scale, IM_COL32(30, 30, 34, 255), 0, 4 * in.scale);
  list.AddCircle(at, 7 * in.scale, lit ? IM_COL32(255, 190, 25, 255) : IM_COL32(255, 255, 255, 255), 0,
                 2 * in.scale);
}

void showQuestion(const PanelInput& in) {
  if (in.state.waiting == Waiting::nothing || in.files->isOpen()) return;
  const bool quits = in.state.waiting == Waiting::quit, cuts = quits && !in.exportTitle.empty();
  const bool unsaved = in.unsaved || !cuts;
  const Rect& picture = in.layout.picture;
  ImGui::SetNextWindowPos({picture.left + picture.width / 2, picture.top + picture.height / 2}, 0,
                          {0.5f, 0.5f});
  if (ImGui::Begin("##question", nullptr, kFixedTool)) {
    if (cuts) ImGui::Text("%s is still being written.", in.exportTitle.c_str());
    if (unsaved) {
      ImGui::TextUnformatted("Edits or the pose are not saved.");
      if (ImGui::Button(quits ? "Save and quit" : "Save and open"))
        in.state.wishSave = in.state.wishGoOn = true;
      ImGui::SameLine();
    }
    const char* const leave = !quits    ? "Open without saving"
                              : !cuts   ? "Quit without saving"
                              : unsaved ? "Quit without both"
                                        : "Quit without it";
    if (ImGui::Button(leave)) in.state.wishDiscard = true;
    ImGui::SameLine();
    if (ImGui::Button("Go on (Esc)")) in.state.wishStay = true;
  }
  ImGui::End();
}

void showFailure(const PanelInput& in) {
  if (in.state.failure.empty()) return;
  const ImVec2 window = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({window.x / 2, window.y / 2}, 0, {0.5f, 0.5f});
  ImGui::SetNextWindowSize({std::min(460 * in.scale, window.x - 24 * in.scale), 0});
  if (ImGui::Begin("##failure", nullptr, kFixedTool & ~ImGuiWindowFlags_AlwaysAutoResize)) {
    ImGui::TextUnformatted("That could not be done.");
    ImGui::TextWrapped("%s", in.state.failure.c_str());
    if (ImGui::Button("All right (Esc)")) in.state.failure.clear();
  }
  ImGui::End();
}

}  // namespace vasa::viewer
