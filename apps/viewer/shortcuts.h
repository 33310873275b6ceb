#pragma once
#include <span>

#include "viewer/document.h"
#include "viewer/input.h"
#include "viewer/view_state.h"

namespace vasa::viewer {

/// What a pressed key does.
void applyShortcut(Key key, bool control, bool shift, ViewState& state, const Document* document);

/// Keys and what they do, for help texts.
struct Shortcut {
  const char* keys;
  const char* what;
};
std::span<const Shortcut> shortcuts();

}  // namespace vasa::viewer
