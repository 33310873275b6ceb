#pragma once
#include "scene/scene_file.h"

namespace vasa::test {

/// The folder of the built-in human.
inline const std::filesystem::path kData = VASA_BUILD_DATA_DIR;

/// It and its vessels, without holds.
inline SceneFile humanFile() {
  SceneFile file;
  file.body = kData / "human.glb";
  file.networks = {kData / "human.vasa"};
  return file;
}

}  // namespace vasa::test
