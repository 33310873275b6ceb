#include "viewer/label.h"

#include <imgui.h>

#include <algorithm>

namespace vasa::viewer {

void drawLabel(vec2 place, const std::string& text, float gap, const Rect& picture, float scale) {
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  const ImVec2 size = ImGui::CalcTextSize(text.c_str());
  const float edge = 4 * scale;
  const bool fits = place.x + gap + 2 * edge + size.x <= picture.left + picture.width;
  // Left of the place where there is no room right of it, but within the picture.
  const float left = fits ? place.x + gap + edge : place.x - gap - edge - size.x;
  const ImVec2 low{std::max(left, picture.left + edge), place.y - size.y / 2};
  list.AddRectFilled({low.x - edge, low.y - edge / 2}, {low.x + size.x + edge, low.y + size.y + edge / 2},
                     IM_COL32(30, 30, 34, 220), edge);
  list.AddText(low, IM_COL32(235, 236, 238, 255), text.c_str());
}

}  // namespace vasa::viewer
