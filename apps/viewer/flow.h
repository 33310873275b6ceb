#pragma once
#include <string>

// Panels that are narrow, as in a small window or with large letters: what has no room beside what comes
// before it goes to a line of its own, and long texts are broken.
namespace vasa::viewer {

/// [pixels] that they take up.
float checkboxWidth(const char* name);  ///< a radio button's, too
float buttonWidth(const char* name);

/// The next item goes into the line of the last one where that leaves it this width.
void sameLineWithRoom(float width);

/// A line that can be clicked, or several where it is too long for one. @return whether it was
bool selectableLines(const std::string& text, bool chosen = false);

}  // namespace vasa::viewer
