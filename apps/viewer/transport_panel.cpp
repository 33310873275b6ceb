#include <fmt/format.h>
#include <imgui.h>

#include <string_view>

#include "viewer/panels.h"

namespace vasa::viewer {
namespace {

void tellCleared(const Document& document, std::string_view clip) {
  std::string text;
  for (const ClearedArm& arm : document.clearedArms)
    if (arm.clip == clip) text += describeArm(arm) + "\n";
  if (text.empty()) return;
  text.pop_back();
  ImGui::SetTooltip("%s", text.c_str());
}

void chooseClip(const PanelInput& in, const std::vector<Clip>& clips) {
  Playback& playback = in.state.playback;
  const char* shown = playback.clip >= 0 ? clips[std::size_t(playback.clip)].name.c_str() : "at rest";
  ImGui::SetNextItemWidth(120 * in.scale);
  const bool open = ImGui::BeginCombo("##clip", shown);
  if (!open && ImGui::IsItemHovered()) tellCleared(*in.document, shown);
  if (!open) return;
  for (int i = -1; i < int(clips.size()); ++i) {
    const bool chosen = i == playback.clip;
    if (ImGui::Selectable(i < 0 ? "at rest" : clips[std::size_t(i)].name.c_str(), chosen)) {
      playback.clip = i;
      playback.time = i < 0 ? 0 : clips[std::size_t(i)].start;
    }
    if (chosen) ImGui::SetItemDefaultFocus();
  }
  ImGui::EndCombo();
}

}  // namespace

void showTransport(const PanelInput& in) {
  if (!in.document) return;
  Playback& playback = in.state.playback;
  const std::vector<Clip>& clips = in.document->scene.body.clips;
  chooseClip(in, clips);
  if (playback.clip < 0) return;
  const Clip& clip = clips[std::size_t(playback.clip)];
  ImGui::SameLine();
  if (ImGui::Button(playback.playing ? "Pause" : "Play", {64 * in.scale, 0}))
    playback.playing = !playback.playing;
  ImGui::SameLine();
  const std::string frame = fmt::format("{} / {}", playback.frame(clip), clip.frameCount() - 1);
  const float rest = 230 * in.scale;
  ImGui::SetNextItemWidth(std::max(ImGui::GetContentRegionAvail().x - rest, 60 * in.scale));
  if (ImGui::SliderFloat("##time", &playback.time, clip.start, clip.end, frame.c_str(),
                         ImGuiSliderFlags_AlwaysClamp))
    playback.playing = false;
  ImGui::SameLine();
  ImGui::SetNextItemWidth(90 * in.scale);
  ImGui::SliderFloat("##speed", &playback.speed, -2, 2, "%.2f x");
  if (ImGui::IsItemClicked(ImGuiMouseButton_Right)) playback.speed = 1;
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("Speed; right click: 1");
  ImGui::SameLine();
  ImGui::Checkbox("Loop", &playback.loop);
}

}  // namespace vasa::viewer
