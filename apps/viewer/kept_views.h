#pragma once
#include <vector>

#include "scene/scene_file.h"
#include "viewer/orbit.h"

namespace vasa::viewer {

/// What an orbit sees, without a cut and with perspective, as scene files have it: angles to a thousandth of
/// a degree.
ViewChoice viewOf(Orbit orbit, unsigned number = 1);

/// Puts a view in the place of that of its number; by rising number.
void keepView(std::vector<ViewChoice>& views, const ViewChoice& view);
/// To the view of this number, where there is one. @return whether there is
bool goToView(const std::vector<ViewChoice>& views, unsigned number, Orbit& orbit);

}  // namespace vasa::viewer
