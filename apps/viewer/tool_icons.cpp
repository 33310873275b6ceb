#include "viewer/tool_icons.h"

#include <imgui.h>

#include <sstream>

namespace vasa::viewer {

void drawIcon(ImDrawList& list, const char* sign, vec2 corner, float size, std::uint32_t colour) {
  const float unit = size / 16, thick = 1.4f * unit;
  std::istringstream words(sign);
  const auto point = [&] {
    float x = 0, y = 0;
    words >> x >> y;
    return ImVec2{corner.x + x * unit, corner.y + y * unit};
  };
  const auto stroke = [&](bool closed) { list.PathStroke(colour, closed ? ImDrawFlags_Closed : 0, thick); };
  for (char what = 0; words >> what;) {
    if (what == 'M') stroke(false);  // the line before, if any
    if (what == 'M' || what == 'L') list.PathLineTo(point());
    if (what == 'Z') stroke(true);
    if (what != 'O' && what != 'D') continue;
    stroke(false);
    const ImVec2 centre = point();
    float radius = 0;
    words >> radius;
    if (what == 'D')
      list.AddCircleFilled(centre, radius * unit, colour);
    else
      list.AddCircle(centre, radius * unit, colour, 0, thick);
  }
  stroke(false);
}

}  // namespace vasa::viewer
