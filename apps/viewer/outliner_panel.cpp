#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>

#include "curve/bspline.h"
#include "viewer/flow.h"
#include "viewer/label.h"
#include "viewer/panels.h"
#include "viewer/projection.h"

// The list of all vessels, left of the picture; what is pointed at and what is chosen by name; the legend.
namespace vasa::viewer {
namespace {

// An eye: open, half shut or shut. @return whether it was clicked
bool showEye(RowSight sight, float size) {
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const bool clicked = ImGui::InvisibleButton("eye", {1.4f * size, size});
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ImVec2 middle{at.x + 0.7f * size, at.y + 0.5f * size};
  const bool bright = ImGui::IsItemHovered();
  const ImU32 colour =
      ImGui::GetColorU32(bright || sight == RowSight::shown ? ImGuiCol_Text : ImGuiCol_TextDisabled);
  if (sight == RowSight::hidden) {
    list.AddLine({middle.x - 0.45f * size, middle.y}, {middle.x + 0.45f * size, middle.y}, colour, 1.5f);
  } else {
    const float half = 0.45f * size, high = 0.34f * size;
    for (const float side : {-1.0f, 1.0f})
      list.AddBezierCubic({middle.x - half, middle.y}, {middle.x - 0.2f * size, middle.y + side * high},
                          {middle.x + 0.2f * size, middle.y + side * high}, {middle.x + half, middle.y},
                          colour, 1.3f);
    if (sight == RowSight::shown) list.AddCircleFilled(middle, 0.14f * size, colour);
  }
  if (bright) ImGui::SetTooltip(sight == RowSight::hidden ? "Show" : "Hide");
  return clicked;
}

void toggle(std::set<std::uint32_t>& keys, std::uint32_t key) {
  if (!keys.insert(key).second) keys.erase(key);
}

void clickRow(const PanelInput& in, std::span<const OutlinerRow> rows, std::size_t r) {
  const OutlinerRow& row = rows[r];
  if (!row.vessel.valid()) return toggle(in.state.outliner.unfolded, row.key);
  chooseRow(in.state, rows, r, ImGui::GetIO().KeyCtrl, ImGui::GetIO().KeyShift);
  in.state.outliner.scroll = false;  // it is where the pointer is
  if (ImGui::IsMouseDoubleClicked(0)) in.state.wishFocus = true;
}

void showRow(const PanelInput& in, std::span<const OutlinerRow> rows, std::size_t r,
             const std::vector<VesselId>& chosen) {
  const OutlinerRow& row = rows[r];
  const Network& network = in.document->scene.network;
  const RowSight sight = sightOf(row, network, in.state.hidden);
  const float line = ImGui::GetTextLineHeight(), width = ImGui::GetContentRegionAvail().x;
  ImGui::PushID(int(r));
  if (showEye(sight, line)) in.state.hidden.set(network, row.vessels, sight != RowSight::hidden);
  ImGui::SameLine(0, 0);
  const float indent = float(row.depth) * 0.9f * line;
  ImGui::SetCursorPosX(ImGui::GetCursorPosX() + indent);
  std::string text = row.name;
  if (!row.vessel.valid()) text = (row.unfolded ? "- " : "+ ") + text;
  const bool lit = row.vessel.valid() && std::ranges::find(chosen, row.vessel) != chosen.end();
  if (sight == RowSight::hidden)
    ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled));
  if (ImGui::Selectable(text.c_str(), lit,
                        ImGuiSelectableFlags_AllowDoubleClick | ImGuiSelectableFlags_AllowItemOverlap,
                        {width - indent - 1.4f * line, 0}))
    clickRow(in, rows, r);
  if (row.vessel.valid() && ImGui::IsItemHovered() &&
      ImGui::CalcTextSize(text.c_str()).x > width - indent - 1.4f * line)
    ImGui::SetTooltip("%s", text.c_str());  // its end is cut off
  if (sight == RowSight::hidden) ImGui::PopStyleColor();
  if (!row.vessel.valid()) {
    const std::string count = std::to_string(row.vessels.size());
    ImGui::SameLine(ImGui::GetContentRegionMax().x - ImGui::CalcTextSize(count.c_str()).x);
    ImGui::TextDisabled("%s", count.c_str());
  }
  if (lit && in.state.outliner.scroll && in.state.selected && row.vessel == in.state.selected->vessel) {
    ImGui::SetScrollHereY(0.5f);
    in.state.outliner.scroll = false;
  }
  ImGui::PopID();
}

void takeKeys(const PanelInput& in, std::span<const OutlinerRow> rows) {
  const auto pressed = [](ImGuiKey key) { return ImGui::IsKeyPressed(ImGui::GetKeyIndex(key)); };
  const bool shift = ImGui::GetIO().KeyShift;
  if (pressed(ImGuiKey_DownArrow)) stepChoice(in.state, rows, 1, shift);
  if (pressed(ImGuiKey_UpArrow)) stepChoice(in.state, rows, -1, shift);
}

void showButtons(const PanelInput& in) {
  const Network& network = in.document->scene.network;
  const std::vector<VesselId> chosen = chosenVessels(in.state);
  const auto button = [](const char* name, const char* keys) {
    const bool pressed = ImGui::Button(name);
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", keys);
    return pressed;
  };
  if (button("Hide", "What is chosen (H)")) in.state.hidden.set(network, chosen, true);
  sameLineWithRoom(buttonWidth("Only"));
  if (button("Only", "What is chosen (Shift H)") && !chosen.empty())
    in.state.hidden.setAllBut(network, chosen);
  sameLineWithRoom(buttonWidth("All"));
  if (button("All", "Show all (Ctrl H)")) in.state.hidden.clear();
  const std::string count = std::to_string(chosen.size()) + " chosen";
  sameLineWithRoom(ImGui::CalcTextSize(count.c_str()).x);
  ImGui::TextDisabled("%s", count.c_str());
}

}  // namespace

void showOutliner(const PanelInput& in) {
  OutlinerState& list = in.state.outliner;
  list.focused = false;
  if (!list.on || !in.document || in.layout.outliner.width <= 0) return;
  const Rect& rect = in.layout.outliner;
  ImGui::SetNextWindowPos({rect.left, rect.top});
  ImGui::SetNextWindowSize({rect.width, rect.height});
  constexpr ImGuiWindowFlags kFixedList = ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize |
                                          ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                                          ImGuiWindowFlags_NoCollapse;
  if (ImGui::Begin("##outliner", nullptr, kFixedList)) {
    list.focused = ImGui::IsWindowFocused(ImGuiFocusedFlags_RootAndChildWindows);
    ImGui::SetNextItemWidth(-1);
    const bool entered = ImGui::InputTextWithHint("##find", "Find vessels: femrl art", &in.state.search,
                                                  ImGuiInputTextFlags_EnterReturnsTrue);
    showButtons(in);
    const auto rows = outlinerRows(in.document->scene.network, *in.document->groups, list, in.state.search);
    if (entered && !rows.empty() && rows.front().vessel.valid()) {
      chooseRow(in.state, rows, 0, false, false);
      in.state.wishFocus = true;
    }
    if (list.focused) takeKeys(in, rows);
    const std::vector<VesselId> chosen = chosenVessels(in.state);
    if (ImGui::BeginChild("##rows")) {
      if (rows.empty()) ImGui::TextDisabled("No vessel answers to that.");
      for (std::size_t r = 0; r < rows.size(); ++r) showRow(in, rows, r, chosen);
    }
    ImGui::EndChild();
  }
  ImGui::End();
}

// The name of what lies under a resting pointer, and at the middle of what is chosen.
void showNames(const PanelInput& in) {
  if (!in.document || !in.body) return;
  const Network& network = in.document->scene.network;
  const auto nameOf = [&](VesselId vessel) { return network.vessel(vessel).name; };
  constexpr std::size_t kMostLabels = 12;  // more would hide what they name
  const std::vector<VesselId> chosen = chosenVessels(in.state);
  std::vector<VesselId> named(chosen.begin(),
                              chosen.begin() + std::ptrdiff_t(std::min(chosen.size(), kMostLabels)));
  if (in.state.labelled.any())
    for (std::uint32_t v = 0; v < network.vessels().size(); ++v)
      if (in.state.labelled.has(network.vessels()[v].name) &&
          !in.state.hidden.has(network.vessels()[v].name) &&
          std::ranges::find(named, VesselId{v}) == named.end())
        named.push_back({v});
  std::vector<std::pair<vec2, const std::string*>> places;
  for (const VesselId id : named) {
    const Vessel& vessel = network.vessel(id);
    const vec3 middle(evaluate(Network::pointsOf(vessel, in.body->points), 0.5f * float(vessel.spanCount())));
    const auto place = seenAt(middle, in.camera, in.layout.picture);
    if (place && in.layout.picture.holds(*place)) places.emplace_back(*place, &vessel.name);
  }
  // From top to bottom, so that each can give way to those above it.
  std::ranges::sort(places, {}, [](const auto& label) { return label.first.y; });
  float free = 0;
  for (auto& [place, name] : places) {
    place.y = std::max(place.y, free);
    free = place.y + 1.4f * ImGui::GetTextLineHeight();
    drawLabel(place, *name, 10 * in.scale, in.layout.picture, in.scale);
  }
  if (!in.state.pointedAt || ImGui::GetIO().WantCaptureMouse) return;
  const VesselId under = in.state.pointedAt->vessel;
  if (std::ranges::find(named, under) != named.end()) return;
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  drawLabel({mouse.x, mouse.y}, nameOf(under), 14 * in.scale, in.layout.picture, in.scale);
}

void showLegend(const PanelInput& in) {
  if (!in.document || !in.state.legend || in.state.contacts) return;
  const atlas::ColourLegend legend =
      atlas::legendOf(in.document->scene.network, *in.document->groups, in.state.colouring);
  const std::vector<atlas::ColourKey>& entries = legend.keys;
  if (entries.empty()) return;
  const bool scale = !legend.ramp.empty();
  const Rect& picture = in.layout.picture;
  const float edge = 8 * in.scale, line = ImGui::GetTextLineHeightWithSpacing(),
              box = 0.8f * ImGui::GetTextLineHeight();
  float widest = 0;
  for (const atlas::ColourKey& entry : entries)
    widest = std::max(widest, ImGui::CalcTextSize(entry.text.c_str()).x);
  const char* title = legend.title.c_str();
  const float head = *title ? line : 0;
  widest = std::max(widest, *title ? ImGui::CalcTextSize(title).x - 1.6f * box : 0);
  const float high = head + line * float(entries.size());
  const vec2 low{picture.left + edge, picture.top + picture.height - edge - high};
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  const vec4 page = in.state.look.background;
  const bool light = page.x > 0.5f;
  const ImU32 ink = light ? IM_COL32(38, 38, 43, 255) : IM_COL32(217, 219, 224, 255);
  list.AddRectFilled({low.x - edge / 2, low.y - edge / 2},
                     {low.x + 1.6f * box + widest + edge / 2, low.y + high},
                     ImGui::ColorConvertFloat4ToU32({page.x, page.y, page.z, 0.82f}), edge / 2);
  if (*title) list.AddText({low.x, low.y}, ink, title);
  const auto colourOfEntry = [](const atlas::ColourKey& entry) {
    return ImGui::ColorConvertFloat4ToU32({entry.colour.x, entry.colour.y, entry.colour.z, 1});
  };
  for (std::size_t e = 0; e < entries.size(); ++e) {
    // Of a scale the largest stands on top.
    const atlas::ColourKey& entry = scale ? entries[entries.size() - 1 - e] : entries[e];
    const float top = low.y + head + line * float(e);
    const bool runsOn = scale && e + 1 < entries.size();
    const ImU32 own = colourOfEntry(entry);
    if (runsOn) {
      const ImU32 next = colourOfEntry(entries[entries.size() - 2 - e]);
      list.AddRectFilledMultiColor({low.x, top + line / 2}, {low.x + box, top + 1.5f * line}, own, own, next,
                                   next);
    } else if (!scale) {
      list.AddRectFilled({low.x, top + (line - box) / 2}, {low.x + box, top + (line + box) / 2}, own,
                         2 * in.scale);
    }
    list.AddText({low.x + 1.6f * box, top + (line - ImGui::GetTextLineHeight()) / 2}, ink,
                 entry.text.c_str());
  }
}

}  // namespace vasa::viewer
