#pragma once
#include <string_view>
#include <vector>

#include "scene/scene.h"

namespace vasa {

/// The second half of loadScene(): merges vessels, replays the file's journals of edits onto them, binds them
/// to the body and reads where they are held.
/// @param names  of their files, for messages
Result<Scene> makeScene(Body body, std::vector<Network> networks, const SceneFile& file,
                        std::string_view names);

}  // namespace vasa
