#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>

#include "viewer/panels.h"

namespace vasa::viewer {
namespace {

void plot(const char* id, const History& history, const std::string& label, float height) {
  const auto value = [](void* data, int i) { return static_cast<const History*>(data)->at(std::size_t(i)); };
  float most = 1;
  for (std::size_t i = 0; i < history.count(); ++i) most = std::max(most, history.at(i));
  ImGui::PlotLines(id, value, const_cast<History*>(&history), int(history.count()), 0, label.c_str(), 0,
                   1.15f * most, {-1, height});
}

void showTable(const Profiler& profiler) {
  if (profiler.rows().empty() || !ImGui::BeginTable("##table3", 5, ImGuiTableFlags_RowBg)) return;
  for (const char* head : {"quads", "FPS", "frame", "draw", "static"}) ImGui::TableSetupColumn(head);
  ImGui::TableHeadersRow();
  for (const ProfileRow& row : profiler.rows()) {
    const auto value = [&](const char* name) {
      const auto found = std::ranges::find(row.stages, name, &std::pair<std::string, double>::first);
      ImGui::TableNextColumn();
      ImGui::Text("%.1f", found == row.stages.end() ? 0 : found->second);
    };
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(row.name().c_str());
    ImGui::TableNextColumn();
    ImGui::Text("%.1f", row.fps());
    for (const char* name : {"frame_ms", "draw_ms", "static_draw_ms"}) value(name);
  }
  ImGui::EndTable();
}

void showProfile(const PanelInput& in) {
  const bool running = in.profiler && in.profiler->done() < in.profiler->total();
  if (ImGui::Button(running ? "Stop" : "Profile")) in.state.wishProfile = true;
  if (ImGui::IsItemHovered())
    ImGui::SetTooltip("As vasa profile: vessels alone, 1280 x 720, at several quads (F9)");
  if (running) {
    ImGui::SameLine();
    ImGui::TextDisabled("row %zu of %zu", in.profiler->done() + 1, in.profiler->total());
  }
  if (in.profiler) showTable(*in.profiler);
}

}  // namespace

void showTimingSection(const PanelInput& in) {
  in.state.timing = ImGui::CollapsingHeader("Timing");
  if (!in.state.timing) return;
  const Timings& timings = in.timings;
  const float shown = timings.shown().median();
  plot("##shown", timings.shown(),
       shown > 0 ? fmt::format("{:.1f} ms between pictures, {:.0f} FPS", shown, 1000 / shown) : "",
       54 * in.scale);
  if (ImGui::BeginTable("##stages", 2, ImGuiTableFlags_RowBg)) {
    const auto row = [](const std::string& name, float ms) {
      ImGui::TableNextColumn();
      ImGui::TextUnformatted(name.c_str());
      ImGui::TableNextColumn();
      ImGui::Text("%8.2f", ms);
    };
    for (const Timings::Stage& stage : timings.stages()) row(stage.name, stage.history.median());
    row("shape, all", timings.shape().median());
    row("picture, all", timings.picture().median());
    ImGui::EndTable();
  }
  ImGui::TextDisabled("medians [ms]; shapes and pictures go on\nat the same time");
  showProfile(in);
}

}  // namespace vasa::viewer
