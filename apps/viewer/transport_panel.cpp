#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <string_view>

#include "viewer/flow.h"
#include "viewer/panels.h"

namespace vasa::viewer {
namespace {

void tellCleared(const Document& document, std::string_view clip) {
  std::string text;
  for (const ClearedLimb& limb : document.clearedLimbs)
    if (limb.clip == clip) text += describeLimb(limb) + "\n";
  if (text.empty()) return;
  text.pop_back();
  ImGui::SetTooltip("%s", text.c_str());
}

// [pixels] of what stands in the line; the time's slider has what is left. In a narrow window they shrink, a
// word goes, and at last what it belongs to.
struct Widths {
  float clip, play, speed, loop;
  bool word = true;  // "Loop"
  explicit Widths(float scale) {
    const float all = ImGui::GetContentRegionAvail().x, gap = ImGui::GetStyle().ItemSpacing.x;
    const float least = 60 * scale;  // of the slider
    clip = std::clamp(0.25f * all, 90 * scale, 120 * scale);
    play = std::min(64 * scale, 0.2f * all);
    speed = std::clamp(0.18f * all, 60 * scale, 90 * scale);
    loop = checkboxWidth("Loop");
    const auto slider = [&] { return all - clip - play - speed - loop - 4 * gap; };
    if (slider() < least) word = false, loop = ImGui::GetFrameHeight();
    if (slider() < least) speed = 0;
    if (slider() < least) loop = 0;
  }
};

void chooseClip(const PanelInput& in, const std::vector<Clip>& clips, float width) {
  Playback& playback = in.state.playback;
  const char* shown = playback.clip >= 0 ? clips[std::size_t(playback.clip)].name.c_str() : "at rest";
  ImGui::SetNextItemWidth(width);
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
  const Widths widths(in.scale);
  chooseClip(in, clips, widths.clip);
  if (playback.clip < 0) return;
  const Clip& clip = clips[std::size_t(playback.clip)];
  ImGui::SameLine();
  if (ImGui::Button(playback.playing ? "Pause" : "Play", {widths.play, 0}))
    playback.playing = !playback.playing;
  ImGui::SameLine();
  const std::string frame = fmt::format("{} / {}", playback.frame(clip), clip.frameCount() - 1);
  const float gap = ImGui::GetStyle().ItemSpacing.x;
  const float after = (widths.speed > 0 ? widths.speed + gap : 0) + (widths.loop > 0 ? widths.loop + gap : 0);
  ImGui::SetNextItemWidth(std::max(ImGui::GetContentRegionAvail().x - after, 40 * in.scale));
  if (ImGui::SliderFloat("##time", &playback.time, clip.start, clip.end, frame.c_str(),
                         ImGuiSliderFlags_AlwaysClamp))
    playback.playing = false;
  if (widths.speed > 0) {
    ImGui::SameLine();
    ImGui::SetNextItemWidth(widths.speed);
    ImGui::SliderFloat("##speed", &playback.speed, -2, 2, "%.2f x");
    if (ImGui::IsItemClicked(ImGuiMouseButton_Right)) playback.speed = 1;
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("Speed; right click: 1");
  }
  if (widths.loop == 0) return;
  ImGui::SameLine();
  ImGui::Checkbox(widths.word ? "Loop" : "##loop", &playback.loop);
  if (!widths.word && ImGui::IsItemHovered()) ImGui::SetTooltip("Loop");
}

}  // namespace vasa::viewer
