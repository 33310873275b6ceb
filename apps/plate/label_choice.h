#pragma once
#include <functional>
#include <string>
#include <vector>

#include "core/result.h"
#include "network/network.h"
#include "plate/seen_map.h"

namespace vasa::plate {

/// A text for a picture and the places that it may point at.
struct VesselLabel {
  std::string text;               ///< "Femoral artery"; without its side where the other side has the same
  std::vector<VesselId> vessels;  ///< that it names: one, a pair, or the pieces of one
  std::vector<vec2> anchors;      ///< [cells of the map] on the vessel where it is seen, the best first
  float area = 0;                 ///< [cells] that its vessels show
  float width = 0;                ///< [cells] of them, on average where they are seen
  /// How much it matters [m² cells], as its weightiest vessel does: the square of the radius, summed along
  /// what is seen of it. That is the blood of it that one sees: thick trunks count though they are short in
  /// the picture, and thin vessels where they are long.
  float weight = 0;
};

struct LabelChoice {
  std::vector<VesselLabel> labels;  ///< the weightiest first; of names in the order asked for
  std::vector<std::string> unseen;  ///< asked for by name, but not seen in the picture
};

/// Which vessels get a label; those that are only numbered ("right leg artery 2") are for who asks by name.
/// "main": what a teacher points at first, those that hold the most blood in the picture
/// (VesselLabel::weight), a row of alike ones once ("Posterior intercostal arteries"), and no branch or
/// companion that is named after a vessel with a label; "all-visible": all that are seen; else names with
/// commas between them: whole ones, with or without "left" and "right", or else what several names have in
/// them ("aorta": all its parts). A whole name may hold commas itself. Upper and lower case are alike.
struct LabelWishes {
  std::string which = "main";
  std::size_t most = 40;                   ///< of "main" and "all-visible"
  float leastArea = 20;                    ///< [cells] that a main vessel shows
  float leastWidth = 1;                    ///< [cells] of a main vessel, on average, hidden or not
  std::span<const char> of;                ///< vessels that "main" and "all-visible" choose from; empty: all
  std::function<bool(vec2 cell)> allowed;  ///< where anchors may lie; none: everywhere
};

/// @param points  of the pose that the map shows, as Network::points()
/// @param seen    vessels by their index
/// Fails with badInput where a name is no vessel's.
Result<LabelChoice> chooseLabels(const Network& network, std::span<const vec4> points, const SeenMap& seen,
                                 const LabelWishes& wishes);

}  // namespace vasa::plate
