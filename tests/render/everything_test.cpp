#include "render/everything.h"

#include <doctest/doctest.h>

#include <cstdlib>

#include "gpu/gpu_rig.h"
#include "render/picture.h"

using namespace vasa;

namespace {

// `./test.sh validation` asks for more.
unsigned frames(unsigned usual) {
  const char* times = std::getenv("VASA_FRAMES_TIMES");
  return usual * (times ? unsigned(std::max(1, std::atoi(times))) : 1);
}

}  // namespace

TEST_CASE("a hundred frames with everything switched on, without a word from the validation layer") {
  VASA_REQUIRE_GPU(rig);
  test::Everything scene;
  Renderer renderer(rig.device(), scene.grown.network, scene.meshes, scene.options(4));
  std::uint64_t first = 0, last = 0;
  const unsigned count = frames(100);
  for (unsigned i = 0; i < count; ++i) {
    const unsigned pose = i % (count - 1);  // the last one is the first one again
    renderer.draw(scene.turned(0.02f * float(pose), pose));
    if (i == 0) first = test::hashOfPicture(renderer.readBack());
    if (i + 1 == count) last = test::hashOfPicture(renderer.readBack());
  }
  CHECK(first == last);
}

// Compiling shaders with what looks up each access takes long, those of forks most of all: `./test.sh
// validation` has them.
TEST_CASE("frames with everything switched on under validation, GPU-assisted where the device can") {
  VASA_REQUIRE_GPU(rig);
  // What the layer writes addresses with.
  const bool assisted = rig.device().features().core.features.shaderInt64;
  gpu::Device device({.choice = {},
                      .validation = {.synchronization = !assisted, .gpuAssisted = assisted},
                      .instanceExtensions = {},
                      .deviceExtensions = {}});
  test::Everything scene(9);
  // Every access to memory is looked up: a few pixels and curves take every path that many do.
  RenderOptions options = scene.options(1);
  options.width = options.height = 40;
  options.capillaries.budget = 2'000;
  options.forks = !assisted || frames(1) > 1;
  {
    Renderer renderer(device, scene.grown.network, scene.meshes, options);
    for (unsigned i = 0; i < frames(3); ++i) renderer.draw(scene.turned(0.2f * float(i), i));
  }
  CHECK_MESSAGE(device.validationMessages().empty(), test::joined(device.validationMessages()));
}
