#pragma once
#include <filesystem>

#include "scene/scene.h"

namespace vasa::test {

/// The real body with its arteries and veins, converted anew. @param folder  for the network's file
Result<Scene> realScene(const std::filesystem::path& data, const std::filesystem::path& folder);

}  // namespace vasa::test
