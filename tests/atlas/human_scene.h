#pragma once
#include <doctest/doctest.h>

#include <algorithm>

#include "scene/scene.h"

namespace vasa::test {

/// The built-in human, loaded once.
inline const Scene& humanScene() {
  static const Scene loaded = [] {
    const std::filesystem::path data = VASA_BUILD_DATA_DIR;
    SceneFile file;
    file.body = data / "human.glb";
    file.networks = {data / "human.vasa"};
    auto scene = loadScene(file);
    REQUIRE_MESSAGE(scene, (scene ? "" : scene.error().message));
    return std::move(*scene);
  }();
  return loaded;
}

inline std::size_t vesselNamed(const Network& network, std::string_view name) {
  const auto found = std::ranges::find(network.vessels(), name, &Vessel::name);
  REQUIRE_MESSAGE(found != network.vessels().end(), std::string(name));
  return std::size_t(found - network.vessels().begin());
}

}  // namespace vasa::test
