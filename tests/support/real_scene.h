#pragma once
#include <filesystem>

#include "scene/scene.h"

namespace vasa::test {

/// The real body with its arteries and veins. Converting them takes half a minute: what one test program
/// made, with this very engine of these very files, serves the next.
Result<Scene> realScene(const std::filesystem::path& data);

}  // namespace vasa::test
