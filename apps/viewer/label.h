#pragma once
#include <string>

#include "math/types.h"

namespace vasa::viewer {

/// A name on a dark plate over the picture, right of a place [pixels]. Between UiContext::begin() and end()
/// only.
/// @param gap  [pixels] from the place to the plate
void drawLabel(vec2 place, const std::string& text, float gap, float scale);

}  // namespace vasa::viewer
