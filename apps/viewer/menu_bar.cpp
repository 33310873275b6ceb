#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>

#include "viewer/actions.h"
#include "viewer/panels.h"
#include "viewer/tool_icons.h"

// Menus and tools above the picture. What they hold is told by the actions.
namespace vasa::viewer {
namespace {

void showRecent(const PanelInput& in) {
  if (!ImGui::BeginMenu("Open recent", !in.state.recent.empty())) return;
  for (const std::string& file : in.state.recent) {
    const std::string name = std::filesystem::path(file).filename().string() + "###" + file;
    if (ImGui::MenuItem(name.c_str())) in.state.wishFiles = {file};
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", file.c_str());
  }
  ImGui::EndMenu();
}

// One entry a digit.
void showNumbers(const PanelInput& in, const Action& action) {
  if (!ImGui::BeginMenu(action.name, canDo(action, in.state, in.document))) return;
  for (int digit = 1; digit <= 9; ++digit) {
    Chord chord = action.chords[0];
    chord.key = keyOf(char('0' + digit));
    const bool kept =
        std::ranges::find(in.state.views, unsigned(digit), &ViewChoice::number) != in.state.views.end();
    const std::string name = fmt::format("View {}", digit);
    if (ImGui::MenuItem(name.c_str(), chordText(chord).c_str(), kept, kept || action.id == ActionId::keep))
      action.act(in.state, in.document, digit);
  }
  ImGui::EndMenu();
}

void showMenu(const PanelInput& in, MenuId menu) {
  for (const Action& action : actions()) {
    if (action.menu != menu) continue;
    if (action.first) ImGui::Separator();
    if (action.id == ActionId::colour) showColourings(in);
    if (action.chords[0].key == kAnyDigit)
      showNumbers(in, action);
    else
      showActionItem(in, action.id);
    if (action.id == ActionId::open) showRecent(in);
  }
}

struct Tool {
  ActionId id;
  const char* sign;
  bool first = false;  // of a group
};
constexpr Tool kTools[] = {
    {ActionId::open, "M 2 13 L 2 3 L 6 3 L 8 5 L 14 5 L 14 13 Z M 2 8 L 14 8"},
    {ActionId::save,
     "M 3 2 L 11 2 L 14 5 L 14 14 L 2 14 L 2 2 Z M 5 2 L 5 6 L 10 6 L 10 2 M 4 14 L 4 9 L 12 9 L 12 14"},
    {ActionId::undo, "M 6 2 L 2 6 L 6 10 M 2 6 L 10 6 L 13 8 L 14 11 L 13 14", true},
    {ActionId::redo, "M 10 2 L 14 6 L 10 10 M 14 6 L 6 6 L 3 8 L 2 11 L 3 14"},
    {ActionId::home, "M 2 8 L 8 2 L 14 8 M 4 7 L 4 14 L 12 14 L 12 7 M 7 14 L 7 10 L 9 10 L 9 14", true},
    {ActionId::outliner, "D 3 4 1 M 6 4 L 14 4 D 3 8 1 M 6 8 L 14 8 D 3 12 1 M 6 12 L 14 12"},
    {ActionId::cut, "M 2 11 L 8 14 L 14 11 L 8 8 Z M 8 8 L 8 2 M 6 4 L 8 2 L 10 4"},
    {ActionId::pose, "O 8 3 2 M 8 5 L 8 10 M 3 7 L 13 7 M 8 10 L 4 15 M 8 10 L 12 15", true},
    {ActionId::edit, "M 2 14 L 3 10 L 11 2 L 14 5 L 6 13 Z M 9 4 L 12 7"},
    {ActionId::measure, "M 2 11 L 11 2 L 14 5 L 5 14 Z M 5 8 L 6 9 M 7 6 L 9 8 M 9 4 L 10 5"},
    {ActionId::picture, "M 2 5 L 5 5 L 6 3 L 10 3 L 11 5 L 14 5 L 14 13 L 2 13 Z O 8 9 3", true},
    {ActionId::record, "O 8 8 6 D 8 8 3"},
};

// @return where the next one begins
float showTool(const PanelInput& in, const Tool& tool, float left, float side) {
  const Action& action = actionOf(tool.id);
  const bool able = canDo(action, in.state, in.document), on = action.on && action.on(in.state);
  const Rect& bar = in.layout.bar;
  ImGui::SetCursorScreenPos({left, bar.top + (bar.height - side) / 2});
  ImGui::PushID(int(tool.id));
  if (ImGui::InvisibleButton("tool", {side, side}) && able) perform(tool.id, in.state, in.document);
  const bool under = ImGui::IsItemHovered();
  const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const float edge = ImGui::GetStyle().FrameRounding, inset = 0.16f * side;
  if (on || (under && able))
    list.AddRectFilled(low, high, ImGui::GetColorU32(on ? ImGuiCol_ButtonActive : ImGuiCol_ButtonHovered),
                       edge);
  drawIcon(list, tool.sign, {low.x + inset, low.y + inset}, side - 2 * inset,
           able ? ImGui::GetColorU32(ImGuiCol_Text) : ImGui::GetColorU32(ImGuiCol_TextDisabled, 0.6f));
  if (under) {
    const std::string title = titleOf(action, in.state), plain = action.name;
    ImGui::SetTooltip(
        "%s", title == plain ? tipOf(action).c_str() : fmt::format("{} ({})", title, keysOf(action)).c_str());
  }
  ImGui::PopID();
  return left + side;
}

// As many as there is room for: what they do is in the menus, too.
void showTools(const PanelInput& in, float left, float right) {
  const float side = 24 * in.scale, gap = 10 * in.scale;
  for (const Tool& tool : kTools) {
    if (tool.first) left += gap;
    if (left + side > right) return;
    left = showTool(in, tool, left, side);
  }
}

}  // namespace

void showActionItem(const PanelInput& in, ActionId id) {
  const Action& action = actionOf(id);
  const std::string title = titleOf(action, in.state) + "###" + action.name;
  if (ImGui::MenuItem(title.c_str(), keysOf(action).c_str(), action.on && action.on(in.state),
                      canDo(action, in.state, in.document)))
    perform(id, in.state, in.document);
  if (ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) ImGui::SetTooltip("%s", action.what);
}

void showColourings(const PanelInput& in) {
  if (!ImGui::BeginMenu("Colour by")) return;
  for (std::size_t c = 0; c < atlas::kColourings.size(); ++c)
    if (ImGui::MenuItem(atlas::kColourings[c], nullptr, in.state.colouring == atlas::Colouring(c)))
      setColouring(in.state, atlas::Colouring(c));
  ImGui::EndMenu();
}

void showBar(const PanelInput& in) {
  const Rect& bar = in.layout.bar;
  ImGui::SetNextWindowPos({bar.left, bar.top});
  ImGui::SetNextWindowSize({bar.width, bar.height});
  const ImGuiStyle& style = ImGui::GetStyle();
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding,
                      {style.FramePadding.x, (bar.height - ImGui::GetFontSize()) / 2});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {style.WindowPadding.x, 0});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, {1, 1});
  constexpr ImGuiWindowFlags kBar = ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize |
                                    ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                                    ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse |
                                    ImGuiWindowFlags_MenuBar;
  const bool open = ImGui::Begin("##bar", nullptr, kBar);
  const bool bars = open && ImGui::BeginMenuBar();  // whose words stand in its middle
  ImGui::PopStyleVar(3);
  if (bars) {
    for (std::size_t menu = 0; menu < kMenuNames.size(); ++menu) {
      if (in.state.menu == int(menu)) ImGui::OpenPopup(kMenuNames[menu]);
      if (ImGui::BeginMenu(kMenuNames[menu])) {
        showMenu(in, MenuId(menu));
        ImGui::EndMenu();
      }
    }
    in.state.menu = -1;
    const float left = ImGui::GetCursorScreenPos().x + 8 * in.scale;
    float right = bar.left + bar.width - style.WindowPadding.x;
    if (in.framesPerSecond > 0) {
      const std::string text = fmt::format("{:.0f} FPS", in.framesPerSecond);
      right -= ImGui::CalcTextSize(text.c_str()).x;
      ImGui::SetCursorScreenPos({right, bar.top});  // texts stand in its middle by themselves
      ImGui::TextDisabled("%s", text.c_str());
      if (ImGui::IsItemHovered()) ImGui::SetTooltip("Pictures a second while something moves");
    }
    showTools(in, left, right - 8 * in.scale);
    ImGui::EndMenuBar();
  }
  ImGui::End();
}

}  // namespace vasa::viewer
