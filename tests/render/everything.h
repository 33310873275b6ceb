#pragma once
#include <glm/gtc/matrix_transform.hpp>

#include "network/measure.h"
#include "render/renderer.h"
#include "support/growth.h"
#include "support/meshes.h"
#include "support/networks.h"

namespace vasa::test {

/// A small scene with everything that a picture can have: tubes, caps, forks, capillaries, bones, heart,
/// skin.
struct Everything {
  explicit Everything(std::uint32_t vessels = 25) : grown(windingNetwork(vessels, 3)) {
    growth.rules = grown.rules;
    growth.beds = grown.beds;
    meshes = {boxMesh("skin", {-0.2f, 0, -0.2f}, {0.2f, 1, 0.2f}),
              boxMesh("bones", {-0.1f, 0, -0.1f}, {0.1f, 1, 0.1f}),
              boxMesh("heart", {0.1f, 0.5f, 0.1f}, {0.2f, 0.6f, 0.2f})};
    rest = grown.points;
    camera = cameraFrom(View::front, measure(grown.network, rest).bounds, 1);
  }

  RenderOptions options(std::uint32_t samples) const {
    RenderOptions chosen;
    chosen.width = 161;
    chosen.height = 160;
    chosen.samples = samples;
    chosen.pixelError = 0.3f;
    chosen.occlusion = true;
    chosen.templateBytes = 1;  // the least: several rounds
    chosen.growth = &growth;
    chosen.capillaries = {.levels = 2, .budget = 20'000, .smallest = 0};
    chosen.timed = false;  // the timer's barriers would hide a missing one
    return chosen;
  }

  /// Everything turned about the vertical axis, in each look by turns.
  RenderInput turned(float angle, unsigned look) {
    const mat4 turn = glm::rotate(mat4(1), angle, vec3(0, 1, 0));
    for (std::size_t k = 0; k < rest.size(); ++k)
      grown.points[k] = vec4(vec3(turn * vec4(vec3(rest[k]), 1)), rest[k].w);
    grown.pose();
    joints = {turn};
    const char* const looks[]{"atlas", "clinical", "xray"};
    return {.points = grown.points,
            .knotFrames = grown.frames,
            .jointMatrices = joints,
            .camera = camera,
            .look = *lookNamed(looks[look % 3]),
            .heartScale = 1 - 0.1f * std::abs(std::sin(9 * angle))};
  }

  GrownNetwork grown;
  Growth growth;
  std::vector<SkinnedMesh> meshes;
  std::vector<vec4> rest;
  std::vector<mat4> joints;
  Camera camera;
};

}  // namespace vasa::test
