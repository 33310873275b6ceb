#pragma once
#include "render/look.h"
#include "scene/scene_file.h"

namespace vasa::atlas {

/// The look that a scene asks for.
Look lookOf(const LookChoice& choice);
/// What a scene says beside its preset, onto a look that shows everything or leaves something out already.
void apply(const LookChoice& choice, Look& look);

/// What a scene has to say for lookOf() to give this look, by the preset it began with: parts that are shown
/// and what differs from the preset. How vessels are coloured is left as it is by default.
LookChoice choiceOf(const Look& look, const std::string& preset);

}  // namespace vasa::atlas
