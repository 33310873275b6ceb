#pragma once
#include <string>

#include "viewer/mannequin.h"
#include "viewer/view_state.h"

namespace vasa::viewer {

/// What was done between two steps, after "Undo": "move of left wrist". Of several things at once the one
/// that would be missed most.
std::string undoName(const Undoable& before, const Undoable& after, const Mannequin& mannequin);

}  // namespace vasa::viewer
