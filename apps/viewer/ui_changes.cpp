#include "viewer/ui_changes.h"

#include <imgui.h>

#include <algorithm>
#include <limits>
#include <span>

namespace vasa::viewer {
namespace {

bool overlap(const Rect& a, const Rect& b) {
  return a.left < b.left + b.width && b.left < a.left + a.width && a.top < b.top + b.height &&
         b.top < a.top + a.height;
}

template <class T>
void append(std::vector<unsigned char>& bytes, const ImVector<T>& values) {
  const auto* first = reinterpret_cast<const unsigned char*>(values.Data);
  bytes.insert(bytes.end(), first, first + std::size_t(values.size_in_bytes()));
}

// Of what is drawn of it: its corners, cut off as its commands say.
Rect boxOf(const ImDrawList& list) {
  constexpr float most = std::numeric_limits<float>::max();
  vec2 low(most), high(-most), cutLow(most), cutHigh(-most);
  for (const ImDrawVert& corner : list.VtxBuffer) {
    low = glm::min(low, vec2(corner.pos.x, corner.pos.y));
    high = glm::max(high, vec2(corner.pos.x, corner.pos.y));
  }
  for (const ImDrawCmd& command : list.CmdBuffer) {
    cutLow = glm::min(cutLow, vec2(command.ClipRect.x, command.ClipRect.y));
    cutHigh = glm::max(cutHigh, vec2(command.ClipRect.z, command.ClipRect.w));
  }
  low = glm::max(low, cutLow);
  const vec2 size = glm::max(glm::min(high, cutHigh) - low, vec2(0));
  return {low.x, low.y, size.x, size.y};
}

}  // namespace

UiChanges::Drawn UiChanges::drawnAs(const ImDrawList& list) {
  Drawn drawn{boxOf(list), {}};
  append(drawn.bytes, list.VtxBuffer);
  append(drawn.bytes, list.IdxBuffer);
  append(drawn.bytes, list.CmdBuffer);
  return drawn;
}

void UiChanges::keepChanged(ImDrawData& panels, const Rect& overwritten) {
  const std::span lists(panels.CmdLists, std::size_t(panels.CmdListsCount));
  std::vector<Drawn> now;
  for (const ImDrawList* list : lists) now.push_back(drawnAs(*list));
  const std::size_t count = now.size();
  // Where windows come, go, move or change places, what lay below them shows.
  const bool sameBoxes = std::ranges::equal(now, drawn_, {}, &Drawn::box, &Drawn::box);
  std::vector<bool> changed(count, !sameBoxes);
  for (std::size_t i = 0; i < count; ++i)
    changed[i] = changed[i] || overlap(now[i].box, overwritten) || now[i].bytes != drawn_[i].bytes;
  for (bool more = true; more;) {
    more = false;
    for (std::size_t i = 0; i < count; ++i)
      for (std::size_t j = 0; j < count; ++j)
        if (changed[i] && !changed[j] && overlap(now[i].box, now[j].box)) changed[j] = more = true;
  }
  kept_.clear();
  panels.TotalVtxCount = panels.TotalIdxCount = 0;
  for (std::size_t i = 0; i < count; ++i) {
    if (!changed[i]) continue;
    kept_.push_back(lists[i]);
    panels.TotalVtxCount += lists[i]->VtxBuffer.Size;
    panels.TotalIdxCount += lists[i]->IdxBuffer.Size;
  }
  panels.CmdLists = kept_.data();
  panels.CmdListsCount = int(kept_.size());
  drawn_ = std::move(now);
}

}  // namespace vasa::viewer
