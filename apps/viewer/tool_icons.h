#pragma once
#include <cstdint>

#include "math/types.h"

struct ImDrawList;

namespace vasa::viewer {

/// Draws a small sign of lines. Its text holds points on a grid of 16 by 16: "M x y" begins a line, "L x y"
/// goes on with it, "Z" closes it, "O x y r" is a circle, "D x y r" a disc; numbers are whole.
/// @param corner, size  [pixels] of the square it stands in
void drawIcon(ImDrawList& list, const char* sign, vec2 corner, float size, std::uint32_t colour);

}  // namespace vasa::viewer
