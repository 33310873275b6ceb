#pragma once
#include <span>
#include <string>
#include <vector>

#include "scene/scene_file.h"

namespace vasa::viewer {

/// What the clipboard holds of a copied pose: a scene that has nothing but a pose,
/// { "pose": { "LeftForeArm": [bend, spread, twist] } }, in degrees.
std::string poseText(std::span<const TurnChoice> pose);

/// The pose of such a text, or of any scene's. Fails with badInput that says what is wrong with it.
Result<std::vector<TurnChoice>> poseOfText(const std::string& text);

}  // namespace vasa::viewer
