#pragma once
#include <filesystem>
#include <span>
#include <string_view>
#include <vector>

#include "scene/scene.h"

namespace vasa {

/// The second half of loadScene(): merges vessels, replays journals of edits onto them and binds them to the
/// body.
/// @param names  of their files, for messages
Result<Scene> makeScene(Body body, std::vector<Network> networks,
                        std::span<const std::filesystem::path> edits, std::string_view names);

}  // namespace vasa
