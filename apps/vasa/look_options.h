#pragma once
#include <string>

#include "core/result.h"
#include "scene/scene_file.h"

namespace vasa::cli {

/// --look and --hide, on top of what the scene says. Both may be empty.
Result<void> chooseLook(LookChoice& choice, const std::string& preset, const std::string& hidden);

extern const char* const kLookHelp;
extern const char* const kHideHelp;

}  // namespace vasa::cli
