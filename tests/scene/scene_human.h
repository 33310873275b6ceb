#pragma once
#include <doctest/doctest.h>

#include "scene/scene.h"
#include "support/kept_once.h"

namespace vasa {

/// The built-in human, read once; what solving its motions takes is made once, too.
inline const Scene& human() {
  static const test::KeptOnce kept;
  static const Result<Scene> scene = [] {
    SceneFile file;
    file.body = VASA_HUMAN_DATA "/human.glb";
    file.networks = {VASA_HUMAN_DATA "/human.vasa"};
    file.holds = VASA_HUMAN_DATA "/human.holds.csv";
    return loadScene(file);
  }();
  if (!scene.ok()) FAIL(scene.error().message);
  return *scene;
}

inline const Clip& clipNamed(const char* name) {
  const auto clip = findClip(human().body, name);
  REQUIRE(clip.ok());
  return **clip;
}

}  // namespace vasa
