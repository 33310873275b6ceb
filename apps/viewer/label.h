#pragma once
#include <string>

#include "viewer/layout.h"

namespace vasa::viewer {

/// A name on a dark plate over the picture, right of a place [pixels], left of it where the picture ends too
/// soon. Between UiContext::begin() and end() only.
/// @param gap  [pixels] from the place to the plate
void drawLabel(vec2 place, const std::string& text, float gap, const Rect& picture, float scale);

}  // namespace vasa::viewer
