#pragma once
#include <span>
#include <vector>

#include "math/types.h"

namespace vasa::plate {

/// A text that wants to stand beside a figure, with a line to one of the places it may point at. All lengths
/// here are of one unit, y runs down.
struct LabelWish {
  vec2 size{0};               ///< of the text
  std::vector<vec2> anchors;  ///< at least one, the best first
};

/// Two columns of text, left and right of a figure.
struct LabelColumns {
  float left = 0, right = 0;  ///< x at which leader lines leave the texts; left < right
  float top = 0, bottom = 0;  ///< of both columns
  float gap = 0;              ///< between texts, at least
  float clearance = 0;        ///< of a line from the places that other lines point at, where it can be had
};

struct PlacedLabel {
  std::uint32_t label = 0;  ///< index into the wishes
  bool right = false;       ///< column: texts of the left one end at its x, those of the right begin there
  vec2 port{0};             ///< where its line leaves the text: on the column's x, half way down the text
  vec2 anchor{0};           ///< one of the wish's
};

struct LabelLayout {
  std::vector<PlacedLabel> placed;     ///< the left column from the top, then the right
  std::vector<std::uint32_t> dropped;  ///< labels without room, ascending
};

/// Sets labels into two columns so that no text covers another, all stand between top and bottom, and no line
/// from a port to its anchor crosses another. Where there is too little room the last wishes are dropped
/// first.
///
/// Method: the figure is cut at an upright line, the one of several that makes the shortest lines; what lies
/// left of it is labelled on the left. In a column texts begin in the order of their anchors, as near to
/// their height as those around allow (least squares of the moves, by pooling neighbours that push one
/// another), and two whose lines cross change places until none do: each change makes the lines shorter
/// together. A function of its input alone. O(n²) a column.
///
/// Example: `layOutLabels(wishes, {.left = 40, .right = 120, .top = 10, .bottom = 280, .gap = 1})`.
LabelLayout layOutLabels(std::span<const LabelWish> wishes, const LabelColumns& columns);

/// Whether two straight lines meet.
bool linesCross(vec2 a, vec2 b, vec2 c, vec2 d);

/// Centres of intervals of these lengths, in their order, `gap` apart at least, within [low, high], as near
/// to the wished centres as can be (least squares). Together they must fit.
std::vector<float> spreadOut(std::span<const float> wished, std::span<const float> lengths, float gap,
                             float low, float high);

}  // namespace vasa::plate
